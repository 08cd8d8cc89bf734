// The shape of the code, kept by parsing it: which module may include which, which library is used
// where, and what every header has.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = VLF_SOURCE_DIR;

/// Every arrow there is: module -> modules it may include, besides base and math, which all but
/// these two may include. This is the one place where the arrows are listed.
const std::map<std::string, std::set<std::string>> kArrows{
    {"base", {}},
    {"math", {}},
    {"image", {}},
    {"scene", {"image"}},
    {"trace", {"scene"}},
    {"field", {}},
    {"unwrap", {"scene", "trace", "field"}},
    {"propagate", {"scene", "trace", "field", "unwrap"}},
    {"io", {"scene", "field", "image"}},
    {"dynamic", {"scene", "trace", "field", "unwrap", "propagate"}},
    {"render", {"scene", "trace", "field", "image", "dynamic"}},
    {"display", {"scene", "trace", "image", "render", "dynamic"}},
    {"live", {"scene", "field", "propagate", "io"}},
};

/// Libraries that one module alone may use, so that they can be exchanged.
const std::map<std::string, std::string> kOwners{
    {"tbb", "base"},      {"oneapi", "base"}, {"embree3", "trace"},     {"embree4", "trace"},
    {"hwy", "propagate"}, {"zstd.h", "io"},   {"tiny_gltf.h", "scene"}, {"epoxy", "render"},
    {"GLFW", "display"},  {"imgui.h", "app"}, {"backends", "app"},
};

struct SourceFile {
    std::string name;    ///< from the root, e.g. "src/vlf/scene/scene.h"
    std::string module;  ///< "app" for the command line
    std::vector<std::string> lines;

    bool isHeader() const { return name.ends_with(".h"); }
    bool isLibrary() const { return module != "app"; }
};

struct Include {
    std::string path;
    std::string firstFolder;  ///< or the whole path, where it has none
    bool quoted = false;
};

std::vector<std::string> readLines(const fs::path& path) {
    std::ifstream stream(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::vector<SourceFile> collectSources() {
    std::vector<SourceFile> files;
    for (const char* folder : {"src/vlf", "app"})
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
            const std::string extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp") continue;
            const fs::path name = entry.path().lexically_relative(kRoot);
            const std::string module = *name.begin() == "app" ? "app" : *std::next(name.begin(), 2);
            files.push_back({name, module, readLines(entry.path())});
        }
    return files;
}

const std::vector<SourceFile>& sources() {
    static const std::vector<SourceFile> files = collectSources();
    return files;
}

std::vector<Include> includesOf(const SourceFile& file) {
    static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
    std::vector<Include> includes;
    std::smatch match;
    for (const std::string& line : file.lines)
        if (std::regex_search(line, match, pattern)) {
            const std::string path = match[2];
            includes.push_back({path, path.substr(0, path.find('/')), match[1] == "\""});
        }
    return includes;
}

bool arrowAllowed(const std::string& from, const std::string& to) {
    if (from == to || from == "app") return true;
    const bool lowest = from == "base" || from == "math";
    if (!lowest && (to == "base" || to == "math")) return true;
    const auto allowed = kArrows.find(from);
    return allowed != kArrows.end() && allowed->second.contains(to);
}

TEST(Architecture, SourcesAreFound) {
    EXPECT_GT(sources().size(), 20u);
}

TEST(Architecture, EveryModuleIsListed) {
    for (const SourceFile& file : sources())
        EXPECT_TRUE(!file.isLibrary() || kArrows.contains(file.module)) << file.name;
}

TEST(Architecture, ModulesIncludeOnlyWhatTheirArrowsAllow) {
    for (const SourceFile& file : sources())
        for (const Include& include : includesOf(file)) {
            if (include.firstFolder != "vlf") continue;
            const std::string module = *std::next(fs::path(include.path).begin());
            EXPECT_TRUE(arrowAllowed(file.module, module))
                << file.name << " includes " << include.path << ": no arrow " << file.module
                << " -> " << module;
        }
}

TEST(Architecture, TheLibraryNamesItsHeadersFromTheRoot) {
    for (const SourceFile& file : sources())
        for (const Include& include : includesOf(file)) {
            const bool own = include.firstFolder == "vlf";
            EXPECT_TRUE(own == include.quoted || !file.isLibrary())
                << file.name << " includes " << include.path;
        }
}

TEST(Architecture, LibrariesStayInTheModuleThatOwnsThem) {
    for (const SourceFile& file : sources())
        for (const Include& include : includesOf(file)) {
            const auto owner = kOwners.find(include.firstFolder);
            EXPECT_TRUE(owner == kOwners.end() || owner->second == file.module)
                << file.name << " includes " << include.path;
        }
}

TEST(Architecture, SourceFilesIncludeTheirOwnHeaderFirst) {
    for (const SourceFile& file : sources()) {
        const fs::path header = fs::path(file.name).replace_extension(".h");
        if (file.isHeader() || !fs::exists(kRoot / header)) continue;
        const std::vector<Include> includes = includesOf(file);
        ASSERT_FALSE(includes.empty()) << file.name;
        EXPECT_EQ(fs::path(includes.front().path).filename(), header.filename()) << file.name;
    }
}

TEST(Architecture, HeadersAreGuardedAndSayWhatTheyAreFor) {
    for (const SourceFile& file : sources()) {
        if (!file.isHeader()) continue;
        ASSERT_GT(file.lines.size(), 2u) << file.name;
        EXPECT_EQ(file.lines[0], "#pragma once") << file.name;
        EXPECT_TRUE(file.lines[1].starts_with("// ")) << file.name << ": no sentence of purpose";
    }
}

TEST(Architecture, TheLibraryNeitherPrintsNorExits) {
    const std::regex forbidden(
        R"(std::c(out|err|log)\b|\b(f|fmt::)?printf?\s*\(\s*(stderr|stdout|")|\b(exit|abort)\s*\()");
    for (const SourceFile& file : sources()) {
        if (!file.isLibrary()) continue;
        for (std::size_t i = 0; i < file.lines.size(); ++i)
            EXPECT_FALSE(std::regex_search(file.lines[i], forbidden))
                << file.name << ':' << i + 1 << ": " << file.lines[i];
    }
}

TEST(Architecture, FilesHoldOneThing) {
    constexpr std::size_t kMostLines = 500;
    for (const SourceFile& file : sources())
        EXPECT_LE(file.lines.size(), kMostLines) << file.name << ": split it";
}

}  // namespace
