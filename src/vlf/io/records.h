#pragma once
// The members of each struct that is stored as a record, in the order of the file.

#include "vlf/io/byte_stream.h"
#include "vlf/io/chunk_file.h"
#include "vlf/io/field_file.h"

#include <string_view>

namespace vlf {

template <class S>
void describe(S& s, Field<S, Camera> c) {
    s(c.name, c.eye, c.look, c.up, c.verticalFov);
}

template <class S>
void describe(S& s, Field<S, Mesh> m) {
    s(m.name, m.firstTriangle, m.triangleCount);
}

template <class S>
void describe(S& s, Field<S, Material> m) {
    s(m.name, m.diffuse, m.mirror, m.emission);
    s(m.roughness, m.diffuseTexture, m.mirrorTexture, m.emissionTexture, m.emitsBothSides);
    s(m.transmission, m.ior, m.thin);
}

template <class S>
void describe(S& s, Field<S, EnergyReport> e) {
    s(e.emitted, e.absorbed, e.unshot, e.escaped);
}

template <class S>
void describe(S& s, Field<S, BakeRecord> r) {
    s(r.programVersion, r.instructionSet, r.sceneHash, r.preset, r.seed);
    s(r.directions, r.cells, r.radianceDirections, r.radianceCells);
    s(r.glossDirections, r.glossCells, r.tileSize, r.texelSize);
    s(r.directSamples, r.bounces, r.residual, r.texelError, r.interpolatedError, r.energy);
}

template <class S>
void describe(S& s, Field<S, FieldFrame> f) {
    s(f.centre, f.radius);
}

template <class S>
void describe(S& s, Field<S, RadianceCounts> c) {
    s(c.lines, c.cells, c.tileSize, c.maxDistance, c.tileRows, c.elements, c.filled);
}

template <class S>
void describe(S& s, Field<S, FieldCounts> c) {
    s(c.vertices, c.triangles, c.meshes, c.materials, c.textures, c.texturePixels, c.cameras);
    s(c.charts, c.atlasWidth, c.atlasHeight, c.radiance, c.gloss);
}

/// Texture without its pixels.
struct TextureRecord {
    std::string name;
    std::int32_t width = 0, height = 0;
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
    bool linear = false;  ///< float pixels, else 8-bit sRGB
};

template <class S>
void describe(S& s, Field<S, TextureRecord> t) {
    s(t.name, t.width, t.height, t.wrapU, t.wrapV, t.linear);
}

template <class S>
void describe(S& s, Field<S, PunctualLight> l) {
    s(l.name, l.kind, l.position, l.direction, l.intensity, l.innerCone, l.outerCone);
}

/// Environment without its pixels.
template <class S>
void describe(S& s, Field<S, EnvironmentInfo> e) {
    s(e.name, e.radiance, e.turn, e.width, e.height);
}

/// A chunk that holds one record, or a list of them.
template <class T>
void addRecord(ChunkFileWriter& file, const std::string& name, const T& record) {
    file.add(name, bytesOf(record));
}

template <class T>
void readRecord(const ChunkFileReader& file, std::string_view name, T& record) {
    const std::vector<std::uint8_t> content = file.readBytes(name);
    ByteReader bytes(content, file.where(file.chunk(name)));
    bytes(record);
    bytes.expectEnd();
}

}  // namespace vlf
