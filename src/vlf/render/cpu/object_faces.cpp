#include "vlf/render/cpu/object_faces.h"

#include "vlf/base/parallel.h"
#include "vlf/render/cpu/camera_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace vlf {

namespace {

constexpr std::size_t kMostFaces = 24;
constexpr float kSameNormal = 1 - 1e-5f;  // cosine
constexpr std::int32_t kNoFace = -1;

/// The faces of one mesh, by triangle, and their normals, in the mesh's space.
struct MeshFaces {
    std::vector<std::size_t> faceOf;
    std::vector<Vec3> normals;

    explicit MeshFaces(const Scene& mesh) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            faceOf.push_back(faceWith(geometricNormal(mesh, t)));
            if (normals.size() > kMostFaces) break;
        }
        if (normals.size() > kMostFaces) useAxes(mesh);
    }

  private:
    std::size_t faceWith(const Vec3& normal) {
        const auto found = std::find_if(normals.begin(), normals.end(), [&](const Vec3& n) {
            return glm::dot(n, normal) > kSameNormal;
        });
        const auto face = static_cast<std::size_t>(found - normals.begin());
        if (found == normals.end()) normals.push_back(normal);
        return face;
    }

    void useAxes(const Scene& mesh) {
        normals = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        faceOf.clear();
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const Vec3 n = geometricNormal(mesh, t);
            faceOf.push_back(static_cast<std::size_t>(
                std::max_element(
                    normals.begin(), normals.end(),
                    [&](const Vec3& a, const Vec3& b) { return glm::dot(a, n) < glm::dot(b, n); }) -
                normals.begin()));
        }
    }
};

/// The face that the middle of each pixel shows; kNoFace: none.
class FacePicture {
  public:
    FacePicture(const DynamicRoom& room, const RayScene& rays, const Camera& camera, int width,
                int height)
        : width_(width), height_(height), shown_(static_cast<std::size_t>(width) * height) {
        std::vector<MeshFaces> meshes;
        std::vector<std::int32_t> first;
        for (std::size_t i = 0; i < room.litObjects().size(); ++i) {
            const LitObject& object = room.litObjects()[i];
            meshes.emplace_back(object.mesh->scene);
            first.push_back(static_cast<std::int32_t>(faces.size()));
            for (const Vec3& n : meshes.back().normals)
                faces.push_back({room.litNumbers()[i], object.pose.direction(n)});
        }
        const CameraRays picture(camera, width, height);
        parallelFor(static_cast<std::size_t>(height), [&](std::size_t y) {
            for (int x = 0; x < width; ++x) {
                Ray ray = picture.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
                ray.tMax = rays.closest(ray).t;
                const InstanceHit hit = room.rays().closest(ray);
                std::int32_t& shown = shown_[y * width + x];
                shown = kNoFace;
                if (!hit) continue;
                shown = first[hit.instance] +
                        static_cast<std::int32_t>(meshes[hit.instance].faceOf[hit.hit.triangle]);
            }
        });
    }

    std::int32_t at(int x, int y) const { return shown_[static_cast<std::size_t>(y) * width_ + x]; }

    /// Whether the pixels around show the same.
    bool isInside(int x, int y) const {
        for (int j = std::max(y - 1, 0); j < std::min(y + 2, height_); ++j)
            for (int i = std::max(x - 1, 0); i < std::min(x + 2, width_); ++i)
                if (at(i, j) != at(x, y)) return false;
        return true;
    }

    std::vector<FaceRadiance> faces;

  private:
    int width_, height_;
    std::vector<std::int32_t> shown_;
};

}  // namespace

double FaceRadiance::error() const {
    const double reference = luminance(truth), off = luminance(test) - reference;
    return reference > 0 ? off / reference : (off > 0 ? 1 : 0);
}

std::vector<FaceRadiance> compareFaces(const DynamicRoom& room, const RayScene& rays,
                                       const Camera& camera, const Image& test,
                                       const Image& truth) {
    FacePicture picture(room, rays, camera, test.width, test.height);
    for (int y = 0; y < test.height; ++y)
        for (int x = 0; x < test.width; ++x) {
            if (picture.at(x, y) == kNoFace || !picture.isInside(x, y)) continue;
            FaceRadiance& face = picture.faces[static_cast<std::size_t>(picture.at(x, y))];
            ++face.pixels;
            face.test += test.at(x, y);
            face.truth += truth.at(x, y);
        }
    std::vector<FaceRadiance> seen;
    for (FaceRadiance face : picture.faces) {
        if (face.pixels == 0) continue;
        face.test /= static_cast<float>(face.pixels);
        face.truth /= static_cast<float>(face.pixels);
        seen.push_back(face);
    }
    return seen;
}

double meanFaceError(const std::vector<FaceRadiance>& faces) {
    double sum = 0;
    for (const FaceRadiance& face : faces) sum += std::abs(face.error());
    return faces.empty() ? 0 : sum / static_cast<double>(faces.size());
}

}  // namespace vlf
