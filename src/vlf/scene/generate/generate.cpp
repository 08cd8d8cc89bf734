#include "vlf/scene/generate/generate.h"

#include "vlf/base/error.h"
#include "vlf/scene/generate/fixtures.h"
#include "vlf/scene/generate/recipes.h"

#include <functional>

#include <fmt/format.h>

namespace vlf {

namespace {

struct Entry {
    SceneRecipe recipe;
    bool hasStatue;
    std::function<Scene(int statueTriangles)> make;
};

const std::vector<Entry>& entries() {
    static const std::vector<Entry> kEntries{
        {{"cornell", "the Cornell box with its published measures and colours"},
         false,
         [](int) { return makeCornell(); }},
        {{"mirror-room", "a closed room with a wall mirror, a tall block and a statue"},
         true,
         makeMirrorRoom},
        {{"two-rooms", "two rooms joined by a door, a light in one"},
         false,
         [](int) { return makeTwoRooms(); }},
        {{"sealed", "a dark sealed room beside a bright one, with shared walls"},
         false,
         [](int) { return makeSealed(); }},
        {{"office", "a furnished office with a window, ceiling panels and a desk lamp"},
         false,
         [](int) { return makeOffice(); }},
        {{"grotto", "a cave with a pool, lit by the sky, lava and a crystal"},
         false,
         [](int) { return makeGrotto(); }},
        {{"gallery", "a white gallery with pictures and a statue"}, true, makeGallery},
        {{"caustic", "a spotlight thrown on a wall by a mirror, and a mirror-sided box"},
         false,
         [](int) { return makeCaustic(); }},
        {{"gloss", "a room with metal panels of three roughnesses and a polished floor"},
         false,
         [](int) { return makeGloss(); }},
        {{"glass", "a room with a tinted pane, a ball and a block of glass"}, false, [](int) {
             return makeGlass();
         }}};
    return kEntries;
}

const Entry& findEntry(const std::string& name) {
    std::string known;
    for (const Entry& e : entries()) {
        if (e.recipe.name == name) return e;
        known += (known.empty() ? "" : ", ") + e.recipe.name;
    }
    throw InputError(fmt::format("no scene is named '{}'; choose one of {}", name, known));
}

int statueTriangles(const Entry& entry, int wanted) {
    if (wanted == 0) return kStatueTriangles;
    if (!entry.hasStatue)
        throw InputError(fmt::format(
            "scene '{}' has no statue whose triangles can be chosen; leave the count out",
            entry.recipe.name));
    if (wanted < kMinStatueTriangles || wanted > kMaxStatueTriangles)
        throw InputError(fmt::format("a statue of {} triangles: choose {} to {}", wanted,
                                     kMinStatueTriangles, kMaxStatueTriangles));
    return wanted;
}

}  // namespace

const std::vector<SceneRecipe>& sceneRecipes() {
    static const std::vector<SceneRecipe> kRecipes = [] {
        std::vector<SceneRecipe> recipes;
        for (const Entry& e : entries()) recipes.push_back(e.recipe);
        return recipes;
    }();
    return kRecipes;
}

Scene generateScene(const std::string& name, const SceneOptions& options) {
    const Entry& entry = findEntry(name);
    return entry.make(statueTriangles(entry, options.triangles));
}

}  // namespace vlf
