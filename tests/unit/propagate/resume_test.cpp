// A bake that was left at any moment and gone on with is the same to the bit.

#include "vlf/propagate/bake.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <map>
#include <optional>

namespace vlf::test {

namespace {

/// A closed room with all there is to go on with: penumbrae, mirrors, a ball of bent texels.
Scene room() {
    SceneBuilder b;
    const auto wall = b.material("wall", Vec3(0.7f, 0.5f, 0.4f));
    b.box(Vec3(-1), Vec3(1), true, wall);
    b.sphere(Vec3(0.3f, -0.5f, 0.2f), 0.3f, 1, false, wall);
    b.quad({-0.9f, -0.8f, -0.8f}, {0, 0, 1.5f}, {0, 1.2f, 0},
           b.material("mirror", Vec3(0), Vec3(0), Vec3(0.8f)));
    b.quad({0.9f, -0.8f, -0.8f}, {0, 1.2f, 0}, {0, 0, 1.5f},
           b.material("metal", Vec3(0), Vec3(0), Vec3(0.6f)));
    b.scene().materials.back().roughness = 0.1f;
    b.quad({-0.2f, 0.9f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f}, b.material("lamp", Vec3(0), Vec3(10)));
    return b.scene();
}

BakeParams params() {
    BakeParams p = presetParams("draft");
    p.texelBudget = 3000;
    p.directions = 129;
    p.cells = 64;
    p.coarseCells = 32;
    p.settlingSweeps = 2;
    p.radianceDirections = 129;
    p.radianceCells = 48;
    p.glossDirections = 33;
    p.glossCells = 32;
    p.gloss = {4, 2};
    return p;
}

/// Asks for a pause every so many times it is asked.
class PausingProgress : public Progress {
  public:
    explicit PausingProgress(int every) : every_(every) {}
    bool pauseDue() const override { return ++asked_ % every_ == 0; }

  private:
    int every_;
    mutable std::atomic<int> asked_{0};
};

/// Is cancelled when it has been updated so many times.
class CancelledProgress : public Progress {
  public:
    explicit CancelledProgress(int updates) : left_(updates) {}
    void update(double) override {
        if (--left_ == 0) cancel();
    }

  private:
    int left_;
};

template <class T, class A>
void expectSameBits(const std::vector<T, A>& a, const std::vector<T, A>& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(T)), 0);
}

void expectSame(const LightField& a, const LightField& b) {
    expectSameBits(a.atlas.irradiance, b.atlas.irradiance);
    expectSameBits(a.radiance.elements, b.radiance.elements);
    expectSameBits(a.gloss.elements, b.gloss.elements);
    EXPECT_EQ(a.radiance.rows.size(), b.radiance.rows.size());
    EXPECT_EQ(a.record.bounces, b.record.bounces);
    EXPECT_EQ(a.record.residual, b.record.residual);
    EXPECT_EQ(a.record.texelError, b.record.texelError);
    EXPECT_EQ(a.record.energy.absorbed, b.record.energy.absorbed);
}

/// Keeps bytes under names, as a file would.
struct Memory {
    std::map<std::string, std::vector<std::uint8_t>> bytes;

    template <class T>
    void put(const std::string& name, const T* items, std::size_t count) {
        std::vector<std::uint8_t>& kept = bytes[name];
        EXPECT_TRUE(kept.empty()) << name << " is used twice";
        EXPECT_LE(name.size(), 16u) << name;
        kept.resize(count * sizeof(T));
        if (count > 0) std::memcpy(kept.data(), items, kept.size());
    }
};

struct Writer {
    Memory& memory;

    template <class T, class A>
    void operator()(const std::string& name, const std::vector<T, A>& items) const {
        memory.put(name, items.data(), items.size());
    }
    template <class T>
    void operator()(const std::string& name, const T& item) const {
        memory.put(name, &item, 1);
    }
};

struct Reader {
    const Memory& memory;

    template <class T, class A>
    void operator()(const std::string& name, std::vector<T, A>& items) const {
        const std::vector<std::uint8_t>& kept = memory.bytes.at(name);
        items.resize(kept.size() / sizeof(T));
        if (!items.empty()) std::memcpy(static_cast<void*>(items.data()), kept.data(), kept.size());
    }
    template <class T>
    void operator()(const std::string& name, T& item) const {
        std::memcpy(&item, memory.bytes.at(name).data(), sizeof item);
    }
};

/// What visitSolution tells of it, and nothing else.
BakeSolution throughMemory(const BakeSolution& solution) {
    Memory memory;
    visitSolution(solution, Writer{memory});
    BakeSolution copy;
    visitSolution(copy, Reader{memory});
    return copy;
}

class Resume : public testing::Test {
  protected:
    LightField goOnFrom(const BakeSolution& solution, int threads,
                        BakeReport* itsReport = nullptr) {
        const ThreadLimit limit(threads);
        Progress progress;
        return bake(scene, params(), progress, itsReport, unobserved, throughMemory(solution));
    }
    /// The solution that a bake leaves that is cancelled after so many updates; none if it ends.
    std::optional<BakeSolution> cancelledAfter(int updates) {
        CancelledProgress progress(updates);
        BakeSolution last;
        try {
            bake(scene, params(), progress, nullptr, [&](const BakeState& s) { last = s; });
            return std::nullopt;
        } catch (const Cancelled&) {
            return last;
        }
    }

    Scene scene = room();
    Progress none;
    BakeReport report;
    LightField whole = bake(scene, params(), none, &report);
};

}  // namespace

TEST_F(Resume, PausesChangeNothing) {
    for (const int every : {2, 7}) {
        PausingProgress progress(every);
        int pauses = 0;
        expectSame(whole,
                   bake(scene, params(), progress, nullptr, [&](const BakeState&) { ++pauses; }));
        EXPECT_GT(pauses, 50);
    }
}

TEST_F(Resume, FromEveryKindOfPauseTheFieldIsTheSame) {
    PausingProgress progress(11);
    std::map<std::string, BakeSolution> kept;  // one of each kind
    bake(scene, params(), progress, nullptr, [&](const BakeState& s) {
        std::string kind = std::to_string(static_cast<int>(s.stage));
        if (s.direct.pass > 0) kind += " refining " + std::to_string(s.direct.pass);
        if (countDone(s.direct.done) > 0) kind += " within";
        if (s.settling.sweeps > 0) kind += " settling " + std::to_string(s.settling.sweeps);
        if (!s.sweep.nextLine.empty()) kind += " sweeping";
        if (countDone(s.sweep.toppedUp) > 0) kind += " topping up";
        if (countDone(s.radiance.done) > 0) kind += " radiance";
        if (countDone(s.gloss.done) > 0) kind += " gloss";
        kept[kind] = s;
    });
    for (const char* kind :
         {"0 within", "0 refining 2 within", "1 sweeping", "2 sweeping", "2 settling 3 sweeping",
          "3 sweeping", "3 sweeping topping up", "4 radiance", "4 radiance gloss"})
        EXPECT_TRUE(kept.contains(kind)) << kind;
    int threads = 0;
    for (const auto& [kind, solution] : kept) {
        SCOPED_TRACE(kind);
        BakeReport resumed;
        expectSame(whole, goOnFrom(solution, 1 + threads++ % 3, &resumed));
        EXPECT_EQ(resumed.exchanges, report.exchanges);
        EXPECT_EQ(resumed.sweeps, report.sweeps);
    }
}

TEST_F(Resume, ARefinementGoesOnToTheSameBits) {
    BakeParams refining = refiningParams(params(), 0);
    refining.directions = 129;
    refining.refinements = 8;
    whole = bake(scene, refining, none);
    PausingProgress progress(11);
    std::map<std::string, BakeSolution> kept;
    bake(scene, refining, progress, nullptr, [&](const BakeState& s) {
        if (s.stage != BakeStage::settled) return;
        std::string kind = std::to_string(static_cast<int>(s.refinement.step));
        if (s.refinement.steps > 0) kind += " later";
        if (countDone(s.direct.done) > 0) kind += " within";
        if (!s.sweep.nextLine.empty()) kind += " sweeping";
        if (countDone(s.sweep.toppedUp) > 0) kind += " topping up";
        kept[kind] = s;
    });
    for (const char* kind : {"0", "0 later", "1 sweeping", "1 later sweeping",
                             "1 later sweeping topping up", "2 later within"})
        EXPECT_TRUE(kept.contains(kind)) << kind;
    for (const auto& [kind, solution] : kept) {
        SCOPED_TRACE(kind);
        expectSame(whole,
                   bake(scene, refining, none, nullptr, unobserved, throughMemory(solution)));
    }
}

TEST_F(Resume, FromWhereverItWasCancelledTheFieldIsTheSame) {
    int cancelled = 0;
    for (int updates = 1;; updates = updates * 3 / 2 + 1) {
        SCOPED_TRACE(updates);
        const std::optional<BakeSolution> solution = cancelledAfter(updates);
        if (!solution) break;
        expectSame(whole, goOnFrom(*solution, 2));
        ++cancelled;
    }
    EXPECT_GT(cancelled, 8);
}

TEST_F(Resume, GoesOnAsOftenAsItIsCancelled) {
    BakeSolution solution;
    int times = 0;
    for (bool ended = false; !ended; ++times) {
        CancelledProgress progress(150);
        try {
            expectSame(whole,
                       bake(
                           scene, params(), progress, nullptr,
                           [&](const BakeState& s) { solution = s; }, throughMemory(solution)));
            ended = true;
        } catch (const Cancelled&) {
        }
        ASSERT_LT(times, 200);
    }
    EXPECT_GT(times, 3);
}

TEST_F(Resume, OfSoManyBouncesTheFieldIsTheSame) {
    BakeParams bounces = params();
    bounces.maxBounces = 3;
    const LightField three = bake(scene, bounces, none);
    EXPECT_EQ(three.record.bounces, 4);  // and the fine one
    std::vector<BakeSolution> kept;
    PausingProgress progress(23);
    bake(scene, bounces, progress, nullptr, [&](const BakeState& s) {
        if (!s.sweep.nextLine.empty()) kept.push_back(s);
    });
    ASSERT_GT(kept.size(), 4u);
    for (const BakeSolution& solution : kept)
        expectSame(three, bake(scene, bounces, none, nullptr, unobserved, throughMemory(solution)));
}

TEST_F(Resume, ASweepThatWasLeftDoesOnlyWhatIsLeftOfIt) {
    BakeSolution last;
    PausingProgress progress(11);
    bake(scene, params(), progress, nullptr, [&](const BakeState& s) {
        if (s.stage == BakeStage::settled && !s.sweep.nextLine.empty() && s.sweep.gathered.empty())
            last = s;
    });
    ASSERT_FALSE(last.sweep.nextLine.empty());
    std::uint32_t least = ~0u;
    for (const std::uint32_t next : last.sweep.nextLine) least = std::min(least, next);
    ASSERT_GT(least, 20u);
    CancelledProgress stopped(1);  // at once: what is done stays done
    BakeSolution kept;
    EXPECT_THROW(
        bake(
            scene, params(), stopped, nullptr, [&](const BakeState& s) { kept = s; }, last),
        Cancelled);
    for (std::size_t a = 0; a < kept.sweep.nextLine.size(); ++a)
        EXPECT_GE(kept.sweep.nextLine[a], last.sweep.nextLine[a]);
}

TEST_F(Resume, ASolutionOfAnotherSceneIsRefused) {
    std::vector<BakeSolution> kept;
    PausingProgress progress(40);
    bake(scene, params(), progress, nullptr, [&](const BakeState& s) {
        if (countDone(s.direct.done) + s.direct.pass > 0 || s.stage > BakeStage::charts)
            kept.push_back(s);
    });
    ASSERT_GT(kept.size(), 5u);
    BakeParams finer = params();
    finer.texelBudget *= 2;
    for (const BakeSolution& solution : kept)
        EXPECT_THROW(bake(scene, finer, none, nullptr, unobserved, solution), InputError);
}

TEST_F(Resume, ASolutionWithAnArrayOfAnotherSizeIsRefused) {
    BakeSolution sweeping, radiating, glossing, lighting;
    PausingProgress progress(11);
    bake(scene, params(), progress, nullptr, [&](const BakeState& s) {
        if (s.direct.pass == 2) lighting = s;
        if (countDone(s.sweep.toppedUp) > 0) sweeping = s;
        if (countDone(s.radiance.done) > 0) radiating = s;
        if (countDone(s.gloss.done) > 0) glossing = s;
    });
    const auto refused = [&](const BakeSolution& original, auto change) {
        BakeSolution solution = original;
        change(solution);
        EXPECT_THROW(goOnFrom(solution, 2), InputError);
    };
    refused(lighting, [](BakeSolution& s) { s.direct.pass = 7; });
    refused(lighting, [](BakeSolution& s) { s.direct.estimates.pop_back(); });
    refused(lighting, [](BakeSolution& s) { s.direct.before.pop_back(); });
    refused(lighting, [](BakeSolution& s) { s.direct.done.push_back(1); });
    refused(lighting, [](BakeSolution& s) { s.stage = BakeStage::bounce; });
    refused(sweeping, [](BakeSolution& s) { s.stage = static_cast<BakeStage>(17); });
    refused(sweeping, [](BakeSolution& s) { s.directIrradiance.pop_back(); });
    refused(sweeping, [](BakeSolution& s) { s.irradiance.pop_back(); });
    refused(sweeping, [](BakeSolution& s) { s.reached.clear(); });
    refused(sweeping, [](BakeSolution& s) { s.convergence.charts.pop_back(); });
    refused(sweeping, [](BakeSolution& s) { s.settling.sum.resize(3); });
    refused(sweeping, [](BakeSolution& s) { s.settling.sweeps = -1; });
    refused(sweeping, [](BakeSolution& s) { s.sweep.nextLine.pop_back(); });
    refused(sweeping, [](BakeSolution& s) { ++s.sweep.nextLine[3]; });
    refused(sweeping, [](BakeSolution& s) { s.sweep.bent[2].pop_back(); });
    refused(sweeping, [](BakeSolution& s) { s.sweep.parts[5].entries().pop_back(); });
    refused(sweeping, [](BakeSolution& s) { s.sweep.gathered.entries().pop_back(); });
    refused(sweeping, [](BakeSolution& s) { s.sweep.toppedUp.pop_back(); });
    refused(radiating, [](BakeSolution& s) { s.radiance.done.pop_back(); });
    refused(radiating, [](BakeSolution& s) { s.radiance.field.elements.pop_back(); });
    refused(glossing, [](BakeSolution& s) { s.gloss.done.pop_back(); });
    refused(glossing, [](BakeSolution& s) { s.gloss.field.elements.pop_back(); });
}

}  // namespace vlf::test
