#include "vlf/scene/import/obj_file.h"

#include "vlf/scene/import/polygon.h"
#include "vlf/scene/import/text_lines.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <set>
#include <unordered_map>

namespace vlf {

namespace {

class ObjParser {
  public:
    ObjParser(const std::string& path, std::string_view text, ImportReport& report)
        : reader_(text), report_(report) {
        file_.path = path;
    }

    ObjFile parse() {
        while (reader_.next()) parseLine(reader_.line());
        for (const ObjFace& face : file_.faces) checkRanges(face);
        for (const auto& [what, skipped] : skipped_)
            warn(report_, {file_.path, skipped.line, ""},
                 fmt::format("{} skipped ({} of them)", what, skipped.count));
        return std::move(file_);
    }

  private:
    struct Skipped {
        int line = 0;
        std::size_t count = 0;
    };

    SourceLocation here() const { return {file_.path, reader_.number(), ""}; }

    void skip(const std::string& what, int line) {
        Skipped& skipped = skipped_[what];
        if (skipped.count++ == 0) skipped.line = line;
    }
    void skip(const std::string& what) { skip(what, reader_.number()); }

    void parseLine(std::string_view line) {
        WordReader words(line);
        const std::string_view key = words.next();
        if (key.empty() || key.starts_with('#')) return;
        if (key == "v")
            file_.positions.push_back(parseVec3(words, "vertex"));
        else if (key == "vt")
            parseUv(words);
        else if (key == "vn")
            file_.normals.push_back(parseVec3(words, "normal"));
        else if (key == "f" || key == "fo")
            parseFace(words);
        else if (key == "usemtl")
            useMaterial(std::string(words.rest()));
        else if (key == "mtllib")
            file_.libraries.push_back({std::string(words.rest()), reader_.number()});
        else if (key == "o" || key == "g")
            partName_ = words.rest();
        else if (key == "s")
            smoothing_ = smoothingGroup(words.next());
        else if (key == "l" || key == "p")
            skip("lines and points");
        else if (key == "curv" || key == "curv2" || key == "surf")
            skip("curves and curved surfaces");
    }

    /// `s 0`, `s off` and anything unreadable turn smoothing off.
    static int smoothingGroup(std::string_view word) {
        if (word == "on") return 1;
        const long long group = parseInteger(word).value_or(0);
        return group > 0 && group <= std::numeric_limits<int>::max() ? static_cast<int>(group) : 0;
    }

    float parseFloat(std::string_view word, const char* what) {
        const auto number = parseNumber(word);
        if (!number)
            throw InputError(here(), word.empty()
                                         ? fmt::format("{} with too few numbers", what)
                                         : fmt::format("{}: '{}' is not a number", what, word));
        const auto value = static_cast<float>(number->value);
        if (!std::isfinite(value))
            throw InputError(here(), fmt::format("{}: '{}' is not a finite number", what, word));
        if (!number->complete) skip("characters that follow a number");
        return value;
    }

    Vec3 parseVec3(WordReader& words, const char* what) {
        Vec3 v;
        for (int i = 0; i < 3; ++i) v[i] = parseFloat(words.next(), what);
        return v;
    }

    /// The second coordinate may be left out.
    void parseUv(WordReader& words) {
        const float u = parseFloat(words.next(), "texture coordinate");
        const std::string_view second = words.next();
        const bool one = second.empty() || second.starts_with('#');
        file_.uvs.emplace_back(u, one ? 0.0f : parseFloat(second, "texture coordinate"));
    }

    void parseFace(WordReader& words) {
        ObjFace face{static_cast<std::uint32_t>(file_.corners.size()),
                     0,
                     material_,
                     0,
                     smoothing_,
                     reader_.number()};
        for (auto word = words.next(); !word.empty() && !word.starts_with('#'); word = words.next())
            file_.corners.push_back(parseCorner(word));
        face.cornerCount = static_cast<std::uint32_t>(file_.corners.size()) - face.firstCorner;
        if (face.cornerCount > kMaxPolygonCorners)
            throw InputError(here(), fmt::format("a face of {} corners; at most {} are supported, "
                                                 "split it",
                                                 face.cornerCount, kMaxPolygonCorners));
        if (face.cornerCount < 3) {
            file_.corners.resize(face.firstCorner);
            skip("faces of fewer than three corners");
            return;
        }
        face.part = currentPart();
        file_.faces.push_back(face);
    }

    int currentPart() {
        if (file_.parts.empty() || file_.parts.back().name != partName_)
            file_.parts.push_back({partName_, reader_.number()});
        return static_cast<int>(file_.parts.size()) - 1;
    }

    /// v, v/vt, v//vn or v/vt/vn.
    ObjCorner parseCorner(std::string_view word) {
        ObjCorner corner;
        int* const slots[] = {&corner.position, &corner.uv, &corner.normal};
        const std::size_t counts[] = {file_.positions.size(), file_.uvs.size(),
                                      file_.normals.size()};
        for (int i = 0; i < 3; ++i) {
            const std::size_t slash = word.find('/');
            const std::string_view digits = word.substr(0, slash);
            if (!digits.empty()) *slots[i] = parseIndex(digits, counts[i]);
            if (i == 0 && *slots[i] < 0)
                throw InputError(here(), fmt::format("'{}' is no vertex of the {} so far; OBJ "
                                                     "counts from 1",
                                                     digits, counts[i]));
            if (slash == std::string_view::npos) return corner;
            word.remove_prefix(slash + 1);
        }
        throw InputError(here(), "a corner of the face has more than three indices");
    }

    /// Index from 0 of a number from 1, or of a negative one that counts from the latest back;
    /// -1 if there is no such element.
    int parseIndex(std::string_view digits, std::size_t count) const {
        const auto index = parseInteger(digits);
        if (!index) throw InputError(here(), fmt::format("'{}' is not an index", digits));
        if (*index == 0 || *index < -static_cast<long long>(count) ||
            *index > std::numeric_limits<int>::max())
            return -1;
        return static_cast<int>(*index > 0 ? *index - 1 : *index + static_cast<long long>(count));
    }

    void useMaterial(const std::string& name) {
        const auto [entry, isNew] =
            materialIndex_.try_emplace(name, static_cast<int>(file_.materials.size()));
        if (isNew) file_.materials.push_back({name, reader_.number()});
        material_ = entry->second;
    }

    /// Positive indices may point to what follows the face, so they are checked at the end.
    /// Texture coordinates and normals that do not exist count as not given.
    void checkRanges(const ObjFace& face) {
        for (std::uint32_t i = 0; i < face.cornerCount; ++i) {
            ObjCorner& corner = file_.corners[face.firstCorner + i];
            if (static_cast<std::size_t>(corner.position) >= file_.positions.size())
                throw InputError({file_.path, face.line, ""},
                                 fmt::format("the face refers to vertex {}, but the file has {}",
                                             corner.position + 1, file_.positions.size()));
            dropMissing(corner.uv, file_.uvs.size(), face,
                        "indices of texture coordinates that do "
                        "not exist");
            dropMissing(corner.normal, file_.normals.size(), face,
                        "indices of normals that do not "
                        "exist");
        }
    }

    void dropMissing(int& index, std::size_t count, const ObjFace& face, const char* what) {
        if (index < static_cast<long long>(count)) return;
        index = -1;
        skip(what, face.line);
    }

    LineReader reader_;
    ImportReport& report_;
    ObjFile file_;
    std::map<std::string, Skipped> skipped_;
    std::unordered_map<std::string, int> materialIndex_;
    std::string partName_;
    int material_ = -1, smoothing_ = 0;
};

}  // namespace

ObjFile parseObj(const std::string& path, std::string_view text, ImportReport& report) {
    return ObjParser(path, text, report).parse();
}

}  // namespace vlf
