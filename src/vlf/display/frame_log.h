#pragma once
// What every frame of a session took, and where the camera was: for analysis in pandas or R.

#include "vlf/display/camera_pose.h"

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace vlf {

/// Times in milliseconds.
struct FrameRecord {
    double pathSeconds = 0;                     ///< time on the camera's path, s
    double cpuMs = 0;                           ///< until the frame was drawn or handed to the GPU
    std::optional<double> gpuMs;                ///< of the GPU's work, where it is measured
    double totalMs = 0;                         ///< from the frame's start to its end
    std::vector<std::optional<double>> passMs;  ///< one per pass of the log, where measured
    CameraPose pose;
};

/// Keeps every frame in memory, so that adding one never waits for a disk.
class FrameLog {
  public:
    /// `passes` are the names of the parts of a frame that are timed apart: letters, digits and _.
    explicit FrameLog(std::vector<std::string> passes = {}) : passes_(std::move(passes)) {}

    /// Precondition: frame.passMs holds a time per pass.
    void add(FrameRecord frame);

    const std::deque<FrameRecord>& frames() const { return frames_; }

    /// A header with units in the names (frame, path_time_s, cpu_ms, gpu_ms, total_ms, PASS_ms,
    /// eye_x_m, ..., vertical_fov_deg) and a row per frame; a time that was not measured is empty.
    std::string toCsv() const;

    /// The same as an array with an object per frame; a time that was not measured is null.
    std::string toJson() const;

    /// Writes CSV or JSON, by the extension of the name. Throws InputError for another extension
    /// and FileError.
    void write(const std::string& file) const;

  private:
    std::vector<std::string> columns() const;
    /// The cells of a frame as numbers or, empty, as nothing.
    std::vector<std::string> cells(std::size_t frame) const;

    std::vector<std::string> passes_;
    std::deque<FrameRecord> frames_;
};

/// Empty if FrameLog::write takes this name, else what is wrong.
std::string frameLogNameProblem(const std::string& file);

}  // namespace vlf
