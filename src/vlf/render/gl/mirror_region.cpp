#include "vlf/render/gl/mirror_region.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf::gl {

namespace {

constexpr float kSamePlane = 1e-4f;
constexpr float kMargin = 2;  // pixels

}  // namespace

MirrorPlanes mirrorPlanesOf(const Scene& scene, const LightField& field, const RoomGeometry& room,
                            const RoomBatch& batch) {
    MirrorPlanes mirrors;
    const auto first = static_cast<std::size_t>(batch.data.flags.y);
    for (std::size_t i = 0; i < batch.indexCount / 3 && !mirrors.anywhere; ++i) {
        const std::uint32_t triangle = room.mirrorTriangles[first + i];
        const RoomVertex& corner = room.vertices[room.indices[batch.firstIndex + 3 * i]];
        const Chart& chart = field.charts[room.mirrorCharts[corner.mirror]];
        const Vec4 plane(chart.normal, glm::dot(chart.normal, scene.position(triangle, 0)));
        const bool known =
            std::any_of(mirrors.planes.begin(), mirrors.planes.end(), [&](const Vec4& p) {
                return glm::dot(Vec3(p), Vec3(plane)) > 1 - kSamePlane &&
                       std::abs(p.w - plane.w) < kSamePlane * (1 + std::abs(p.w));
            });
        if (!known) mirrors.planes.push_back(plane);
        mirrors.anywhere = !chart.planar || mirrors.planes.size() > MirrorPlanes::kMost;
    }
    return mirrors;
}

MirrorRegion::MirrorRegion(const View& view, const MirrorPlanes& mirrors)
    : view_(view), mirrors_(mirrors) {}

void MirrorRegion::addSphere(const Vec4& sphere) {
    std::array<Vec3, 8> corners;
    for (int i = 0; i < 8; ++i)
        corners[static_cast<std::size_t>(i)] =
            Vec3(sphere) + sphere.w * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    addHull(corners);
}

void MirrorRegion::addHull(std::span<const Vec3> corners) {
    everywhere_ = everywhere_ || mirrors_.anywhere;
    for (const Vec4& plane : mirrors_.planes) addImage(plane, corners);
}

void MirrorRegion::addImage(const Vec4& plane, std::span<const Vec3> corners) {
    const auto height = [&](const Vec3& p) { return glm::dot(Vec3(plane), p) - plane.w; };
    const bool before =
        std::any_of(corners.begin(), corners.end(), [&](const Vec3& p) { return height(p) > 0; });
    if (!before || height(view_.eye) <= 0) return;
    for (const Vec3& p : corners) {
        const Vec3 image = p - 2 * height(p) * Vec3(plane);
        const Vec4 clip = view_.clipFromWorld * Vec4(image, 1);
        if (clip.w <= 1e-6f) {
            everywhere_ = true;
            return;
        }
        const Vec2 pixel = (0.5f * Vec2(clip) / clip.w + 0.5f) * Vec2(view_.width, view_.height) +
                           Vec2(view_.x, view_.y);
        lower_ = glm::min(lower_, pixel - kMargin);
        upper_ = glm::max(upper_, pixel + kMargin);
    }
}

std::optional<PixelRectangle> MirrorRegion::within(const PixelRectangle& part) const {
    if (everywhere_) return part;
    const Vec2 first(part.x, part.y);
    const Vec2 last = first + Vec2(part.width, part.height);
    const Vec2 lower = glm::max(glm::floor(lower_), first), upper = glm::min(upper_, last);
    if (lower.x >= upper.x || lower.y >= upper.y) return std::nullopt;
    return PixelRectangle{static_cast<int>(lower.x), static_cast<int>(lower.y),
                          static_cast<int>(std::ceil(upper.x) - lower.x),
                          static_cast<int>(std::ceil(upper.y) - lower.y)};
}

}  // namespace vlf::gl
