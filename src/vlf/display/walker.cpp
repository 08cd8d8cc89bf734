#include "vlf/display/walker.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

namespace {

constexpr float kRoomHeight = 2.4f;  // where a grown person fits in comfortably, metres
constexpr float kGravity = 9.81f;
constexpr float kClimb = 7;                // step heights a second
constexpr float kLongestStep = 1.0f / 60;  // seconds between looks at the floor
constexpr int kLevels = 5;                 // at which walls are felt, from knee to eye
constexpr int kAround = 16;                // directions in which they are
constexpr int kPushes = 4;                 // a corner takes two, a sharp one more
constexpr float kLevelNormal = 0.2f;       // surfaces flatter than this are no walls
constexpr float kHead = 0.06f;             // above the eye, of its height
constexpr float kHair = 1e-3f;             // of the eye's height

const std::array<Vec3, kAround>& around() {
    static const auto directions = [] {
        std::array<Vec3, kAround> d;
        for (int i = 0; i < kAround; ++i) {
            const float angle = 2 * kPi * static_cast<float>(i) / kAround;
            d[i] = {std::cos(angle), 0, std::sin(angle)};
        }
        return d;
    }();
    return directions;
}

Vec3 up(float metres) {
    return {0, metres, 0};
}

}  // namespace

Body bodyFor(const Bounds& room) {
    const float scale = std::clamp(room.size().y / kRoomHeight, 1e-6f, 1.0f);
    const Body grown;
    return {scale * grown.eyeHeight, scale * grown.radius, scale * grown.stepHeight};
}

Walker::Walker(const Scene& scene, const RayScene& rays, const Body& body)
    : scene_(scene), rays_(rays), body_(body) {}

void Walker::setEyeHeight(float metres) {
    const float scale = metres / body_.eyeHeight;
    body_ = {metres, scale * body_.radius, scale * body_.stepHeight};
}

void Walker::placeEye(const Vec3& eye) {
    feet_ = eye - up(body_.eyeHeight);
    fallSpeed_ = 0;
    if (const auto floor = levelBeneath(eye)) feet_.y = std::max(feet_.y, *floor);
}

Vec3 Walker::eye() const {
    return feet_ + up(eyeHeightBelowCeiling());
}

/// Who stands under a low ceiling stoops.
float Walker::eyeHeightBelowCeiling() const {
    const float head = kHead * body_.eyeHeight;
    const Ray ray{feet_ + up(body_.stepHeight), up(1), 0, body_.eyeHeight + head};
    const Hit hit = rays_.closest(ray);
    return hit ? std::min(body_.eyeHeight, body_.stepHeight + std::max(hit.t - head, 0.0f))
               : body_.eyeHeight;
}

std::optional<float> Walker::levelBeneath(const Vec3& point) const {
    const Hit hit = rays_.closest({point, up(-1)});
    return hit ? std::optional(point.y - hit.t) : std::nullopt;
}

void Walker::advance(const Vec3& way, float seconds) {
    // Short enough for no wall to be reached before it is felt.
    const float steps =
        std::ceil(std::max({1.0f, 2 * glm::length(way) / body_.radius, seconds / kLongestStep}));
    for (int i = 0; i < static_cast<int>(steps); ++i) step(way / steps, seconds / steps);
}

void Walker::step(const Vec3& way, float seconds) {
    moveUnblocked(way);
    for (int i = 0; i < kPushes; ++i) {
        const Contact contact = deepestContact();
        if (contact.push <= 0) break;
        moveUnblocked(contact.push * contact.direction);
    }
    settle(seconds);
}

/// Heights over the feet at which walls are looked for: evenly from knee to eye, and just below the
/// top of whatever reaches into the body, such as the board of a table.
std::vector<float> Walker::obstacleHeights() const {
    const float eye = eyeHeightBelowCeiling(), knee = std::min(1.05f * body_.stepHeight, eye);
    std::vector<float> heights;
    for (int i = 0; i < kLevels; ++i)
        heights.push_back(knee + (eye - knee) * static_cast<float>(i) / (kLevels - 1));
    std::array<Ray, kAround> rays;
    std::array<Hit, kAround> hits;
    for (int i = 0; i < kAround; ++i)
        rays[i] = {feet_ + up(eye) + body_.radius * around()[i], up(-1), 0, eye - knee};
    rays_.closest(rays, hits);
    float last = -1;
    for (const Hit& hit : hits) {
        const float height = eye - hit.t - kHair * body_.eyeHeight;
        if (hit && height > knee && height != last) heights.push_back(last = height);
    }
    return heights;
}

/// Moves as far as the axis of the body meets no surface.
void Walker::moveUnblocked(const Vec3& way) {
    const float length = glm::length(way);
    if (!(length > 0)) return;
    const float gap = kHair * body_.eyeHeight + rays_.epsilon();
    float free = length;
    for (const float height : obstacleHeights()) {
        const Hit hit = rays_.closest({feet_ + up(height), way / length, 0, length + gap});
        if (hit) free = std::min(free, std::max(hit.t - gap, 0.0f));
    }
    feet_ += free / length * way;
}

/// The surface that reaches furthest into the body, and how to get out of it.
Walker::Contact Walker::deepestContact() const {
    Contact deepest;
    std::array<Ray, kAround> rays;
    std::array<Hit, kAround> hits;
    for (const float height : obstacleHeights()) {
        for (int i = 0; i < kAround; ++i)
            rays[i] = {feet_ + up(height), around()[i], 0, body_.radius};
        rays_.closest(rays, hits);
        for (int i = 0; i < kAround; ++i) {
            if (!hits[i]) continue;
            Vec3 normal = geometricNormal(scene_, hits[i].triangle);
            normal.y = 0;
            if (glm::length(normal) < kLevelNormal) continue;
            normal = glm::normalize(normal);
            const float cosine = -glm::dot(normal, around()[i]);
            const float push = (body_.radius - hits[i].t) * std::abs(cosine);
            if (push > deepest.push) deepest = {push, cosine > 0 ? normal : -normal};
        }
    }
    return deepest;
}

/// Brings the feet to the floor: at once over a step up or down, else by falling.
void Walker::settle(float seconds) {
    const auto floor = levelBeneath(feet_ + up(body_.stepHeight));
    if (!floor) {
        fallSpeed_ = 0;
        return;
    }
    const float above = feet_.y - *floor;
    if (fallSpeed_ == 0 && above <= body_.stepHeight) {
        const float climb = kClimb * body_.stepHeight * seconds;
        feet_.y -= std::clamp(above, -climb, climb);
        return;
    }
    feet_.y -= fallSpeed_ * seconds + 0.5f * kGravity * seconds * seconds;
    fallSpeed_ += kGravity * seconds;
    if (feet_.y <= *floor) {
        feet_.y = *floor;
        fallSpeed_ = 0;
    }
}

}  // namespace vlf
