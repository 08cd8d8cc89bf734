#include "vlf/render/gl/object_pass.h"

#include <algorithm>
#include <bit>

namespace vlf::gl {

namespace {

using namespace shared;

constexpr GLintptr kGridBytes = GLintptr{16} * kGridTexels;

std::uint32_t bits(float v) {
    return std::bit_cast<std::uint32_t>(v);
}

/// Around spheres, about the middle of their boxes.
Vec4 sphereAround(const std::vector<Vec4>& spheres) {
    Vec3 lower(1e30f), upper(-1e30f);
    for (const Vec4& s : spheres) {
        lower = glm::min(lower, Vec3(s) - s.w);
        upper = glm::max(upper, Vec3(s) + s.w);
    }
    const Vec3 centre = 0.5f * (lower + upper);
    float radius = 0;
    for (const Vec4& s : spheres) radius = std::max(radius, glm::distance(centre, Vec3(s)) + s.w);
    return spheres.empty() ? Vec4(0) : Vec4(centre, radius);
}

Vec4 sphereOf(const LitObject& object, const Sphere& bounds) {
    return Vec4(object.pose.point(bounds.centre), object.pose.scale * bounds.radius);
}

}  // namespace

ObjectPass::ObjectPass(ShaderLibrary& shaders, HitBuffers& hits)
    : shaders_(shaders),
      hits_(hits),
      dataBuffer_(makeBuffer(nullptr, sizeof(ObjectsData), GL_DYNAMIC_STORAGE_BIT)),
      recordTexture_(makeTexture(GL_TEXTURE_BUFFER)) {}

void ObjectPass::update(const DynamicRoom& room) {
    const auto objects = room.litObjects();
    meshes_.update(room, hits_);
    lights_.update(objects);
    records_.clear();
    spheres_.clear();
    places_.clear();
    probeCentres_.clear();
    for (std::size_t i = 0; i < objects.size(); ++i) {
        records_.push_back(recordOf(objects[i], i));
        places_.push_back(objects[i].pose.matrix());
        spheres_.push_back(sphereOf(objects[i], meshes_.mesh(meshes_.meshOf(i)).geometry.bounds));
    }
    data_.sphere = sphereAround(spheres_);
    loadRecords();
}

void ObjectPass::hitsReloaded() {
    meshes_.reload(hits_);
    for (std::size_t i = 0; i < records_.size(); ++i) placeBody(records_[i], i);
    loadRecords();
}

void ObjectPass::placeBody(Record& record, std::size_t number) const {
    const BodyPlace& body = meshes_.mesh(meshes_.meshOf(number)).body;
    record[4] = {record[4][0], body.firstNode, body.nodes, body.firstTriangle};
    record[5] = {body.firstRecord, body.firstTexel, record[5][2], record[5][3]};
}

ObjectPass::Record ObjectPass::recordOf(const LitObject& object, std::size_t number) {
    const GpuObjectMesh& mesh = meshes_.mesh(meshes_.meshOf(number));
    const ObjectLights::Place& light = lights_.place(number);
    const Mat4 m = object.pose.matrix();
    Record record{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            record[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
                bits(m[column][row]);
    const Vec4 sphere = sphereOf(object, mesh.geometry.bounds);
    record[3] = {bits(sphere.x), bits(sphere.y), bits(sphere.z), bits(sphere.w)};
    record[4][0] = bits(1 / (object.pose.scale * object.pose.scale));
    const Scene& scene = object.mesh->scene;
    record[5][2] = static_cast<std::uint32_t>(2 * scene.triangles.size());
    record[5][3] = light.firstVertex;
    placeBody(record, number);
    std::uint32_t flags = object.texels ? kLitByTexel : 0;
    if (mesh.hasMirrors()) {
        probeCentres_.emplace_back(sphere);
        flags |= static_cast<std::uint32_t>(probeCentres_.size()) << kProbeShift;
    }
    record[6] = {light.x, light.y, flags,
                 static_cast<std::uint32_t>(object.mesh->closed ? 0 : scene.positions.size())};
    return record;
}

void ObjectPass::loadRecords() {
    count_ = records_.size();
    if (!recordBuffer_ || count_ > capacity_) {
        capacity_ = std::max<std::size_t>(count_, 8);
        recordBuffer_ =
            makeBuffer(nullptr, kGridBytes + capacity_ * sizeof(Record), GL_DYNAMIC_STORAGE_BIT);
        glTextureBuffer(recordTexture_.id(), GL_RGBA32UI, recordBuffer_.id());
    }
    if (count_ > 0)
        glNamedBufferSubData(recordBuffer_.id(), kGridBytes,
                             static_cast<GLsizeiptr>(count_ * sizeof(Record)), records_.data());
    data_.counts.x = static_cast<int>(count_);
    glNamedBufferSubData(dataBuffer_.id(), 0, sizeof data_, &data_);
}

void ObjectPass::setChange(const ChangedLight& change) {
    data_.tolerance.x = change.tolerance();
    std::copy(change.receivers().begin(), change.receivers().end(), data_.receivers);
    data_.gridOrigin = change.grid().origin();
    data_.gridScale = change.grid().scale();
    glNamedBufferSubData(dataBuffer_.id(), 0, sizeof data_, &data_);
    if (change.looksUp())
        glNamedBufferSubData(recordBuffer_.id(), 0, kGridBytes, change.grid().cells().data());
}

void ObjectPass::bind() const {
    hits_.bind();
    lights_.bind();
    glBindTextureUnit(kObjectUnit, recordTexture_.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, kObjectsBlock, dataBuffer_.id());
}

Defines ObjectPass::definesOf(const GpuObjectMesh& mesh, const RoomBatch& batch,
                              const RenderSettings& settings, bool shadowed) const {
    Defines d{{"OBJECTS", 1}};
    if (mesh.texels) d.add({"BY_TEXEL", 1});
    if (mesh.mesh->scene.materials[batch.material].diffuseTexture >= 0) d.add({"DIFFUSE_MAP", 1});
    if (maxComponent(Vec3(batch.data.emission)) > 0) d.add({"EMISSION", 1});
    if (batch.mirror && settings.mode == DisplayMode::raytraced && shadowed) d.add({"SHADOWS", 1});
    if (batch.mirror && settings.mode == DisplayMode::raytraced)
        d.add({"MIRROR", "\"object_reflection.glsl\""});
    else if (batch.mirror)
        d.add({"MIRROR", "\"object_probe.glsl\""});
    return d;
}

void ObjectPass::draw(const View& view, const RenderSettings& settings, bool shadowed) const {
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
        const GpuObjectMesh& mesh = meshes_.mesh(m);
        glBindVertexArray(mesh.vertexArray.id());
        for (std::size_t b = 0; b < mesh.geometry.batches.size(); ++b) {
            const RoomBatch& batch = mesh.geometry.batches[b];
            const Material& material = mesh.mesh->scene.materials[batch.material];
            glUseProgram(shaders_.program("object", definesOf(mesh, batch, settings, shadowed)));
            mesh.textures.bind(kDiffuseUnit, material.diffuseTexture);
            mesh.textures.bind(kEmissionUnit, material.emissionTexture);
            mesh.textures.bind(kMirrorMapUnit, material.mirrorTexture);
            glBindBufferBase(GL_UNIFORM_BUFFER, kMaterialBlock, mesh.materials[b].id());
            drawEach(m, batch, view);
        }
    }
}

/// A batch of a mesh for each of its objects.
void ObjectPass::drawEach(std::size_t mesh, const RoomBatch& batch, const View& view) const {
    const bool closed = meshes_.mesh(mesh).mesh->closed;
    for (std::size_t i = 0; i < count_; ++i) {
        if (meshes_.meshOf(i) != mesh) continue;
        // The inside of a solid is black, but it is seen from within alone.
        const bool outside = glm::distance(view.eye, Vec3(spheres_[i])) > 1.1f * spheres_[i].w;
        (batch.cull || (closed && outside) ? glEnable : glDisable)(GL_CULL_FACE);
        const ObjectLights::Place& light = lights_.place(i);
        glUniform4i(kLightLocation, static_cast<GLint>(light.x), static_cast<GLint>(light.y),
                    static_cast<GLint>(light.firstVertex), static_cast<GLint>(i));
        glUniformMatrix4fv(kPlaceLocation, 1, GL_FALSE, &places_[i][0][0]);
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(batch.indexCount), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(4 * std::size_t{batch.firstIndex}));
    }
}

void ObjectPass::drawTriangles(std::size_t object) const {
    const GpuObjectMesh& mesh = meshes_.mesh(meshes_.meshOf(object));
    glBindVertexArray(mesh.vertexArray.id());
    glUniformMatrix4fv(kPlaceLocation, 1, GL_FALSE, &places_[object][0][0]);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(mesh.geometry.indices.size()),
                   GL_UNSIGNED_INT, nullptr);
}

void ObjectPass::drawTriangles() const {
    for (std::size_t i = 0; i < count_; ++i) drawTriangles(i);
}

void ObjectPass::drawLines(LinePass& lines, bool normals) const {
    for (std::size_t i = 0; i < count_; ++i) {
        GpuObjectMesh& mesh = meshes_.mesh(meshes_.meshOf(i));
        if (!mesh.edges) mesh.edges = makeEdgeBuffer(meshEdges(mesh.mesh->scene));
        lines.draw(*mesh.edges, {{"EDGES", 1}, {"HIDING", 1}, {"OBJECT", 1}}, places_[i]);
        if (!normals) continue;
        if (!mesh.normals) mesh.normals = makeLineBuffer(normalLines(mesh.mesh->scene));
        lines.draw(*mesh.normals, {{"HIDING", 1}, {"NORMALS", 1}, {"OBJECT", 1}}, places_[i]);
    }
}

std::uint64_t ObjectPass::bytes() const {
    return meshes_.bytes() + lights_.bytes() + kGridBytes + capacity_ * sizeof(Record);
}

}  // namespace vlf::gl
