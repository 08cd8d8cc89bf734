#include "vlf/render/gl/packed_radiance.h"

#include "small_rooms.h"
#include "vlf/base/error.h"
#include "vlf/render/gl/room_geometry.h"
#include "vlf/render/gl/shaders/shared.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

using namespace shared;

std::uint32_t bits(std::uint32_t element, int first, int count) {
    return element >> first & ((1u << count) - 1);
}

/// As the shader finds an element.
std::uint32_t elementAt(const PackedRadiance& packed, const RadianceRecord& r, int x, int y) {
    const int row = y - r.y;
    const int column = x - r.firstColumn(row);
    if (row < 0 || row >= r.height || column < 0 || column >= r.width) return 0;
    return packed.elements[r.firstElement + static_cast<std::size_t>(row) * r.width + column];
}

Vec3 radianceOf(const PackedRadiance& packed, std::uint32_t element) {
    const std::uint32_t code = bits(element, kDistanceBits, kSumBits);
    const auto value = [&](const LinearCode& c, std::uint32_t i) {
        return c.first + c.step * static_cast<float>(i);
    };
    const float sum = std::exp2(value(packed.logSum, code));
    const float red = value(packed.red, bits(element, kDistanceBits + kSumBits, kRedBits));
    const float blue =
        value(packed.blue, bits(element, kDistanceBits + kSumBits + kRedBits, kBlueBits));
    return sum * Vec3(red, std::max(1 - red - blue, 0.0f), blue);
}

struct Packed {
    const RadianceField& field = mirrorRoom().field.radiance;
    std::vector<std::uint32_t> charts =
        makeRoomGeometry(mirrorRoom().scene, mirrorRoom().field).mirrorCharts;
    RadianceLayout layout = layOutRadiance(field, charts);
    PackedRadiance radiance = packRadiance(field, charts, layout);

    /// Calls visit(element of the field, packed element, whether the field has it).
    template <class Visit>
    void forEveryCell(Visit visit) const {
        for (std::size_t c = 0; c < charts.size(); ++c)
            for (std::uint32_t d = 0; d < 2u * field.lines; d += 37) {
                const auto rows = field.rowsOf(d, charts[c]);
                const RadianceRecord& record = layout.records[c * 2 * field.lines + d];
                for (int y = 0; y < field.cells; ++y)
                    for (int x = 0; x < field.cells; ++x) {
                        const RadianceElement* e = field.element(rows, x, y);
                        visit(e && e->distance > 0 ? e : nullptr,
                              elementAt(radiance, record, x, y));
                    }
            }
    }
};

}  // namespace

TEST(PackedRadiance, HoldsTheCellsOfTheFieldAndNoOthers) {
    std::size_t cells = 0;
    Packed().forEveryCell([&](const RadianceElement* e, std::uint32_t packed) {
        ASSERT_EQ(e != nullptr, packed != 0);
        cells += e != nullptr;
    });
    EXPECT_GT(cells, 10000u);
}

// Half a code, but that the least code stands for nothing.
TEST(PackedRadiance, KeepsDistancesToHalfACodeAndTheShortestToOne) {
    const Packed packed;
    const float code = packed.radiance.longestDistance / ((1 << kDistanceBits) - 1);
    float largest = 0, largestOfShortest = 0;
    packed.forEveryCell([&](const RadianceElement* e, std::uint32_t element) {
        if (!e) return;
        const float distance = packed.field.maxDistance * e->distance / 65535;
        const float error = std::abs(code * bits(element, 0, kDistanceBits) - distance);
        float& most = distance > code ? largest : largestOfShortest;
        most = std::max(most, error);
    });
    EXPECT_LT(largest, 0.51f * code);
    EXPECT_LT(largestOfShortest, code);
}

TEST(PackedRadiance, KeepsMeanRadianceToAThousandthAndEachElementToTwoPerCent) {
    const Packed packed;
    glm::dvec3 sum(0), stored(0);
    double largestError = 0;
    packed.forEveryCell([&](const RadianceElement* e, std::uint32_t element) {
        if (!e) return;
        const Vec3 exact = unpackRgb9e5(e->rgb9e5()), code = radianceOf(packed.radiance, element);
        sum += glm::dvec3(exact);
        stored += glm::dvec3(code);
        const double scale = exact.x + exact.y + exact.z;
        if (scale > 1e-3)
            largestError = std::max(largestError, maxComponent(glm::abs(code - exact)) / scale);
    });
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(stored[i] / sum[i], 1, 1e-3);
    EXPECT_LT(largestError, 0.02);
}

TEST(PackedRadiance, TakesFourBytesAndHardlyMoreElementsThanThereAre) {
    const Packed packed;
    const auto filled = std::count_if(packed.field.elements.begin(), packed.field.elements.end(),
                                      [](const RadianceElement& e) { return e.distance > 0; });
    const auto bytes = static_cast<double>(packed.layout.bytes());
    EXPECT_LE(bytes / static_cast<double>(filled), 6) << bytes;
}

TEST(PackedRadiance, MadeCoarserCoversTheSameCellsAndKeepsTheMean) {
    const Packed packed;
    const RadianceLayout layout = layOutRadiance(packed.field, packed.charts, 2);
    const PackedRadiance coarse = packRadiance(packed.field, packed.charts, layout);
    EXPECT_LT(layout.elements, packed.layout.elements / 3);
    const auto directions = 2u * packed.field.lines;
    double sum = 0, cells = 0, coarseSum = 0;
    for (std::uint32_t d = 0; d < directions; d += 37) {
        const auto rows = packed.field.rowsOf(d, packed.charts[0]);
        for (int y = 0; y < packed.field.cells / 2; ++y)
            for (int x = 0; x < packed.field.cells / 2; ++x) {
                int filled = 0;
                for (int i = 0; i < 4; ++i)
                    if (const auto* e = packed.field.element(rows, 2 * x + i % 2, 2 * y + i / 2);
                        e && e->distance > 0) {
                        ++filled;
                        sum += luminance(unpackRgb9e5(e->rgb9e5()));
                    }
                const std::uint32_t e = elementAt(coarse, layout.records[d], x, y);
                ASSERT_EQ(filled > 0, e != 0);
                cells += filled;
                if (filled > 0) coarseSum += filled * luminance(radianceOf(coarse, e));
            }
    }
    ASSERT_GT(cells, 10000);
    EXPECT_NEAR(coarseSum / sum, 1, 0.002);
}

TEST(PackedRadiance, IsMadeAsFineAsTheLimitsAllow) {
    const Packed packed;
    RadianceLimits limits;
    EXPECT_EQ(layOutWithin(limits, packed.field, packed.charts).coarseness, 1);
    limits.bytes = packed.layout.bytes() - 1;
    EXPECT_EQ(layOutWithin(limits, packed.field, packed.charts).coarseness, 2);
    limits.elements = packed.layout.elements / 10;
    EXPECT_EQ(layOutWithin(limits, packed.field, packed.charts).coarseness, 4);
    limits.elements = 100;
    EXPECT_THROW(layOutWithin(limits, packed.field, packed.charts), InputError);
}

TEST(PackedRadiance, OfBlackIsTooDarkToBeSeen) {
    RadianceField field = mirrorRoom().field.radiance;
    for (std::size_t i = 0; i < field.elements.size(); i += 2)
        field.elements[i] = {0, field.elements[i].distance};
    float brightest = 0;
    for (const RadianceElement& e : field.elements)
        brightest = std::max(brightest, maxComponent(unpackRgb9e5(e.rgb9e5())));
    const PackedRadiance packed = packRadiance(field, Packed().charts, Packed().layout);
    float darkest = brightest;
    for (const std::uint32_t e : packed.elements)
        if (e != 0) darkest = std::min(darkest, maxComponent(radianceOf(packed, e)));
    EXPECT_LT(darkest, brightest / 10000);
}

TEST(PackedRadiance, OfNoFieldIsEmpty) {
    const PackedRadiance packed = packRadiance({}, {}, {});
    EXPECT_TRUE(packed.elements.empty());
    EXPECT_TRUE(layOutRadiance({}, {}).records.empty());
}

}  // namespace vlf::test
