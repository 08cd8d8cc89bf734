// The sweeps do the same work on every instruction set.

#include "swept_scene.h"

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/generate/generate.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

class InstructionSets : public ::testing::Test {
  protected:
    void TearDown() override { useInstructionSet(original_); }

  private:
    std::string original_ = currentInstructionSet();
};

struct Swept {
    TexelBuffer gathered;
    std::vector<std::uint64_t> exchanges;
};

Swept sweepMany(SweptScene& s, const std::string& instructionSet) {
    useInstructionSet(instructionSet);
    s.gathered.reset(s.gathered.texelCount());
    Swept result;
    for (int i = 0; i < 40; ++i) {
        RandomStream random(11, i);
        const Vec3 direction = sampleUniformSphere(random.next2());
        result.exchanges.push_back(s.sweep(direction, 50 + 7 * i, random.next(), random.next2()));
    }
    result.gathered = s.gathered;
    return result;
}

/// Rounding may move a sample across the edge of a texel, not more.
void expectNearlyEqual(const Swept& a, const Swept& b, const std::string& name) {
    for (std::size_t i = 0; i < a.exchanges.size(); ++i)
        EXPECT_NEAR(static_cast<double>(a.exchanges[i]), static_cast<double>(b.exchanges[i]),
                    2 + 1e-4 * static_cast<double>(a.exchanges[i]))
            << name << ", bundle " << i;
    double moved = 0, samples = 0, change = 0, light = 0;
    for (std::size_t i = 0; i <= a.gathered.texelCount(); ++i) {
        moved += std::abs(a.gathered.weight(i) - b.gathered.weight(i));
        samples += a.gathered.weight(i);
        change += std::abs(a.gathered.rgb(i).x - b.gathered.rgb(i).x);
        light += a.gathered.rgb(i).x;
    }
    EXPECT_LT(moved / samples, 1e-3) << name;
    EXPECT_LT(change / light, 2e-3) << name;
}

}  // namespace

TEST_F(InstructionSets, AllGiveTheSameWithinRounding) {
    for (const char* name : {"cornell", "mirror-room"}) {
        SweptScene s(generateScene(name), 0.1f, Sides::asFound);
        for (const std::uint32_t texel : s.unwrap.texels)
            s.radiance.set(texel, Vec3(1 + static_cast<float>(texel % 7)), 1);
        const auto sets = availableInstructionSets();
        ASSERT_FALSE(sets.empty());
        const Swept best = sweepMany(s, sets.front());
        for (const std::string& set : sets) {
            const Swept other = sweepMany(s, set);
            expectNearlyEqual(best, other, std::string(name) + " with " + set);
        }
    }
}

TEST_F(InstructionSets, EachRepeatsItselfExactly) {
    SweptScene s(generateScene("cornell"), 0.1f, Sides::asFound);
    for (const std::string& set : availableInstructionSets()) {
        const Swept a = sweepMany(s, set), b = sweepMany(s, set);
        EXPECT_EQ(a.exchanges, b.exchanges);
        for (std::size_t i = 0; i <= a.gathered.texelCount(); ++i)
            ASSERT_EQ(a.gathered.weight(i), b.gathered.weight(i));
    }
}

TEST_F(InstructionSets, TheChosenOneIsUsed) {
    for (const std::string& set : availableInstructionSets()) {
        useInstructionSet(set);
        EXPECT_EQ(currentInstructionSet(), set);
    }
}

TEST_F(InstructionSets, AnUnknownNameIsRefusedWithTheKnownOnes) {
    const std::string before = currentInstructionSet();
    try {
        useInstructionSet("AVX9");
        FAIL() << "no exception";
    } catch (const InputError& e) {
        const std::string what = e.what();
        EXPECT_NE(what.find("AVX9"), std::string::npos);
        EXPECT_NE(what.find(availableInstructionSets().front()), std::string::npos);
    }
    EXPECT_EQ(currentInstructionSet(), before);
}

}  // namespace vlf::test
