#include "vlf/render/gl/object_lights.h"

#include "vlf/base/error.h"
#include "vlf/field/radiance_field.h"
#include "vlf/render/gl/shaders/shared.h"

#include <algorithm>
#include <string>

namespace vlf::gl {

namespace {

constexpr std::uint32_t kLeastWidth = 512;  // of the atlas

std::size_t limitOf(GLenum name) {
    GLint most = 0;
    glGetIntegerv(name, &most);
    return static_cast<std::size_t>(most);
}

}  // namespace

ObjectLights::ObjectLights() : vertexTexture_(makeTexture(GL_TEXTURE_BUFFER)) {
    arrange();
}

ObjectLights::Shown ObjectLights::shownOf(const LitObject& object) {
    if (object.texels) return {0, object.atlas->width, object.atlas->height, object.version};
    return {object.vertexIrradiance.size(), 0, 0, object.version};
}

void ObjectLights::update(std::span<const LitObject> objects) {
    wanted_.clear();
    for (const LitObject& object : objects) wanted_.push_back(shownOf(object));
    const bool rearranged =
        wanted_.size() != shown_.size() ||
        !std::equal(wanted_.begin(), wanted_.end(), shown_.begin(),
                    [](const Shown& a, const Shown& b) { return a.sameSize(b); });
    if (rearranged) {
        shown_.clear();
        arrange();
    }
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (rearranged || shown_[i].version != wanted_[i].version) load(objects[i], places_[i]);
    std::swap(wanted_, shown_);
}

/// Vertices one after the other; atlases on shelves.
void ObjectLights::arrange() {
    places_.assign(wanted_.size(), {});
    std::size_t vertices = 0;
    std::uint32_t width = kLeastWidth, x = 0, y = 0, shelf = 0;
    for (const Shown& s : wanted_) width = std::max(width, s.width);
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
        const Shown& s = wanted_[i];
        if (x + s.width > width) {
            y += shelf;
            x = shelf = 0;
        }
        places_[i] = {static_cast<std::uint32_t>(vertices), x, y};
        vertices += s.vertices;
        x += s.width;
        shelf = std::max(shelf, s.height);
    }
    makeAtlas(width, y + shelf);
    if (vertexLight_ && vertices <= vertexCapacity_) return;
    if (vertices > limitOf(GL_MAX_TEXTURE_BUFFER_SIZE))
        throw InputError("the objects have more vertices (" + std::to_string(vertices) +
                         ") than this GPU holds; subdivide them less, or render with --backend "
                         "cpu");
    vertexCapacity_ = std::max<std::size_t>(vertices, 64);
    vertexLight_ = makeBuffer(nullptr, vertexCapacity_ * sizeof(Vec3), GL_DYNAMIC_STORAGE_BIT);
    glTextureBuffer(vertexTexture_.id(), GL_RGB32F, vertexLight_.id());
}

void ObjectLights::makeAtlas(std::uint32_t width, std::uint32_t height) {
    if (atlas_ && width <= width_ && height <= height_) return;
    if (std::max(width, height) > limitOf(GL_MAX_TEXTURE_SIZE))
        throw InputError("the objects have more texels (" + std::to_string(width) + " x " +
                         std::to_string(height) +
                         ") than a texture of this GPU; light them more coarsely, or render with "
                         "--backend cpu");
    width_ = height == 0 ? 1 : width;
    height_ = std::max(height, 1u);
    atlas_ = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(atlas_.id(), 1, GL_RGB9_E5, static_cast<GLsizei>(width_),
                       static_cast<GLsizei>(height_));
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTextureParameteri(atlas_.id(), wrap, GL_CLAMP_TO_EDGE);
    glTextureParameteri(atlas_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
}

void ObjectLights::load(const LitObject& object, const Place& place) {
    if (object.texels) {
        const IrradianceAtlas& light = *object.atlas;
        packed_.resize(light.irradiance.size());
        std::transform(light.irradiance.begin(), light.irradiance.end(), packed_.begin(),
                       packRgb9e5);
        glTextureSubImage2D(atlas_.id(), 0, static_cast<GLint>(place.x),
                            static_cast<GLint>(place.y), static_cast<GLsizei>(light.width),
                            static_cast<GLsizei>(light.height), GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV,
                            packed_.data());
    } else if (!object.vertexIrradiance.empty()) {
        glNamedBufferSubData(vertexLight_.id(),
                             static_cast<GLintptr>(sizeof(Vec3) * place.firstVertex),
                             static_cast<GLsizeiptr>(object.vertexIrradiance.size_bytes()),
                             object.vertexIrradiance.data());
    }
}

void ObjectLights::bind() const {
    glBindTextureUnit(shared::kVertexLightUnit, vertexTexture_.id());
    glBindTextureUnit(shared::kObjectAtlasUnit, atlas_.id());
}

std::uint64_t ObjectLights::bytes() const {
    return vertexCapacity_ * sizeof(Vec3) + std::uint64_t{4} * width_ * height_;
}

}  // namespace vlf::gl
