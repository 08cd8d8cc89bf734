#include "eye_pictures.h"

#include <filesystem>

namespace vlf::app {

std::vector<Image> renderEyes(RoomRenderer& renderer, const StillParams& params,
                              const StereoOptions& stereo, Progress& progress,
                              StillReport& report) {
    if (stereo.layout == StereoLayout::none) return {renderer.render(params, progress, report)};
    report = {};
    std::vector<Image> pictures;
    for (const Eye eye : {Eye::left, Eye::right}) {
        StillParams own = params;
        own.camera = cameraOf(eye, params.camera, stereo.eyes);
        StillReport one;
        pictures.push_back(renderer.render(own, progress, one));
        report.seconds += one.seconds;
        report.rays += one.rays;
    }
    return pictures;
}

float exposureOf(const PictureOptions& options, const std::vector<Image>& radiance) {
    Image all;
    for (const Image& image : radiance)
        all.pixels.insert(all.pixels.end(), image.pixels.begin(), image.pixels.end());
    return exposureOf(options.exposure, all);
}

std::vector<Image> develop(const PictureOptions& options, float exposure, StereoLayout layout,
                           std::vector<Image> eyes) {
    if (!writesRadiance(options.path))
        for (Image& image : eyes) image = toneMap(image, exposure, options.tone);
    if (layout == StereoLayout::sideBySide) return {sideBySide(eyes[0], eyes[1])};
    if (layout == StereoLayout::anaglyph) return {anaglyph(eyes[0], eyes[1])};
    return eyes;
}

std::vector<std::string> eyeFiles(StereoLayout layout, const std::string& path) {
    if (layout != StereoLayout::pair) return {path};
    const std::string extension = std::filesystem::path(path).extension().string();
    const std::string stem = path.substr(0, path.size() - extension.size());
    return {stem + "-left" + extension, stem + "-right" + extension};
}

}  // namespace vlf::app
