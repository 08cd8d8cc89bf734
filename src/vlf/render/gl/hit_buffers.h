#pragma once
// What rays of traced reflections read, in the memory of the GPU: the room, if it is traced, and
// behind it the objects.

#include "vlf/field/light_field.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/object_geometry.h"
#include "vlf/scene/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vlf::gl {

/// Where in the buffers an object's hierarchy and surfaces begin.
struct BodyPlace {
    std::uint32_t firstNode = 0, nodes = 0, firstTriangle = 0;
    std::uint32_t firstRecord = 0, firstTexel = 0;
};

class HitBuffers {
  public:
    HitBuffers();

    /// `mirrorTriangles` are the scene's triangles by those of the mirrors' batches. The objects
    /// are gone then. Throws InputError if one of the buffers exceeds what the GPU can hold.
    void loadRoom(const Scene& scene, const std::vector<Chart>& charts,
                  const std::vector<TriangleCharts>& triangleCharts,
                  const std::vector<std::uint32_t>& mirrorTriangles);
    bool hasRoom() const { return hasRoom_; }
    std::uint32_t roomNodes() const;

    /// These objects and no others. Throws as loadRoom().
    std::vector<BodyPlace> loadObjects(std::span<const ObjectGeometry* const> objects);

    /// Binds all to their units (shaders/shared.h).
    void bind() const;

    std::uint64_t bytes() const;

  private:
    /// A buffer texture: the room's part first.
    struct Row {
        int unit = 0;
        GLenum format = 0;
        std::size_t texelBytes = 0;
        Buffer buffer;
        TextureObject texture;
        std::size_t roomBytes = 0, bytes = 0, capacity = 0;
    };
    enum Kind { nodes, triangles, records, texels, mirrors, kinds };

    template <class Item>
    void setRoom(Kind kind, const std::vector<Item>& items);
    void reserve(Row& row, std::size_t bytes);
    template <class Item>
    void append(Kind kind, const std::vector<Item>& items);
    void show(Row& row);

    std::array<Row, kinds> rows_;
    bool hasRoom_ = false;
};

}  // namespace vlf::gl
