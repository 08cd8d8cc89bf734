#pragma once
// What rays of traced reflections read, in the memory of the GPU.

#include "vlf/field/light_field.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <vector>

namespace vlf::gl {

class HitBuffers {
  public:
    /// `mirrorTriangles` are the scene's triangles by those of the mirrors' batches. Throws
    /// InputError if one of the buffers exceeds what the GPU can hold.
    HitBuffers(const Scene& scene, const std::vector<Chart>& charts,
               const std::vector<TriangleCharts>& triangleCharts,
               const std::vector<std::uint32_t>& mirrorTriangles);

    /// Binds all to their units (shaders/shared.h).
    void bind() const;

    std::uint64_t bytes() const { return bytes_; }

  private:
    struct Row {
        int unit;
        Buffer buffer;
        TextureObject texture;
    };

    template <class Item>
    void add(int unit, const std::vector<Item>& items, GLenum format, std::size_t texelBytes);

    std::vector<Row> rows_;
    std::uint64_t bytes_ = 0;
};

}  // namespace vlf::gl
