// vlf sheet: a contact sheet of pictures.

#include "commands.h"

#include "vlf/image/contact_sheet.h"
#include "vlf/image/image_io.h"
#include "vlf/image/tone_map.h"

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace vlf::app {

namespace {

struct SheetArguments {
    std::vector<std::string> pictures;
    std::string output;
    ContactSheetLayout layout;
};

/// The picture as it is, or, if it holds radiance, as vlf render would show it in a PNG.
Image readForDisplay(const std::string& path) {
    const Image image = readImage(path);
    if (!path.ends_with(".exr") && !path.ends_with(".hdr")) return image;
    return toneMap(image, autoExposure(image), ToneCurve::filmic);
}

void runSheet(const SheetArguments& arguments, const Globals& globals) {
    std::vector<Image> pictures;
    for (const std::string& path : arguments.pictures) pictures.push_back(readForDisplay(path));
    const Image sheet = contactSheet(pictures, arguments.layout);
    writePng(arguments.output, sheet);
    if (!globals.quiet)
        fmt::print("{}: {} pictures, {}x{} pixels\n", arguments.output, pictures.size(),
                   sheet.width, sheet.height);
}

}  // namespace

void addSheet(CLI::App& app, const Globals& globals) {
    const auto arguments = std::make_shared<SheetArguments>();
    CLI::App* command = app.add_subcommand("sheet", "Put several pictures on one contact sheet");
    command
        ->add_option("pictures", arguments->pictures,
                     "Pictures in reading order (PNG, JPEG, EXR, HDR)")
        ->required();
    command->add_option("-o,--output", arguments->output, "Contact sheet to write (PNG)")
        ->required();
    command
        ->add_option("--columns", arguments->layout.columns,
                     "Pictures a row (0: as many as rows, or one more)")
        ->check(CLI::Range(0, 1000));
    command->add_option("--cell", arguments->layout.cellWidth, "Width of a picture, pixels")
        ->check(CLI::Range(16, 8192))
        ->capture_default_str();
    command->footer(
        "EXR and HDR pictures are tone-mapped as vlf render does.\n\n"
        "Example:\n  vlf sheet front.png side.png top.png -o sheet.png --columns 3");
    command->callback([arguments, &globals] { runSheet(*arguments, globals); });
}

}  // namespace vlf::app
