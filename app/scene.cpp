// vlf scene: writes one of the example scenes.

#include "commands.h"

#include "vlf/scene/export_obj.h"
#include "vlf/scene/generate/generate.h"

#include <memory>

#include <fmt/format.h>

namespace vlf::app {

namespace {

struct SceneArguments {
    std::string name, folder;
    SceneOptions options;
    bool list = false;
};

void printList() {
    for (const SceneRecipe& r : sceneRecipes()) fmt::print("{:<12} {}\n", r.name, r.summary);
}

void runScene(const SceneArguments& arguments, const Globals& globals) {
    if (arguments.list) return printList();
    if (arguments.name.empty()) throw CLI::RequiredError("NAME (see --list)");
    if (arguments.folder.empty()) throw CLI::RequiredError("-o,--output");
    const Scene scene = generateScene(arguments.name, arguments.options);
    exportObj(scene, arguments.folder, arguments.name);
    if (!globals.quiet)
        fmt::print("{}/{}.obj: {} triangles, {} materials, {} cameras\n", arguments.folder,
                   arguments.name, scene.triangles.size(), scene.materials.size(),
                   scene.cameras.size());
}

}  // namespace

void addScene(CLI::App& app, const Globals& globals) {
    auto* command = app.add_subcommand("scene", "Write one of the example scenes as OBJ");
    auto arguments = std::make_shared<SceneArguments>();
    command->add_option("NAME", arguments->name, "Name of the scene, see --list");
    command->add_option("-o,--output", arguments->folder,
                        "Folder for the files; made if it does not exist");
    command
        ->add_option("--triangles", arguments->options.triangles,
                     "Triangles of the statue (mirror-room and gallery; default 10000)")
        ->check(CLI::PositiveNumber);
    command->add_flag("--list", arguments->list, "List the scenes");
    command->footer(
        "Example:\n  vlf scene gallery -o scenes --triangles 200000\n"
        "writes gallery.obj with its .mtl, textures and gallery.cameras.json.");
    command->callback([arguments, &globals] { runScene(*arguments, globals); });
}

}  // namespace vlf::app
