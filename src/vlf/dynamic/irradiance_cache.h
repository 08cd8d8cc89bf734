#pragma once
// Gathered irradiance kept by place and normal, for objects that come by again (in the manner of
// Ward, Rubinstein and Clear, "A ray tracing solution for diffuse interreflection", SIGGRAPH 1988,
// on a fixed grid).

#include "vlf/math/vector.h"

#include <cstdint>
#include <optional>
#include <unordered_map>

namespace vlf {

/// One value for each cell of space and of directions, the last that is stored there.
class IrradianceCache {
  public:
    static constexpr std::size_t kMaxSize = 1u << 20;

    /// To be called before others look for what they store next. Another width of cells, metres,
    /// clears it, and so do more than kMaxSize values.
    void begin(float cell);

    std::optional<Vec3> find(const Vec3& position, const Vec3& normal) const;
    void store(const Vec3& position, const Vec3& normal, const Vec3& irradiance);
    void clear() { values_.clear(); }

  private:
    std::uint64_t key(const Vec3& position, const Vec3& normal) const;

    float cell_ = 1;
    std::unordered_map<std::uint64_t, Vec3> values_;
};

}  // namespace vlf
