#include "vlf/scene/generate/generate.h"

#include "vlf/base/error.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/trace/ray_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>
#include <glm/vector_relational.hpp>

namespace vlf {
namespace {

using Point = std::tuple<float, float, float>;

Point key(const Vec3& p) {
    return {p.x, p.y, p.z};
}

struct Edge {
    Vec3 from, to;
};

/// Edges of a mesh that no triangle of it runs through in the opposite direction; a repeated
/// directed edge counts as a failure of the test.
std::vector<Edge> openEdges(const Scene& scene, const Mesh& mesh) {
    std::map<std::pair<Point, Point>, Edge> edges;
    for (std::uint32_t i = 0; i < mesh.triangleCount; ++i)
        for (int k = 0; k < 3; ++k) {
            const Vec3& a = scene.position(mesh.firstTriangle + i, k);
            const Vec3& b = scene.position(mesh.firstTriangle + i, (k + 1) % 3);
            EXPECT_TRUE(edges.try_emplace({key(a), key(b)}, Edge{a, b}).second)
                << mesh.name << ": an edge is used twice in one direction";
        }
    std::vector<Edge> open;
    for (const auto& [ends, edge] : edges)
        if (!edges.contains({ends.second, ends.first})) open.push_back(edge);
    return open;
}

Bounds boundsOf(const Scene& scene, const Mesh& mesh) {
    Bounds bounds;
    for (std::uint32_t i = 0; i < mesh.triangleCount; ++i)
        for (int k = 0; k < 3; ++k) bounds.add(scene.position(mesh.firstTriangle + i, k));
    return bounds;
}

/// On which axes (x, y, z) and sides (lower, upper) of the bounds an edge lies.
std::array<bool, 6> sidesOf(const Edge& edge, const Bounds& bounds) {
    std::array<bool, 6> sides{};
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            const float plane = (side == 0 ? bounds.lower : bounds.upper)[axis];
            sides[2 * axis + side] = std::fabs(edge.from[axis] - plane) < 1e-5f &&
                                     std::fabs(edge.to[axis] - plane) < 1e-5f;
        }
    return sides;
}

/// Volume enclosed by a mesh (negative: wound inward), as seen from `apex`: open faces in planes
/// through the apex add nothing to it.
double signedVolume(const Scene& scene, const Mesh& mesh, const Vec3& apex) {
    double sum = 0;
    for (std::uint32_t t = mesh.firstTriangle; t < mesh.firstTriangle + mesh.triangleCount; ++t) {
        const glm::dvec3 a = scene.position(t, 0) - apex, b = scene.position(t, 1) - apex,
                         c = scene.position(t, 2) - apex;
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

/// A corner of the bounds where the mesh is open, the centre along axes where it is not.
Vec3 openCorner(const std::vector<Edge>& open, const Bounds& bounds) {
    std::array<int, 6> count{};
    for (const Edge& e : open)
        for (int side = 0; side < 6; ++side) count[side] += sidesOf(e, bounds)[side];
    Vec3 corner = bounds.centre();
    for (int axis = 0; axis < 3; ++axis) {
        const int lower = count[2 * axis], upper = count[2 * axis + 1];
        if (lower != upper) corner[axis] = (lower > upper ? bounds.lower : bounds.upper)[axis];
    }
    return corner;
}

bool isShell(const std::string& meshName) {
    return meshName == "room" || meshName == "rooms" || meshName == "hall" || meshName == "cave";
}

bool isFlat(const Scene& scene, const Mesh& mesh) {
    const Vec3 normal = geometricNormal(scene, mesh.firstTriangle);
    for (std::uint32_t i = 1; i < mesh.triangleCount; ++i)
        if (glm::dot(geometricNormal(scene, mesh.firstTriangle + i), normal) < 0.9999f)
            return false;
    return true;
}

/// Each scene is made once.
const Scene& sceneNamed(const std::string& name) {
    static std::map<std::string, Scene> scenes;
    const auto found = scenes.find(name);
    return found != scenes.end() ? found->second
                                 : scenes.emplace(name, generateScene(name)).first->second;
}

class EveryScene : public testing::TestWithParam<std::string> {
  protected:
    const Scene& scene_ = sceneNamed(GetParam());
};

std::vector<std::string> allNames() {
    std::vector<std::string> names;
    for (const SceneRecipe& r : sceneRecipes()) names.push_back(r.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Generate, EveryScene, testing::ValuesIn(allNames()), [](const auto& test) {
    std::string name = test.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST_P(EveryScene, HasWellFormedArrays) {
    const std::size_t n = scene_.positions.size();
    ASSERT_EQ(scene_.normals.size(), n);
    ASSERT_EQ(scene_.uvs.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
        ASSERT_TRUE(isFinite(scene_.positions[i]));
        ASSERT_NEAR(glm::length(scene_.normals[i]), 1, 1e-4f);
    }
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
        for (const std::uint32_t v : scene_.triangles[t].vertex) ASSERT_LT(v, n);
        ASSERT_LT(scene_.triangles[t].material, scene_.materials.size());
        ASSERT_GT(area(scene_, t), 1e-8f);
    }
}

TEST_P(EveryScene, HasMeshesThatCoverItsTrianglesInOrder) {
    std::uint32_t next = 0;
    std::set<std::string> names;
    for (const Mesh& m : scene_.meshes) {
        EXPECT_EQ(m.firstTriangle, next);
        EXPECT_GT(m.triangleCount, 0u) << m.name;
        EXPECT_TRUE(names.insert(m.name).second) << m.name;
        next += m.triangleCount;
    }
    EXPECT_EQ(next, scene_.triangles.size());
}

TEST_P(EveryScene, HasMaterialsThatKeepEnergyAndAreUsed) {
    std::set<std::string> names;
    std::set<std::uint32_t> used;
    for (const Triangle& t : scene_.triangles) used.insert(t.material);
    for (const Material& m : scene_.materials) {
        EXPECT_TRUE(names.insert(m.name).second) << m.name;
        EXPECT_LE(maxComponent(m.diffuse + m.mirror), 1) << m.name;
        for (const int t : {m.diffuseTexture, m.mirrorTexture, m.emissionTexture}) {
            EXPECT_LT(t, static_cast<int>(scene_.textures.size()));
        }
    }
    EXPECT_EQ(used.size(), scene_.materials.size());
}

TEST_P(EveryScene, HasSolidsThatAreClosedButWhereTheyTouchOthers) {
    for (const Mesh& mesh : scene_.meshes) {
        const Bounds bounds = boundsOf(scene_, mesh);
        const std::vector<Edge> open = openEdges(scene_, mesh);
        const bool isOpenRoom = GetParam() == "cornell";
        if (isShell(mesh.name) && !isOpenRoom) {
            EXPECT_TRUE(open.empty()) << mesh.name;
        }
        for (const Edge& e : open) {
            const auto sides = sidesOf(e, bounds);
            EXPECT_NE(std::count(sides.begin(), sides.end(), true), 0) << mesh.name;
        }
    }
}

TEST_P(EveryScene, HasSolidsWoundOutwardAndRoomsWoundInward) {
    for (const Mesh& mesh : scene_.meshes) {
        const Bounds bounds = boundsOf(scene_, mesh);
        if (isFlat(scene_, mesh)) continue;
        const Vec3 corner = openCorner(openEdges(scene_, mesh), bounds);
        const double volume = signedVolume(scene_, mesh, corner);
        EXPECT_GT(isShell(mesh.name) ? -volume : volume, 1e-7) << mesh.name;
    }
}

/// From inside a closed room of outward solids every ray meets a front first.
TEST_P(EveryScene, ShowsOnlyFrontsToItsCameras) {
    const RayScene rays(scene_);
    int missed = 0;
    for (const Camera& camera : scene_.cameras) {
        RandomStream random(1, 2);
        for (int i = 0; i < 20000; ++i) {
            const Vec3 direction = sampleUniformSphere(random.next2());
            const Hit hit = rays.closest({camera.eye, direction});
            missed += !hit;
            if (!hit) continue;
            ASSERT_LT(glm::dot(geometricNormal(scene_, hit.triangle), direction), 0)
                << camera.name << " sees the back of " << scene_.material(hit.triangle).name;
        }
    }
    EXPECT_EQ(missed > 0, GetParam() == "cornell");
}

TEST_P(EveryScene, HasCamerasThatStandFreeInTheRoom) {
    const RayScene rays(scene_);
    const Bounds bounds = boundsOf(scene_);
    std::set<std::string> names;
    for (const Camera& camera : scene_.cameras) {
        EXPECT_TRUE(names.insert(camera.name).second) << camera.name;
        EXPECT_GT(camera.verticalFov, 20);
        EXPECT_LT(camera.verticalFov, 90);
        if (GetParam() == "cornell" && camera.name == "front") continue;
        EXPECT_TRUE(glm::all(glm::lessThan(bounds.lower, camera.eye))) << camera.name;
        EXPECT_TRUE(glm::all(glm::lessThan(camera.eye, bounds.upper))) << camera.name;
        RandomStream random(3, 4);
        for (int i = 0; i < 2000; ++i) {
            const Hit hit = rays.closest({camera.eye, sampleUniformSphere(random.next2())});
            EXPECT_GT(hit.t, 0.1f) << camera.name << " is too near to a surface";
        }
    }
    EXPECT_GE(names.size(), 3u);
    EXPECT_TRUE(names.contains("front") || names.contains("overview"));
}

TEST_P(EveryScene, HasEmittersThatFaceTheRoom) {
    const RayScene rays(scene_);
    int emitters = 0;
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
        if (!scene_.material(t).isEmitter()) continue;
        ++emitters;
        const Vec3 normal = geometricNormal(scene_, t);
        const Vec3 start = positionAt(scene_, t, {0.3f, 0.3f}) + 1e-4f * normal;
        const Hit hit = rays.closest({start, normal});
        ASSERT_TRUE(hit) << scene_.material(t).name;
        EXPECT_GT(hit.t, 0.03f) << scene_.material(t).name;
        EXPECT_LT(glm::dot(geometricNormal(scene_, hit.triangle), normal), 0)
            << scene_.material(t).name;
    }
    EXPECT_GT(emitters, 0);
}

/// Two faces in one place would flicker and make what lies beneath them undefined.
TEST_P(EveryScene, HasNoTwoMeshesInOnePlace) {
    const RayScene rays(scene_);
    constexpr float kLift = 4e-4f, kTolerance = 1e-4f;
    for (const Mesh& mesh : scene_.meshes) {
        const std::uint32_t end = mesh.firstTriangle + mesh.triangleCount;
        for (std::uint32_t t = mesh.firstTriangle; t < std::min(end, mesh.firstTriangle + 2000);
             ++t) {
            RandomStream random(5, t);
            const Vec3 normal = geometricNormal(scene_, t);
            for (int i = 0; i < 8; ++i) {
                const Vec3 p = positionAt(scene_, t, sampleUniformTriangle(random.next2()));
                const Hit hit = rays.closest({p + kLift * normal, -normal});
                if (!hit || std::fabs(hit.t - kLift) > kTolerance) continue;
                const bool facesAlike =
                    std::fabs(glm::dot(geometricNormal(scene_, hit.triangle), normal)) > 0.999f;
                EXPECT_TRUE(!facesAlike ||
                            (hit.triangle >= mesh.firstTriangle && hit.triangle < end))
                    << mesh.name << " lies upon " << scene_.material(hit.triangle).name;
            }
        }
    }
}

TEST_P(EveryScene, IsTheSameEachTime) {
    const Scene again = generateScene(GetParam());
    EXPECT_EQ(scene_.positions, again.positions);
    EXPECT_EQ(scene_.normals, again.normals);
    EXPECT_EQ(scene_.uvs, again.uvs);
    ASSERT_EQ(scene_.textures.size(), again.textures.size());
    for (std::size_t i = 0; i < scene_.textures.size(); ++i)
        EXPECT_EQ(scene_.textures[i].srgb8, again.textures[i].srgb8);
}

Vec3 sizeOf(const Scene& scene) {
    return boundsOf(scene).size();
}

int texturedEmitters(const Scene& scene) {
    return static_cast<int>(
        std::count_if(scene.materials.begin(), scene.materials.end(),
                      [](const Material& m) { return m.isEmitter() && m.emissionTexture >= 0; }));
}

int emitterMaterials(const Scene& scene) {
    return static_cast<int>(std::count_if(scene.materials.begin(), scene.materials.end(),
                                          [](const Material& m) { return m.isEmitter(); }));
}

const Material& materialNamed(const Scene& scene, const std::string& name) {
    const auto it = std::find_if(scene.materials.begin(), scene.materials.end(),
                                 [&](const Material& m) { return m.name == name; });
    if (it == scene.materials.end()) throw std::logic_error("no material " + name);
    return *it;
}

const Mesh& meshNamed(const Scene& scene, const std::string& name) {
    const auto it = std::find_if(scene.meshes.begin(), scene.meshes.end(),
                                 [&](const Mesh& m) { return m.name == name; });
    if (it == scene.meshes.end()) throw std::logic_error("no mesh " + name);
    return *it;
}

TEST(Cornell, HasThePublishedMeasuresAndColours) {
    const Scene& scene = sceneNamed("cornell");
    EXPECT_EQ(scene.triangles.size(), 32u);
    EXPECT_EQ(sizeOf(scene), Vec3(5.528f, 5.488f, 5.592f));
    EXPECT_EQ(materialNamed(scene, "red").diffuse, Vec3(0.63f, 0.065f, 0.05f));
    EXPECT_EQ(materialNamed(scene, "light").emission, Vec3(17, 12, 4));
    const Mesh& light = meshNamed(scene, "light");
    EXPECT_NEAR(area(scene, light.firstTriangle) + area(scene, light.firstTriangle + 1),
                1.3f * 1.05f, 1e-5f);
    EXPECT_NEAR(geometricNormal(scene, light.firstTriangle).y, -1, 1e-6f);
    EXPECT_NEAR(scene.position(light.firstTriangle, 0).y, 5.487f, 1e-6f);
}

TEST(MirrorRoom, HasAMirrorThatCoversHalfAWall) {
    const Scene& scene = sceneNamed("mirror-room");
    EXPECT_EQ(materialNamed(scene, "mirror").mirror, Vec3(0.88f));
    EXPECT_EQ(materialNamed(scene, "mirror").diffuse, Vec3(0.02f, 0.03f, 0.08f));
    const Mesh& mirror = meshNamed(scene, "mirror");
    const float mirrorArea =
        area(scene, mirror.firstTriangle) + area(scene, mirror.firstTriangle + 1);
    EXPECT_GT(mirrorArea, 0.5f * 5.5f * 5.5f);
}

TEST(TwoRooms, LightTheSecondRoomThroughTheDoorOnly) {
    const Scene& scene = sceneNamed("two-rooms");
    const RayScene rays(scene);
    const Vec3 light(0.6f, 2.75f, 3.4f);
    const auto sees = [&](const Vec3& p) { return !rays.occluded({light, p - light, 1e-3f, 1}); };
    EXPECT_TRUE(sees({4.6f, 0.3f, 2.0f}));
    EXPECT_FALSE(sees({4.6f, 2.4f, 2.2f}));
    EXPECT_FALSE(sees({6, 1, 3.8f}));
    EXPECT_EQ(sizeOf(scene), Vec3(8.15f, 2.8f, 4));
}

TEST(Sealed, HasLongPolygonsThroughBothRoomsAndNoWayBetween) {
    const Scene& scene = sceneNamed("sealed");
    EXPECT_EQ(meshNamed(scene, "room").triangleCount, 12u);
    const RayScene rays(scene);
    RandomStream random(8, 8);
    for (int i = 0; i < 100000; ++i) {
        const Vec3 dark(4.02f + 3.9f * random.next(), 2.79f * random.next() + 0.005f,
                        3.98f * random.next() + 0.01f);
        const Vec3 lit(3.98f * random.next(), 2.79f * random.next() + 0.005f,
                       3.98f * random.next() + 0.01f);
        ASSERT_TRUE(rays.occluded({dark, lit - dark, 0, 1}));
    }
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            EXPECT_TRUE(!scene.material(t).isEmitter() || scene.position(t, k).x < 3.9f);
        }
}

TEST(Office, IsFurnishedTexturedAndMirrored) {
    const Scene& scene = sceneNamed("office");
    EXPECT_GT(scene.triangles.size(), 500u);
    EXPECT_LT(scene.triangles.size(), 5000u);
    EXPECT_GE(materialNamed(scene, "parquet").diffuseTexture, 0);
    EXPECT_GE(materialNamed(scene, "painting").diffuseTexture, 0);
    EXPECT_TRUE(materialNamed(scene, "mirror").isMirror());
    EXPECT_EQ(emitterMaterials(scene), 3);
}

TEST(Grotto, HasThreeEmittersTwoOfThemTextured) {
    const Scene& scene = sceneNamed("grotto");
    EXPECT_EQ(scene.triangles.size(), 318u);
    EXPECT_EQ(emitterMaterials(scene), 3);
    EXPECT_EQ(texturedEmitters(scene), 2);
    EXPECT_TRUE(materialNamed(scene, "water").isMirror());
}

TEST(Caustic, ThrowsTheSpotlightOnTheWall) {
    const Scene& scene = sceneNamed("caustic");
    const RayScene rays(scene);
    const Hit mirror = rays.closest({{1, 2.9f, 1.8f}, {0, -1, 0}});
    ASSERT_TRUE(mirror && scene.material(mirror.triangle).isPureMirror());
    const Vec3 n = geometricNormal(scene, mirror.triangle);
    const Vec3 p = positionAt(scene, mirror.triangle, mirror.barycentric);
    const Hit wall = rays.closest({p + 1e-4f * n, glm::reflect(Vec3(0, -1, 0), n)});
    ASSERT_TRUE(wall);
    EXPECT_NEAR(positionAt(scene, wall.triangle, wall.barycentric).x, 4.2f, 1e-4f);
    EXPECT_TRUE(materialNamed(scene, "lacquer").isMirror());
    EXPECT_FALSE(materialNamed(scene, "lacquer").isPureMirror());
}

TEST(Statue, HasTheWantedNumberOfTriangles) {
    for (const std::string name : {"mirror-room", "gallery"})
        for (const int wanted : {0, 1000, 300000}) {
            const Scene scene = generateScene(name, {wanted});
            const double count = meshNamed(scene, "statue").triangleCount;
            EXPECT_NEAR(count / (wanted ? wanted : 10000), 1, 0.01) << name << " " << wanted;
        }
}

TEST(Statue, ReachesAMillionTriangles) {
    const Scene scene = generateScene("gallery", {1000000});
    EXPECT_NEAR(meshNamed(scene, "statue").triangleCount, 1e6, 1e4);
}

TEST(Statue, HasSmoothNormalsAlongItsWinding) {
    const Scene& scene = sceneNamed("gallery");
    const Mesh& statue = meshNamed(scene, "statue");
    for (std::uint32_t t = statue.firstTriangle; t < statue.firstTriangle + statue.triangleCount;
         ++t)
        for (const std::uint32_t v : scene.triangles[t].vertex)
            ASSERT_GT(glm::dot(scene.normals[v], geometricNormal(scene, t)), 0.7f);
}

std::string messageOf(const std::string& name, int triangles) {
    try {
        generateScene(name, {triangles});
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

TEST(GenerateScene, ListsTheNamesWhenOneIsUnknown) {
    const std::string message = messageOf("nosuch", 0);
    EXPECT_NE(message.find("nosuch"), std::string::npos);
    for (const SceneRecipe& r : sceneRecipes())
        EXPECT_NE(message.find(r.name), std::string::npos) << r.name;
}

TEST(GenerateScene, RejectsTriangleCountsOutOfRangeOrWithoutStatue) {
    EXPECT_NE(messageOf("gallery", -5), "");
    EXPECT_NE(messageOf("gallery", 10), "");
    EXPECT_NE(messageOf("mirror-room", 2000000000), "");
    EXPECT_NE(messageOf("cornell", 5000).find("cornell"), std::string::npos);
}

}  // namespace
}  // namespace vlf
