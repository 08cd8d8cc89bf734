#pragma once
// Gathered irradiance kept by place and normal, for objects that come by again (in the manner of
// Ward, Rubinstein and Clear, "A ray tracing solution for diffuse interreflection", SIGGRAPH 1988,
// on a fixed grid).

#include "vlf/math/vector.h"

#include <cstdint>
#include <optional>
#include <unordered_map>

namespace vlf {

/// One value for each cell of space and of directions, the first that is stored there. It forgets
/// all when it has grown to kMaxSize.
class IrradianceCache {
  public:
    static constexpr std::size_t kMaxSize = 1u << 20;

    /// Another width of cells, metres, clears it.
    void setCell(float cell);

    std::optional<Vec3> find(const Vec3& position, const Vec3& normal) const;
    void store(const Vec3& position, const Vec3& normal, const Vec3& irradiance);
    void clear() { values_.clear(); }
    std::size_t size() const { return values_.size(); }

  private:
    std::uint64_t key(const Vec3& position, const Vec3& normal) const;

    float cell_ = 1;
    std::unordered_map<std::uint64_t, Vec3> values_;
};

}  // namespace vlf
