#pragma once
// The light on all objects, in the memory of the GPU: one row of irradiances by vertex, and one
// atlas.

#include "vlf/dynamic/lit_object.h"
#include "vlf/render/gl/gl_object.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf::gl {

class ObjectLights {
  public:
    /// Where an object's light lies.
    struct Place {
        std::uint32_t firstVertex = 0;  ///< of its irradiances by vertex
        std::uint32_t x = 0, y = 0;     ///< of its atlas
    };

    ObjectLights();

    /// Copies what has changed since the call before. Throws InputError if the objects have more
    /// texels or vertices than the GPU holds.
    void update(std::span<const LitObject> objects);

    const Place& place(std::size_t object) const { return places_[object]; }

    /// Binds both to their units (shaders/shared.h).
    void bind() const;

    std::uint64_t bytes() const;

  private:
    /// An object's light.
    struct Shown {
        std::size_t vertices = 0;
        std::uint32_t width = 0, height = 0;
        std::uint64_t version = 0;

        bool sameSize(const Shown& o) const {
            return vertices == o.vertices && width == o.width && height == o.height;
        }
    };
    static Shown shownOf(const LitObject& object);

    void arrange();
    void makeAtlas(std::uint32_t width, std::uint32_t height);
    void load(const LitObject& object, const Place& place);

    std::vector<Shown> shown_, wanted_;  ///< copied last and to be copied
    std::vector<Place> places_;
    std::vector<std::uint32_t> packed_;
    Buffer vertexLight_;
    TextureObject vertexTexture_, atlas_;
    std::size_t vertexCapacity_ = 0;
    std::uint32_t width_ = 0, height_ = 0;
};

}  // namespace vlf::gl
