#include "vlf/display/frame_log.h"
#include "vlf/display/time_statistics.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"

#include <clocale>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vlf {
namespace {

FrameLog twoFrames() {
    FrameLog log({"direct", "tone_map"});
    log.add({0, 1.25, std::nullopt, 4, {0.5, 0.75}, {{1, 1.6f, -2}, kPi / 2, 0, 50}});
    log.add({1.0 / 3, 2, 3.5, 6, {0.25, 1}, {{0.1f, 2, 3}, 0, -kPi / 4, 60}});
    return log;
}

TEST(FrameLog, CsvHasAHeaderWithUnitsAndARowPerFrame) {
    EXPECT_EQ(twoFrames().toCsv(),
              "frame,path_time_s,cpu_ms,gpu_ms,total_ms,direct_ms,tone_map_ms,"
              "eye_x_m,eye_y_m,eye_z_m,yaw_deg,pitch_deg,vertical_fov_deg\n"
              "0,0.000000,1.2500,,4.0000,0.5000,0.7500,1,1.6,-2,90.00000,0.00000,50\n"
              "1,0.333333,2.0000,3.5000,6.0000,0.2500,1.0000,0.1,2,3,0.00000,-45.00000,60\n");
}

TEST(FrameLog, JsonHoldsTheSame) {
    const auto json = nlohmann::json::parse(twoFrames().toJson());
    ASSERT_EQ(json.size(), 2u);
    EXPECT_TRUE(json[0]["gpu_ms"].is_null());
    EXPECT_EQ(json[1]["gpu_ms"], 3.5);
    EXPECT_EQ(json[1]["tone_map_ms"], 1);
    EXPECT_EQ(json[0]["yaw_deg"], 90);
    EXPECT_EQ(json[1].size(), 13u);
    EXPECT_TRUE(nlohmann::json::parse(FrameLog().toJson()).empty());
}

TEST(FrameLog, NumbersDoNotDependOnTheLocale) {
    const std::string expected = twoFrames().toCsv();
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", ""}) {
        std::setlocale(LC_ALL, name);
        EXPECT_EQ(twoFrames().toCsv(), expected) << name;
    }
    std::setlocale(LC_ALL, "C");
}

TEST(FrameLog, TheExtensionChoosesTheFormat) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "frame_log_test";
    std::filesystem::create_directories(folder);
    const auto written = [&](const char* name) {
        twoFrames().write((folder / name).string());
        const auto bytes = readFile((folder / name).string());
        return std::string(bytes.begin(), bytes.end());
    };
    EXPECT_EQ(written("a.csv"), twoFrames().toCsv());
    EXPECT_EQ(written("a.json"), twoFrames().toJson());
    EXPECT_THROW(twoFrames().write((folder / "a.txt").string()), InputError);
    std::filesystem::remove_all(folder);
}

TEST(TimeStatistics, ArePercentilesAsNumpyTakesThem) {
    std::vector<double> times;
    for (int i = 100; i >= 0; --i) times.push_back(i);
    times[50] = 50;
    const TimeStatistics s = statisticsOf(times);
    EXPECT_DOUBLE_EQ(s.median, 50);
    EXPECT_DOUBLE_EQ(s.p95, 95);
    EXPECT_DOUBLE_EQ(s.p99, 99);
    EXPECT_DOUBLE_EQ(s.max, 100);
    EXPECT_DOUBLE_EQ(s.p99OverMedian(), 1.98);
    EXPECT_DOUBLE_EQ(statisticsOf({1, 2, 3, 4}).p95, 3.85);
    EXPECT_DOUBLE_EQ(statisticsOf({7}).p99, 7);
    EXPECT_EQ(statisticsOf({}).p99OverMedian(), 0);
}

}  // namespace
}  // namespace vlf
