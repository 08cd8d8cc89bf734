#pragma once
// Hard shadows of objects on the room, by a shadow map; render/cpu/hard_shadows.h is the truth.

#include "vlf/dynamic/dynamic_room.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/shaders/shared.h"

#include <functional>
#include <span>
#include <vector>

namespace vlf::gl {

/// One map for all objects that cast hard shadows, as fine as the finest of their settings: what
/// the light sees of them, and how far away the first surface of the room is.
class ShadowMap {
  public:
    struct Caster {
        std::size_t object;  ///< among the lit objects
        float opacity;
    };

    /// From `room`, whose lit objects lie in `spheres` (centre, radius).
    void update(const DynamicRoom& room, std::span<const Vec4> spheres);

    bool empty() const { return casters_.empty(); }

    /// Whether there is one, and it has to be drawn.
    bool stale() const { return stale_ && !empty(); }

    /// Shaders are others.
    void outdate() { stale_ = true; }

    /// Draws the map, to be called when it is stale: `drawRoom` all triangles of the room but
    /// lamps, `drawObject` one object; both with the program and its uniforms as they are bound.
    void draw(GLuint roomProgram, GLuint objectProgram, const std::function<void()>& drawRoom,
              const std::function<void(std::size_t)>& drawObject);

    /// Binds map and data.
    void bind() const;

    std::uint64_t bytes() const;

  private:
    void aim(const PointLight& light, std::span<const Vec4> spheres);
    void require(int size);

    std::vector<Caster> casters_;
    shared::ShadowData data_{};
    int wantedSize_ = 0, size_ = 0;
    bool stale_ = true;
    Buffer buffer_;
    TextureObject map_, depth_;
    Framebuffer framebuffer_;
};

}  // namespace vlf::gl
