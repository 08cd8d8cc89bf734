#include "vlf/dynamic/irradiance_cache.h"

#include "vlf/math/random.h"

#include <glm/common.hpp>

namespace vlf {

namespace {
constexpr float kNormalSteps = 6;  // to a unit along each axis: about 10 degrees
}

void IrradianceCache::begin(float cell) {
    if (cell != cell_ || values_.size() > kMaxSize) clear();
    cell_ = cell;
}

std::uint64_t IrradianceCache::key(const Vec3& position, const Vec3& normal) const {
    std::uint64_t key = 0;
    const auto add = [&](float x) {
        const auto cell = static_cast<std::int64_t>(std::floor(x));
        key = mixBits(key + static_cast<std::uint64_t>(cell) + 0x9e3779b97f4a7c15ull);
    };
    for (int axis = 0; axis < 3; ++axis) add(position[axis] / cell_);
    for (int axis = 0; axis < 3; ++axis) add(kNormalSteps * normal[axis] + 0.5f);
    return key;
}

std::optional<Vec3> IrradianceCache::find(const Vec3& position, const Vec3& normal) const {
    const auto found = values_.find(key(position, normal));
    if (found == values_.end()) return std::nullopt;
    return found->second;
}

void IrradianceCache::store(const Vec3& position, const Vec3& normal, const Vec3& irradiance) {
    values_.insert_or_assign(key(position, normal), irradiance);
}

}  // namespace vlf
