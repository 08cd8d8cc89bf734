#pragma once
// An element of a JSON file that knows its place in it: what is wrong with it is an InputError that
// names file and element. For modules that link nlohmann_json.

#include "vlf/base/error.h"
#include "vlf/math/vector.h"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vlf {

/// Refers to a value that must outlive it.
struct JsonElement {
    const nlohmann::json& value;
    SourceLocation where;

    [[noreturn]] void fail(const std::string& what) const { throw InputError(where, what); }

    /// Throws unless the value is an object with all members of `needed`, and of others none but
    /// those of `allowed`.
    void requireMembers(std::initializer_list<const char*> needed,
                        std::initializer_list<const char*> allowed = {}) const {
        if (!value.is_object()) fail("must be an object");
        for (const char* name : needed)
            if (!value.contains(name)) fail(fmt::format("has no \"{}\"", name));
        const auto holds = [](std::initializer_list<const char*> names, const std::string& key) {
            return std::find(names.begin(), names.end(), key) != names.end();
        };
        for (const auto& [key, ignored] : value.items())
            if (!holds(needed, key) && !holds(allowed, key))
                fail(fmt::format("has \"{}\", which is not known there", key));
    }

    /// Precondition: the value is an object.
    bool has(const char* name) const { return value.contains(name); }

    /// Precondition: the value has it.
    JsonElement member(const char* name) const {
        const std::string prefix = where.element.empty() ? "" : where.element + ".";
        return {value.at(name), {where.file, 0, prefix + name}};
    }
    JsonElement item(std::size_t i) const {
        return {value.at(i), {where.file, 0, fmt::format("{}[{}]", where.element, i)}};
    }

    /// Items of an array of `what`.
    std::size_t size(const char* what) const {
        if (!value.is_array()) fail(fmt::format("must be an array of {}", what));
        return value.size();
    }

    double number() const {
        if (!value.is_number()) fail("must be a number");
        return value.get<double>();
    }
    double number(double least, double most) const {
        const double x = number();
        if (!(x >= least && x <= most))
            fail(fmt::format("must be a number from {} to {}", least, most));
        return x;
    }
    int whole(int least, int most) const {
        const double x = value.is_number_integer() ? number() : least - 1.0;
        if (!(x >= least && x <= most))
            fail(fmt::format("must be a whole number from {} to {}", least, most));
        return static_cast<int>(x);
    }
    bool flag() const {
        if (!value.is_boolean()) fail("must be true or false");
        return value.get<bool>();
    }
    std::string text() const {
        if (!value.is_string()) fail("must be a text in quotes");
        return value.get<std::string>();
    }
    /// Three numbers, `read` from each item.
    template <typename Read>
    Vec3 point(Read read) const {
        if (!value.is_array() || value.size() != 3) fail("must be an array of three numbers");
        return {static_cast<float>(read(item(0))), static_cast<float>(read(item(1))),
                static_cast<float>(read(item(2)))};
    }
    Vec3 point() const {
        return point([](const JsonElement& e) { return e.number(); });
    }
    Vec3 point(double least, double most) const {
        return point([&](const JsonElement& e) { return e.number(least, most); });
    }
};

/// Throws InputError with the parser's words.
inline nlohmann::json parseJson(std::string_view text, const std::string& nameForErrors) {
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        throw InputError({nameForErrors, 0, ""}, error.what());
    }
}

}  // namespace vlf
