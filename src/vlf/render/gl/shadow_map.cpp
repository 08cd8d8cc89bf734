#include "vlf/render/gl/shadow_map.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace vlf::gl {

namespace {

constexpr float kWidest = 1.48f;    // half the angle of view, radians
constexpr float kNearest = 0.01f;   // the near plane, of the distance to the objects
constexpr float kFarthest = 1e30f;  // where there is nothing

}  // namespace

void ShadowMap::update(const DynamicRoom& room, std::span<const Vec4> spheres) {
    casters_.clear();
    wantedSize_ = 0;
    const PointLight* light = room.hardShadowLight();
    for (std::size_t i = 0; light && i < spheres.size(); ++i) {
        const ObjectSettings& settings = room.object(room.litNumbers()[i]).settings;
        if (settings.shadow != ShadowKind::hard || settings.hard.opacity <= 0) continue;
        casters_.push_back({i, settings.hard.opacity});
        wantedSize_ = std::max(wantedSize_, settings.hard.mapSize);
    }
    if (casters_.empty()) return;
    // The most opaque last: where several are in the way it counts.
    std::stable_sort(casters_.begin(), casters_.end(),
                     [](const Caster& a, const Caster& b) { return a.opacity < b.opacity; });
    aim(*light, spheres);
    stale_ = true;
}

/// At the middle of the box around the casters' spheres.
void ShadowMap::aim(const PointLight& light, std::span<const Vec4> spheres) {
    Vec3 lower(kFarthest), upper(-kFarthest);
    for (const Caster& c : casters_) {
        lower = glm::min(lower, Vec3(spheres[c.object]) - spheres[c.object].w);
        upper = glm::max(upper, Vec3(spheres[c.object]) + spheres[c.object].w);
    }
    const Vec3 centre = 0.5f * (lower + upper);
    const float distance = std::max(glm::distance(light.position, centre), 1e-6f);
    const Vec3 forward = (centre - light.position) / distance;
    float half = 0;
    for (const Caster& c : casters_) {
        const Vec3 to = Vec3(spheres[c.object]) - light.position;
        const float length = std::max(glm::length(to), 1e-6f), radius = spheres[c.object].w;
        const float off = std::acos(std::clamp(glm::dot(to, forward) / length, -1.0f, 1.0f));
        half = std::max(half, off + std::asin(std::min(radius / length, 1.0f)));
    }
    half = std::clamp(half, 1e-4f, kWidest);
    const Vec3 up = std::abs(forward.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    data_.clipFromWorld = glm::infinitePerspective(2 * half, 1.0f, kNearest * distance) *
                          glm::lookAt(light.position, light.position + forward, up);
    data_.light = Vec4(light.position, light.cone.y > 0 ? light.cone.x : 0);
    data_.normal = Vec4(light.normal, 2 * std::tan(half) / static_cast<float>(wantedSize_));
}

void ShadowMap::require(int size) {
    if (size == size_) return;
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    size_ = std::min(size, most);
    map_ = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(map_.id(), 1, GL_RGBA32F, size_, size_);
    glTextureParameteri(map_.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(map_.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    depth_ = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(depth_.id(), 1, GL_DEPTH_COMPONENT32F, size_, size_);
    framebuffer_ = makeFramebuffer();
    glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, map_.id(), 0);
    glNamedFramebufferTexture(framebuffer_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
    if (!buffer_) buffer_ = makeBuffer(nullptr, sizeof(shared::ShadowData), GL_DYNAMIC_STORAGE_BIT);
}

void ShadowMap::draw(GLuint roomProgram, GLuint objectProgram,
                     const std::function<void()>& drawRoom,
                     const std::function<void(std::size_t)>& drawObject) {
    stale_ = false;
    require(wantedSize_);
    glNamedBufferSubData(buffer_.id(), 0, sizeof data_, &data_);
    glBindBufferBase(GL_UNIFORM_BUFFER, shared::kShadowBlock, buffer_.id());
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, size_, size_);
    for (const GLenum off : {GL_SCISSOR_TEST, GL_BLEND, GL_STENCIL_TEST, GL_CULL_FACE,
                             GL_POLYGON_OFFSET_FILL, GL_FRAMEBUFFER_SRGB})
        glDisable(off);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(kFarthest, 0, kFarthest, 0);
    glClearDepthf(1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(roomProgram);
    glColorMask(GL_FALSE, GL_FALSE, GL_TRUE, GL_FALSE);
    drawRoom();
    glUseProgram(objectProgram);
    glColorMask(GL_TRUE, GL_TRUE, GL_FALSE, GL_FALSE);
    glClear(GL_DEPTH_BUFFER_BIT);
    for (const Caster& c : casters_) {
        glUniform1f(shared::kOpacityLocation, c.opacity);
        drawObject(c.object);
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void ShadowMap::bind() const {
    glBindTextureUnit(shared::kShadowUnit, map_.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, shared::kShadowBlock, buffer_.id());
}

std::uint64_t ShadowMap::bytes() const {
    return std::uint64_t{20} * static_cast<std::uint64_t>(size_) *
           static_cast<std::uint64_t>(size_);
}

}  // namespace vlf::gl
