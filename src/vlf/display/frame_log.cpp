#include "vlf/display/frame_log.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"

#include <cassert>
#include <filesystem>

#include <fmt/format.h>

namespace vlf {

namespace {

constexpr double kDegrees = 180.0 / kPi;

/// Empty if it was not measured.
std::string milliseconds(std::optional<double> ms) {
    return ms ? fmt::format("{:.4f}", *ms) : std::string();
}

std::string extensionOf(const std::string& file) {
    return std::filesystem::path(file).extension().string();
}

}  // namespace

void FrameLog::add(FrameRecord frame) {
    assert(frame.passMs.size() == passes_.size());
    frames_.push_back(std::move(frame));
}

std::vector<std::string> FrameLog::columns() const {
    std::vector<std::string> names{"frame", "path_time_s", "cpu_ms", "gpu_ms", "total_ms"};
    for (const std::string& pass : passes_) names.push_back(pass + "_ms");
    for (const char* name :
         {"eye_x_m", "eye_y_m", "eye_z_m", "yaw_deg", "pitch_deg", "vertical_fov_deg"})
        names.push_back(name);
    return names;
}

std::vector<std::string> FrameLog::cells(std::size_t frame) const {
    const FrameRecord& f = frames_[frame];
    std::vector<std::string> row{fmt::format("{}", frame), fmt::format("{:.6f}", f.pathSeconds),
                                 milliseconds(f.cpuMs), milliseconds(f.gpuMs),
                                 milliseconds(f.totalMs)};
    for (const std::optional<double>& ms : f.passMs) row.push_back(milliseconds(ms));
    for (int axis = 0; axis < 3; ++axis) row.push_back(fmt::format("{}", f.pose.eye[axis]));
    row.push_back(fmt::format("{:.5f}", kDegrees * f.pose.yaw));
    row.push_back(fmt::format("{:.5f}", kDegrees * f.pose.pitch));
    row.push_back(fmt::format("{}", f.pose.verticalFov));
    return row;
}

std::string FrameLog::toCsv() const {
    std::string text = fmt::format("{}\n", fmt::join(columns(), ","));
    for (std::size_t i = 0; i < frames_.size(); ++i)
        text += fmt::format("{}\n", fmt::join(cells(i), ","));
    return text;
}

std::string FrameLog::toJson() const {
    const std::vector<std::string> names = columns();
    std::string text = "[";
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        const std::vector<std::string> row = cells(i);
        text += i == 0 ? "\n{" : ",\n{";
        for (std::size_t c = 0; c < row.size(); ++c)
            text += fmt::format("{}\"{}\": {}", c == 0 ? "" : ", ", names[c],
                                row[c].empty() ? "null" : row[c]);
        text += "}";
    }
    return text + "\n]\n";
}

void FrameLog::write(const std::string& file) const {
    if (const std::string problem = frameLogNameProblem(file); !problem.empty())
        throw InputError(problem);
    const std::string text = extensionOf(file) == ".csv" ? toCsv() : toJson();
    writeFile(file, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::string frameLogNameProblem(const std::string& file) {
    const std::string extension = extensionOf(file);
    return extension == ".csv" || extension == ".json" ? "" : file + " must end in .csv or .json";
}

}  // namespace vlf
