#include "vlf/scene/import/mtl_file.h"

#include "vlf/scene/import/text_lines.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace vlf {

namespace {

/// Options of map statements and the number of words that follow each at least and at most.
struct MapOption {
    std::string_view name;
    int least, most;
};
constexpr MapOption kMapOptions[] = {
    {"-blendu", 1, 1}, {"-blendv", 1, 1},  {"-bm", 1, 1},   {"-boost", 1, 1},     {"-cc", 1, 1},
    {"-clamp", 1, 1},  {"-imfchan", 1, 1}, {"-mm", 2, 2},   {"-o", 1, 3},         {"-s", 1, 3},
    {"-t", 1, 3},      {"-texres", 1, 1},  {"-type", 1, 1}, {"-colorspace", 1, 1}};

const MapOption* findOption(std::string_view word) {
    const auto* it = std::find_if(std::begin(kMapOptions), std::end(kMapOptions),
                                  [&](const MapOption& o) { return o.name == word; });
    return it == std::end(kMapOptions) ? nullptr : it;
}

bool isNumber(std::string_view word) {
    const auto number = parseNumber(word);
    return number && number->complete;
}

class MtlParser {
  public:
    MtlParser(const std::string& path, std::string_view text, ImportReport& report)
        : path_(path), reader_(text), report_(report) {}

    std::vector<MtlMaterial> parse() {
        while (reader_.next()) parseLine(reader_.line());
        return std::move(materials_);
    }

  private:
    SourceLocation here() const { return {path_, reader_.number(), ""}; }

    void parseLine(std::string_view line) {
        WordReader words(line);
        const std::string_view key = words.next();
        if (key.empty() || key.starts_with('#')) return;
        if (key == "newmtl") {
            materials_.emplace_back();
            materials_.back().name = words.rest();
            materials_.back().path = path_;
            materials_.back().line = reader_.number();
        } else if (!materials_.empty()) {
            parseProperty(materials_.back(), key, words);
        }
    }

    void parseProperty(MtlMaterial& m, std::string_view key, WordReader& words) {
        if (key == "Kd")
            m.diffuse = parseColour(words);
        else if (key == "Ks")
            m.specular = parseColour(words);
        else if (key == "Ke")
            m.emission = parseColour(words);
        else if (key == "Tf")
            m.filter = parseColour(words);
        else if (key == "Ni")
            m.ior = parseValue(words.next());
        else if (key == "Ns")
            m.exponent = parseValue(words.next());
        else if (key == "Pr")
            m.roughness = parseValue(words.next());
        else if (key == "d")
            parseOpacity(m, words);
        else if (key == "Tr")
            parseTransparency(m, words);
        else if (key == "illum")
            parseIllumination(m, words.next());
        else if (key == "map_Kd")
            m.diffuseMap = parseMap(words);
        else if (key == "map_Ks")
            m.specularMap = parseMap(words);
        else if (key == "map_Ke")
            m.emissionMap = parseMap(words);
        else if (key == "map_d")
            m.opacityMap = parseMap(words);
    }

    std::optional<float> parseValue(std::string_view word) {
        const auto number = parseNumber(word);
        if (number && std::isfinite(number->value) && std::abs(number->value) < 1e30)
            return static_cast<float>(number->value);
        warn(report_, here(),
             fmt::format("'{}' is not a usable number; the statement is left out", word));
        return std::nullopt;
    }

    /// One number means grey.
    std::optional<Vec3> parseColour(WordReader& words) {
        const auto red = parseValue(words.next());
        if (!red) return std::nullopt;
        Vec3 colour(*red);
        for (int i = 1; i < 3; ++i) {
            const std::string_view word = words.next();
            if (word.empty() || word.starts_with('#')) break;
            const auto value = parseValue(word);
            if (!value) return std::nullopt;
            colour[i] = *value;
        }
        return colour;
    }

    /// d goes before Tr, of which exporters make both transparency and opacity.
    void parseOpacity(MtlMaterial& m, WordReader& words) {
        std::string_view word = words.next();
        if (word == "-halo") word = words.next();
        if (const auto d = parseValue(word)) {
            m.opacity = std::clamp(*d, 0.0f, 1.0f);
            hasOpacity_ = &m - materials_.data();
        }
    }

    void parseTransparency(MtlMaterial& m, WordReader& words) {
        if (hasOpacity_ == &m - materials_.data()) return;
        if (const auto transparency = parseValue(words.next()))
            m.opacity = 1 - std::clamp(*transparency, 0.0f, 1.0f);
    }

    void parseIllumination(MtlMaterial& m, std::string_view word) {
        const auto model = parseInteger(word);
        if (model && *model >= 0 && *model <= 10)
            m.illumination = static_cast<int>(*model);
        else
            warn(report_, here(), fmt::format("unknown illumination model '{}' is left out", word));
    }

    /// Options, then a file name that may hold blanks.
    MtlTexture parseMap(WordReader& words) {
        MtlTexture map;
        map.line = reader_.number();
        for (;;) {
            const std::string name(words.rest());
            WordReader ahead = words;
            const MapOption* option = findOption(ahead.next());
            if (!option) {
                map.file = name;
                return map;
            }
            words = ahead;
            parseMapOption(map, *option, words);
        }
    }

    static void parseMapOption(MtlTexture& map, const MapOption& option, WordReader& words) {
        std::array<std::string_view, 3> operands;
        int count = 0;
        while (count < option.most) {
            WordReader ahead = words;
            const std::string_view word = ahead.next();
            if (count >= option.least && !isNumber(word)) break;
            operands[count++] = word;
            words = ahead;
        }
        if (option.name == "-clamp") map.clamp = operands[0] == "on";
        if (option.name == "-imfchan") map.channel = operands[0].empty() ? '\0' : operands[0][0];
        if (option.name == "-s") map.scale = toVec2(operands, map.scale);
        if (option.name == "-o") map.offset = toVec2(operands, map.offset);
    }

    static Vec2 toVec2(const std::array<std::string_view, 3>& words, Vec2 value) {
        for (int i = 0; i < 2; ++i) {
            const auto number = parseNumber(words[i]);
            if (number && std::abs(number->value) < 1e6)
                value[i] = static_cast<float>(number->value);
        }
        return value;
    }

    std::string path_;
    LineReader reader_;
    ImportReport& report_;
    std::vector<MtlMaterial> materials_;
    std::ptrdiff_t hasOpacity_ = -1;  ///< the material whose opacity came from d
};

}  // namespace

std::vector<MtlMaterial> parseMtl(const std::string& path, std::string_view text,
                                  ImportReport& report) {
    return MtlParser(path, text, report).parse();
}

}  // namespace vlf
