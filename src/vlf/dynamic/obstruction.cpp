#include "vlf/dynamic/obstruction.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

namespace {

constexpr std::size_t kMaxPieces = 64;
constexpr float kPieceRadius = 0.3f;  // of the light's
constexpr std::size_t kMaxTriangles = 16;
constexpr float kSlack = 1e-4f;  // of the light's radius

float square(float x) {
    return x * x;
}

/// Whether a line from within `receiver` to within `light` may meet `object`: the cones that the
/// two spheres fill overlap.
bool conesOverlap(const Sphere& receiver, const Sphere& light, const Sphere& object) {
    const Vec3 toLight = light.centre - receiver.centre;
    const Vec3 toObject = object.centre - receiver.centre;
    const float lightDistance = glm::length(toLight), objectDistance = glm::length(toObject);
    const float objectReach = object.radius + receiver.radius;
    const float lightReach = light.radius + receiver.radius;
    if (objectDistance - objectReach > lightDistance + lightReach) return false;
    if (objectDistance <= objectReach || lightDistance <= lightReach) return true;
    // Angles by their sines and cosines: that between the axes is no more than the cones' sum.
    const float sineA = lightReach / lightDistance, sineB = objectReach / objectDistance;
    const float cosineA = std::sqrt(1 - square(sineA)), cosineB = std::sqrt(1 - square(sineB));
    const float cosine = glm::dot(toLight, toObject) / (lightDistance * objectDistance);
    return cosine >= cosineA * cosineB - sineA * sineB;
}

void addPieces(const std::array<Vec3, 3>& triangle, float radius, std::vector<Sphere>& pieces) {
    const auto& [a, b, c] = triangle;
    const Vec3 centre = (a + b + c) / 3.0f;
    const float reach =
        std::max({glm::distance(a, centre), glm::distance(b, centre), glm::distance(c, centre)});
    if (reach <= radius || pieces.size() > kMaxPieces) {
        pieces.push_back({centre, reach});
        return;
    }
    const Vec3 ab = 0.5f * (a + b), bc = 0.5f * (b + c), ca = 0.5f * (c + a);
    for (const auto& part : {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c},
                             std::array{ab, bc, ca}})
        addPieces(part, radius, pieces);
}

std::vector<Sphere> piecesOf(const Scene& scene, const Light& light) {
    std::vector<Sphere> pieces;
    if (light.kind != LightKind::surface) return pieces;
    for (const std::uint32_t t : light.triangles)
        addPieces({scene.position(t, 0), scene.position(t, 1), scene.position(t, 2)},
                  kPieceRadius * light.radius, pieces);
    if (pieces.size() > kMaxPieces) pieces.clear();
    return pieces;
}

}  // namespace

LightPlane::LightPlane(const Scene& scene, const Light& light, const Affine& imageFromWorld) {
    if (light.kind != LightKind::surface || !light.planar || light.triangles.size() > kMaxTriangles)
        return;
    normal_ = imageFromWorld.vector(light.normal);
    for (const std::uint32_t t : light.triangles) {
        std::array<Vec3, 3> corner;
        for (int c = 0; c < 3; ++c) corner[c] = imageFromWorld.point(scene.position(t, c));
        auto& edges = triangles_.emplace_back();
        for (int c = 0; c < 3; ++c) {
            const Vec3 along = corner[(c + 1) % 3] - corner[c];
            Vec3 inward = glm::cross(normal_, along);
            if (glm::dot(inward, corner[(c + 2) % 3] - corner[c]) < 0) inward = -inward;
            const float slack = kSlack * glm::length(inward) * light.radius;
            edges[c] = {inward, glm::dot(inward, corner[c]) - slack};
        }
        offset_ = glm::dot(normal_, corner[0]);
    }
}

Obstructions::Obstructions(const Scene& scene, const RayScene& rays, const RoomTexels& room)
    : room_(room), gatherer_(scene, rays, room.unwrap, room.sources, 0) {
    for (const LightImage& image : room.sources.images) {
        const Light& light = room.sources.lights[image.light];
        Obstruction& o = all_.emplace_back();
        o.light = {image.imageFromWorld.point(light.centre), light.radius};
        o.pieces = piecesOf(scene, light);
        for (Sphere& piece : o.pieces) piece.centre = image.imageFromWorld.point(piece.centre);
        o.plane = LightPlane(scene, light, image.imageFromWorld);
    }
}

ShadowCaster casterOf(const ObjectModel& model, const Pose& pose) {
    return {&model, pose, {pose.point(model.bounds().centre), pose.scale * model.bounds().radius}};
}

Vec3 Obstructions::reflectAt(std::uint32_t mirror, const Vec3& place) const {
    const Vec3& n = room_.unwrap.charts[mirror].normal;
    return place - 2 * (glm::dot(n, place) - room_.sources.mirrorOffset[mirror]) * n;
}

Vec3 Obstructions::unfold(Vec3 place, std::size_t image, int segment) const {
    const LightImage& of = room_.sources.images[image];
    for (int k = segment - 1; k >= 0; --k) place = reflectAt(of.mirror[k], place);
    return place;
}

Vec3 Obstructions::unfoldDirection(Vec3 direction, std::size_t image, int segment) const {
    const LightImage& of = room_.sources.images[image];
    for (int k = segment - 1; k >= 0; --k)
        direction = glm::reflect(direction, room_.unwrap.charts[of.mirror[k]].normal);
    return direction;
}

Vec3 Obstructions::fold(Vec3 place, std::size_t image, int segment) const {
    const LightImage& of = room_.sources.images[image];
    for (int k = 0; k < segment; ++k) place = reflectAt(of.mirror[k], place);
    return place;
}

Vec3 Obstructions::foldDirection(Vec3 direction, std::size_t image, int segment) const {
    const LightImage& of = room_.sources.images[image];
    for (int k = 0; k < segment; ++k)
        direction = glm::reflect(direction, room_.unwrap.charts[of.mirror[k]].normal);
    return direction;
}

void Obstructions::place(std::span<const ShadowCaster> objects) {
    casters_.assign(objects.begin(), objects.end());
    patches_.clear();
    for (const ShadowCaster& caster : casters_)
        for (const SurfacePatch& patch : caster.model->patches())
            patches_.push_back(
                {caster.pose.point(patch.position), caster.pose.direction(patch.normal)});
    for (std::size_t i = 0; i < all_.size(); ++i) {
        all_[i].objects.clear();
        // In the way before the first mirror, between it and the next, and so on.
        for (std::uint32_t number = 0; number < objects.size(); ++number)
            for (int segment = 0; segment <= room_.sources.images[i].depth; ++segment) {
                const Sphere& sphere = objects[number].sphere;
                all_[i].objects.push_back(
                    {{unfold(sphere.centre, i, segment), sphere.radius}, number, segment});
            }
    }
}

bool Obstructions::mayHide(const LightReceiver& receiver, std::size_t image,
                           const Obstruction::Object& object) const {
    const Obstruction& o = all_[image];
    const Sphere sphere{receiver.centre, receiver.radius};
    if (receiver.planar && glm::dot(receiver.normal, object.sphere.centre - receiver.centre) <
                               -object.sphere.radius - receiver.radius)
        return false;
    if (!conesOverlap(sphere, o.light, object.sphere)) return false;
    const LightImage& of = room_.sources.images[image];
    const std::uint32_t mirror = of.mirror[0];
    return o.pieces.empty() || std::ranges::any_of(o.pieces, [&](const Sphere& piece) {
               return conesOverlap(sphere, piece, object.sphere) &&
                      (of.depth == 0 ||
                       mayBeSeenIn(room_.unwrap.charts[mirror], room_.sources.mirrorOffset[mirror],
                                   sphere, piece));
           });
}

bool Obstructions::mayShadow(const LightReceiver& receiver) const {
    for (std::size_t i = 0; i < all_.size(); ++i)
        if (std::ranges::any_of(
                all_[i].objects,
                [&](const Obstruction::Object& object) { return mayHide(receiver, i, object); }) &&
            maySee(receiver, i))
            return true;
    return false;
}

void Obstructions::findShadows(const LightReceiver& receiver, std::vector<MayHide>& found) const {
    found.clear();
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
        const std::size_t before = found.size();
        for (const Obstruction::Object& object : all_[i].objects)
            if (mayHide(receiver, i, object)) found.push_back({i, &object});
        if (found.size() > before && !maySee(receiver, i)) found.resize(before);
    }
}

/// At distance d from the object a penumbra is d times as wide as the light looks.
bool Obstructions::areSmooth(const LightReceiver& receiver,
                             std::span<const MayHide> shadows) const {
    return std::ranges::all_of(shadows, [&](const MayHide& shadow) {
        const Sphere& light = all_[shadow.image].light;
        return glm::distance(receiver.centre, shadow.object->sphere.centre) * light.radius >
               receiver.radius * glm::distance(receiver.centre, light.centre);
    });
}

LightReceiver Obstructions::receiverOf(const TexelGroup& group) const {
    const Chart& chart = room_.unwrap.charts[room_.unwrap.texelChart[room_.grouped[group.first]]];
    LightReceiver receiver;
    receiver.centre = group.bounds.centre;
    receiver.radius = group.bounds.radius;
    receiver.normal = chart.normal;
    receiver.planar = chart.planar;
    return receiver;
}

}  // namespace vlf
