#include "frame_output.h"

#include "eye_pictures.h"
#include "film_writer.h"
#include "frame_names.h"

namespace vlf::app {

namespace {

class FilmOutput : public FrameOutput {
  public:
    FilmOutput(std::vector<std::string> files, const FilmFormat& format)
        : files_(std::move(files)) {
        for (const std::string& file : files_)
            writers_.push_back(std::make_unique<FilmWriter>(file, format));
    }
    void add(int, const std::vector<Image>& pictures) override {
        for (std::size_t i = 0; i < pictures.size(); ++i) writers_[i]->add(pictures[i]);
    }
    void finish() override {
        for (const auto& writer : writers_) writer->finish();
    }
    std::vector<std::string> names() const override { return files_; }

  private:
    std::vector<std::string> files_;
    std::vector<std::unique_ptr<FilmWriter>> writers_;
};

class SequenceOutput : public FrameOutput {
  public:
    SequenceOutput(std::string pattern, StereoLayout layout, ImageAttributes attributes)
        : pattern_(std::move(pattern)), layout_(layout), attributes_(std::move(attributes)) {}

    void add(int frame, const std::vector<Image>& pictures) override {
        const std::vector<std::string> files = eyeFiles(layout_, frameName(pattern_, frame));
        for (std::size_t i = 0; i < pictures.size(); ++i)
            writeFinished(files[i], pictures[i], attributes_);
    }
    std::vector<std::string> names() const override { return eyeFiles(layout_, pattern_); }

  private:
    std::string pattern_;
    StereoLayout layout_;
    ImageAttributes attributes_;
};

}  // namespace

std::unique_ptr<FrameOutput> openFrameOutput(const RenderOptions& options, int firstFrame) {
    const StereoLayout layout = options.stereo.layout;
    if (options.film.film.empty()) {
        requireWritableOutputs({frameName(options.picture.path, firstFrame), options.film.log});
        return std::make_unique<SequenceOutput>(
            options.picture.path, layout,
            ImageAttributes{{"vlf.mode", nameOf(kModeNames, options.still.mode)}});
    }
    requireWritableOutputs({options.film.film, options.film.log});
    const int across = layout == StereoLayout::sideBySide ? 2 : 1;
    return std::make_unique<FilmOutput>(
        eyeFiles(layout, options.film.film),
        FilmFormat{across * options.camera.width, options.camera.height, options.film.fps,
                   options.film.crf});
}

}  // namespace vlf::app
