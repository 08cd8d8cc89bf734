#include "unit/io/example_room.h"

#include "vlf/base/parallel.h"
#include "vlf/field/direction_set.h"
#include "vlf/math/random.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf::test {

namespace {

const Vec3 kLower(-2, 0, -2.5f), kUpper(2, 3, 2.5f);
const Vec3 kLamp(0.3f, 2.8f, 0.4f);
const Vec3 kBall(-0.6f, 0.7f, 0.2f);
constexpr float kBallRadius = 0.7f;
constexpr std::uint32_t kMirrorWall = 4;  ///< lower z
constexpr float kBakeNoise = 0.003f;      ///< relative, per texel

/// A wall: the axis it is perpendicular to, and on which side of the room it is.
struct Wall {
    int axis, side;
    Vec3 tint;
};
const std::array<Wall, 6> kWalls = {{{0, 0, {0.6f, 0.1f, 0.08f}},
                                     {0, 1, {0.12f, 0.45f, 0.1f}},
                                     {1, 0, {0.5f, 0.4f, 0.3f}},
                                     {1, 1, {0.75f, 0.75f, 0.74f}},
                                     {2, 0, {0, 0, 0}},
                                     {2, 1, {0.7f, 0.7f, 0.65f}}}};

Vec3 unitAxis(int axis) {
    Vec3 v(0);
    v[axis] = 1;
    return v;
}

Vec3 inwardNormal(const Wall& wall) {
    return (wall.side == 0 ? 1.0f : -1.0f) * unitAxis(wall.axis);
}

/// Noise as a bake leaves it, constant within a texel.
float noise(const Vec3& p, float texelsPerMetre) {
    std::uint64_t key = 0;
    for (int i = 0; i < 3; ++i)
        key = mixBits(key + static_cast<std::uint64_t>(
                                static_cast<std::int64_t>(std::floor(p[i] * texelsPerMetre))));
    return 1 + kBakeNoise * 3.46f * (toUnitFloat(key) - 0.5f);
}

/// Bilinear in the three planes, as a lookup in the atlas is.
float smoothNoise(const Vec3& p, float texelsPerMetre) {
    float sum = 0;
    for (int corner = 0; corner < 4; ++corner) {
        const Vec3 half = 0.5f / texelsPerMetre * Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, 0);
        sum += noise(p + half, texelsPerMetre);
    }
    return sum / 4;
}

Vec3 irradianceAt(const Vec3& p, const Vec3& normal) {
    const Vec3 toLamp = kLamp - p;
    const float d2 = std::max(0.04f, glm::dot(toLamp, toLamp));
    const float cosine = std::max(0.0f, glm::dot(normal, toLamp) / std::sqrt(d2));
    const float bleeding = 0.5f + 0.2f * p.x;
    return Vec3(30, 27, 22) * cosine / d2 + Vec3(2 - bleeding, 1.2f + 0.3f * bleeding, 1.1f);
}

/// What the mirror shows from `origin` along `direction`: reflected radiance and distance.
struct Seen {
    Vec3 radiance;
    float distance;
};

Seen lookAtBall(const Vec3& origin, const Vec3& direction, float distance) {
    const Vec3 p = origin + distance * direction;
    return {Vec3(0.4f, 0.42f, 0.5f) / kPi * irradianceAt(p, (p - kBall) / kBallRadius), distance};
}

float distanceToBall(const Vec3& origin, const Vec3& direction) {
    const Vec3 o = origin - kBall;
    const float b = glm::dot(o, direction), c = glm::dot(o, o) - kBallRadius * kBallRadius;
    return b * b > c && b < 0 ? -b - std::sqrt(b * b - c) : 0;
}

Seen look(const Vec3& origin, const Vec3& direction, float texelsPerMetre) {
    if (const float d = distanceToBall(origin, direction); d > 0)
        return lookAtBall(origin, direction, d);
    float distance = 1e9f;
    const Wall* hit = nullptr;
    for (const Wall& wall : kWalls) {
        const float plane = (wall.side == 0 ? kLower : kUpper)[wall.axis];
        const float d = (plane - origin[wall.axis]) / direction[wall.axis];
        if (d > 1e-4f && d < distance) distance = d, hit = &wall;
    }
    const Vec3 p = origin + distance * direction;
    const bool dark =
        hit->axis == 1 && (static_cast<int>(4 * p.x + 64) + static_cast<int>(4 * p.z + 64)) % 2;
    const Vec3 albedo = dark ? 0.3f * hit->tint : hit->tint;
    return {albedo / kPi * irradianceAt(p, inwardNormal(*hit)) * smoothNoise(p, texelsPerMetre),
            distance};
}

void addWall(Scene& scene, std::uint32_t index) {
    const Wall& wall = kWalls[index];
    const int u = (wall.axis + 1) % 3, v = (wall.axis + 2) % 3;
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (int corner = 0; corner < 4; ++corner) {
        Vec3 p = wall.side == 0 ? kLower : kUpper;
        const Vec2 uv((corner == 1 || corner == 2) ? 1 : 0, corner >= 2 ? 1 : 0);
        p[u] = glm::mix(kLower[u], kUpper[u], uv.x);
        p[v] = glm::mix(kLower[v], kUpper[v], uv.y);
        scene.positions.push_back(p);
        scene.normals.push_back(inwardNormal(wall));
        scene.uvs.push_back(uv);
    }
    scene.meshes.push_back(
        {"wall " + std::to_string(index), static_cast<std::uint32_t>(scene.triangles.size()), 2});
    for (const std::array<std::uint32_t, 3>& t : {std::array{0u, 1u, 2u}, std::array{0u, 2u, 3u}})
        scene.triangles.push_back({{first + t[0], first + t[1], first + t[2]}, index});
}

Texture makePicture(int side) {
    Texture t;
    t.name = "picture";
    t.width = side + 3;
    t.height = side;
    t.wrapV = Wrap::mirror;
    for (int i = 0; i < t.width * t.height; ++i) {
        const int x = i % t.width, y = i / t.width;
        for (const int shade : {x * 200 / side, x * 120 / side + y * 100 / side, 80 + x % 7})
            t.srgb8.push_back(static_cast<std::uint8_t>(shade));
        t.srgb8.push_back(255);
    }
    return t;
}

Texture makeSky(int side) {
    Texture t;
    t.name = "sky";
    t.width = side;
    t.height = side / 2;
    for (int i = 0; i < t.width * t.height; ++i)
        t.linear.push_back(Vec3(0.5f, 0.7f, 1.0f) * (1 + 0.01f * static_cast<float>(i)));
    return t;
}

Scene makeScene(int textureSide) {
    Scene scene;
    for (std::uint32_t w = 0; w < kWalls.size(); ++w) {
        Material material;
        material.name = "paint " + std::to_string(w);
        material.diffuse = kWalls[w].tint;
        if (w == kMirrorWall) material.mirror = Vec3(0.9f);
        scene.materials.push_back(material);
        addWall(scene, w);
    }
    scene.materials[3].emission = Vec3(17, 12, 4);
    scene.materials[3].emissionTexture = 1;
    scene.materials[5].diffuseTexture = 0;
    scene.materials[5].emitsBothSides = true;
    scene.textures = {makePicture(textureSide), makeSky(textureSide)};
    scene.cameras = {{"front", {0, 1.5f, 2}, {0, 1.5f, -2}, {0, 1, 0}, 60}, {"door", {1, 1, 1}}};
    return scene;
}

Chart makeChart(std::uint32_t w, float texelsPerMetre) {
    const Wall& wall = kWalls[w];
    const int u = (wall.axis + 1) % 3, v = (wall.axis + 2) % 3;
    Chart chart;
    chart.uAxis = texelsPerMetre * unitAxis(u);
    chart.vAxis = texelsPerMetre * unitAxis(v);
    chart.uOffset = -texelsPerMetre * kLower[u];
    chart.vOffset = -texelsPerMetre * kLower[v];
    chart.normal = inwardNormal(wall);
    chart.width = static_cast<std::uint32_t>(texelsPerMetre * (kUpper[u] - kLower[u]));
    chart.height = static_cast<std::uint32_t>(texelsPerMetre * (kUpper[v] - kLower[v]));
    chart.material = w;
    chart.planar = true;
    return chart;
}

void fillChart(IrradianceAtlas& atlas, const Chart& chart, const Wall& wall, float texelsPerMetre) {
    const int u = (wall.axis + 1) % 3, v = (wall.axis + 2) % 3;
    for (std::uint32_t y = 0; y < chart.height + 2; ++y)
        for (std::uint32_t x = 0; x < chart.width + 2; ++x) {
            Vec3 p = wall.side == 0 ? kLower : kUpper;
            p[u] = kLower[u] + (static_cast<float>(x) - 0.5f) / texelsPerMetre;
            p[v] = kLower[v] + (static_cast<float>(y) - 0.5f) / texelsPerMetre;
            atlas.irradiance[atlas.index(chart.x + x - 1, chart.y + y - 1)] =
                irradianceAt(p, chart.normal) * noise(p, texelsPerMetre);
        }
}

void addAtlas(LightField& field, float texelsPerMetre) {
    std::uint32_t y = kGutter;
    for (std::uint32_t w = 0; w < kWalls.size(); ++w) {
        Chart chart = makeChart(w, texelsPerMetre);
        chart.x = kGutter;
        chart.y = y;
        y += chart.height + 2 * kGutter;
        field.atlas.width = std::max(field.atlas.width, chart.width + 2 * kGutter);
        field.charts.push_back(chart);
        field.triangleCharts.insert(field.triangleCharts.end(), 2, {w, kNoChart});
    }
    field.atlas.height = y - kGutter;
    field.atlas.irradiance.resize(std::size_t{field.atlas.width} * field.atlas.height);
    for (std::uint32_t w = 0; w < kWalls.size(); ++w)
        fillChart(field.atlas, field.charts[w], kWalls[w], texelsPerMetre);
}

/// The rows of the tiles that the mirror's corners span.
std::vector<TileRow> mirrorRows(const ParallelSubfield& subfield, int m) {
    Vec2 lower(1e9f), upper(-1e9f);
    for (int corner = 0; corner < 4; ++corner) {
        const Vec2 c = subfield.cellCoordinates(
            {(corner & 1 ? kUpper : kLower).x, (corner & 2 ? kUpper : kLower).y, kLower.z});
        lower = glm::min(lower, c);
        upper = glm::max(upper, c);
    }
    TileRow row;
    row.chart = kMirrorWall;
    row.tileX = static_cast<std::uint16_t>(std::max(0.0f, lower.x) / m);
    row.tileY = static_cast<std::uint16_t>(std::max(0.0f, lower.y) / m);
    row.tilesWide = static_cast<std::uint16_t>(static_cast<int>(upper.x) / m - row.tileX + 1);
    std::vector<TileRow> rows;
    for (; row.tileY <= static_cast<int>(upper.y) / m; ++row.tileY) rows.push_back(row);
    return rows;
}

RadianceElement mirrorElement(const ParallelSubfield& s, int x, int y, float maxDistance,
                              float texelsPerMetre) {
    const Vec3& w = s.direction;
    const Vec2 want(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    const float scale = glm::dot(s.xAxis, s.xAxis);
    const Vec2 origin(s.xOffset, s.yOffset);
    const Vec2 offset = (want - origin) / scale;
    Vec3 p = offset.x * s.xAxis + offset.y * s.yAxis;
    p += (kLower.z - p.z) / w.z * w;
    if (p.x < kLower.x || p.x > kUpper.x || p.y < kLower.y || p.y > kUpper.y) return {};
    const Seen seen = look(p, {-w.x, -w.y, w.z}, texelsPerMetre);
    const float code = std::clamp(65535 * seen.distance / maxDistance, 1.0f, 65535.0f);
    return {packRgb9e5(0.9f * seen.radiance), static_cast<std::uint16_t>(std::lround(code))};
}

RadianceField makeRadiance(const ExampleSize& size, const FieldFrame& frame) {
    RadianceField radiance;
    if (size.lines == 0) return radiance;
    radiance.lines = size.lines;
    radiance.cells = size.cells;
    radiance.tileSize = size.tileSize;
    radiance.maxDistance = 8;
    radiance.firstRow = {0};
    std::vector<ParallelSubfield> subfields;  // of each row
    const DirectionSet directions(size.lines);
    for (int d = 0; d < directions.directionCount(); ++d) {
        const Vec3 w = directions.direction(static_cast<std::uint32_t>(d));
        if (w.z > 0.01f) {
            const ParallelSubfield subfield = makeSubfield(frame, w, size.cells);
            for (TileRow row : mirrorRows(subfield, size.tileSize)) {
                row.firstElement = radiance.elements.size();
                radiance.rows.push_back(row);
                radiance.elements.resize(radiance.elements.size() +
                                         radiance.tileElements() * row.tilesWide);
                subfields.push_back(subfield);
            }
        }
        radiance.firstRow.push_back(static_cast<std::uint32_t>(radiance.rows.size()));
    }
    parallelFor(radiance.rows.size(), [&](std::size_t r) {
        const TileRow& row = radiance.rows[r];
        const int m = size.tileSize;
        for (int y = row.tileY * m; y < (row.tileY + 1) * m; ++y)
            for (int x = row.tileX * m; x < (row.tileX + row.tilesWide) * m; ++x)
                radiance.elements[radiance.index({&row, 1}, x, y)] =
                    mirrorElement(subfields[r], x, y, radiance.maxDistance,
                                  static_cast<float>(size.texelsPerMetre));
    });
    return radiance;
}

BakeRecord makeRecord(const ExampleSize& size) {
    BakeRecord record;
    record.programVersion = "0.1.0";
    record.instructionSet = "AVX2";
    record.sceneHash = "0123456789abcdef";
    record.preset = "standard";
    record.seed = 0xfedcba9876543210ull;
    record.directions = 513;
    record.cells = 256;
    record.radianceDirections = size.lines;
    record.radianceCells = size.cells;
    record.tileSize = size.tileSize;
    record.texelSize = 1.0f / static_cast<float>(size.texelsPerMetre);
    record.directSamples = 36;
    record.bounces = 7;
    record.residual = 1e-4;
    record.texelError = 0.003;
    record.interpolatedError = 0.008;
    record.energy = {Vec3(100, 90, 80), Vec3(99, 89, 79), Vec3(0.5f), Vec3(0.5f)};
    return record;
}

}  // namespace

BakedRoom makeExampleRoom(const ExampleSize& size) {
    BakedRoom room;
    room.scene = makeScene(size.textureSide);
    const Sphere sphere = boundingSphere(room.scene);
    room.field.frame = {sphere.centre, sphere.radius};
    addAtlas(room.field, static_cast<float>(size.texelsPerMetre));
    room.field.radiance = makeRadiance(size, room.field.frame);
    room.field.record = makeRecord(size);
    return room;
}

double largestRelativeError(const Vec3& actual, const Vec3& expected) {
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
        const double error = std::abs(static_cast<double>(actual[i]) - expected[i]);
        if (error > 0) largest = std::max(largest, error / expected[i]);
    }
    return largest;
}

}  // namespace vlf::test
