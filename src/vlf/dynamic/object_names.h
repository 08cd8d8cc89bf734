#pragma once
// The names that files, options and panels use for an object's settings.

#include "vlf/dynamic/object.h"

#include <array>
#include <string>

namespace vlf {

template <typename Value>
struct NamedValue {
    const char* name;
    Value value;
};

inline constexpr std::array kShadingNames{
    NamedValue<Shading>{"flat", Shading::flat}, NamedValue<Shading>{"lights", Shading::lights},
    NamedValue<Shading>{"gather", Shading::gather}, NamedValue<Shading>{"prt", Shading::prt}};

inline constexpr std::array kShadowNames{NamedValue<ShadowKind>{"none", ShadowKind::none},
                                         NamedValue<ShadowKind>{"hard", ShadowKind::hard},
                                         NamedValue<ShadowKind>{"soft", ShadowKind::soft},
                                         NamedValue<ShadowKind>{"field", ShadowKind::field}};

inline constexpr std::array kGatherPointNames{
    NamedValue<GatherPoints>{"vertices", GatherPoints::vertices},
    NamedValue<GatherPoints>{"texels", GatherPoints::texels}};

template <typename Names, typename Value>
const char* nameAmong(const Names& names, Value value) {
    for (const auto& named : names)
        if (named.value == value) return named.name;
    return "";
}

}  // namespace vlf
