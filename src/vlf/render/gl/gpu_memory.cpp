#include "vlf/render/gl/gpu_memory.h"

#include "vlf/render/gl/radiance_layout.h"
#include "vlf/render/gl/sky_picture.h"

namespace vlf {

std::uint64_t bytesOf(const RoomGeometry& room) {
    return room.vertices.size() * sizeof(RoomVertex) + 4 * room.indices.size();
}

std::uint64_t textureBytes(const Scene& scene) {
    std::uint64_t bytes = 0;
    for (const Texture& t : scene.textures)
        bytes +=
            static_cast<std::uint64_t>(t.width) * t.height * (t.linear.empty() ? 4 : 6) * 4 / 3;
    return bytes + gl::skyBytes(scene.environment);
}

GpuMemory gpuMemoryOf(const Scene& scene, const LightField& field) {
    const RoomGeometry room = makeRoomGeometry(scene, field);
    const RadianceLayout layout = layOutRadiance(field.radiance, room.mirrorCharts);
    const RadianceLayout gloss = layOutRadiance(field.gloss, room.roughCharts);
    GpuMemory memory;
    memory.geometry = bytesOf(room);
    memory.atlas = 4 * field.atlas.irradiance.size();
    memory.radiance = layout.bytes() + gloss.bytes();
    memory.textures = textureBytes(scene);
    memory.radianceElements = layout.elements + gloss.elements;
    return memory;
}

}  // namespace vlf
