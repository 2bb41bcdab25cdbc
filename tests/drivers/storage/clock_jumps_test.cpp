#include "drivers/storage/clock_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>

#include "tests/drivers/storage/log_text.hpp"

namespace azimuth {
namespace {

using ::testing::HasSubstr;

/// Reading of a clock as a function of true time, both in seconds.
using Shows = std::function<double(double)>;

double right(double t_s) { return t_s; }
Shows set_by(double by_s, double at_s) {
  return [=](double t_s) { return t_s < at_s ? t_s : t_s + by_s; };
}

Stamp at(double t_s) { return Stamp{duration_from_seconds(t_s)}; }

/// A minute of odometry at 10 Hz and bearings at 5 Hz. Bearings arrive 30 ms after their stamps.
struct Recording {
  Shows robot = right, camera = right, recorder = right;
  std::function<bool(double)> camera_is_there = [](double) { return true; };
  std::function<bool(double)> is_recorded = [](double) { return true; };
  std::function<double(double)> came_at_s = right;  ///< arrival time; delayed samples arrive later

  struct Sample {
    double true_s = 0.0, came_s = 0.0, said_s = 0.0;
    bool of_camera = false;
  };
  std::vector<Sample> samples() const {
    std::vector<Sample> samples;
    for (int i = 0; i < 600; ++i) {
      const double t_s = 100.0 + 0.1 * i, seen_s = t_s + 0.01;
      if (is_recorded(t_s)) samples.push_back({t_s, came_at_s(t_s), robot(t_s), false});
      if (i % 2 == 0 && is_recorded(t_s) && camera_is_there(t_s))
        samples.push_back({seen_s, came_at_s(seen_s) + 0.03, camera(seen_s), true});
    }
    std::ranges::stable_sort(samples, {}, &Sample::came_s);
    return samples;
  }
};

struct Mended {
  std::vector<ClockJump> jumps;
  double worst_s = 0.0;     ///< largest error of a stamp, apart from a common offset
  double worst_side_s = 0;  ///< largest error of bearings relative to odometry
  std::size_t readings = 0, sets = 0;
};

Mended mended(
    const Recording& recording, const std::function<bool(std::size_t)>& goes_on = [](std::size_t) { return true; }) {
  std::vector<ArrivedStamps> streams(2);
  std::vector<double> truth[2];
  std::uint64_t place = 0;
  for (const Recording::Sample& sample : recording.samples()) {
    ArrivedStamps& stream = streams[sample.of_camera ? 1 : 0];
    stream.stamps.push_back(at(sample.said_s));
    stream.arrivals.push_back({++place, at(recording.recorder(sample.came_s))});
    truth[sample.of_camera ? 1 : 0].push_back(sample.true_s);
  }
  const MendedClocks clocks = mend_clock_jumps(streams, goes_on);
  Mended result{.jumps = clocks.jumps};
  for (std::size_t stream = 0; stream < 2; ++stream) {
    for (std::size_t i = 0; i < truth[stream].size(); ++i) {
      if (!clocks.left_out.empty() && clocks.left_out[stream][i]) continue;
      const double off_s = to_seconds(streams[stream].stamps[i] - at(truth[stream][i]));
      result.worst_s = std::max(result.worst_s, std::abs(off_s));
      ++(stream == 0 ? result.readings : result.sets);
    }
  }
  return result;
}

TEST(ClockJumps, NoneLeavesEveryStampAsItIs) {
  const Mended result = mended({});
  EXPECT_TRUE(result.jumps.empty());
  EXPECT_EQ(result.worst_s, 0.0);
  EXPECT_EQ(result.readings, 600U);
}

TEST(ClockJumps, AMachinesClockSetBackIsOneJumpOfAllStreams) {
  for (const double by_s : {-3600.0, -15.0, -1.0}) {
    const Shows clock = set_by(by_s, 127.0);
    const Mended result = mended({.robot = clock, .camera = clock, .recorder = clock});
    ASSERT_EQ(result.jumps.size(), 1U) << by_s;
    EXPECT_NEAR(result.jumps[0].by_s, by_s, 0.01);
    EXPECT_NEAR(result.jumps[0].at_s, 27.0, 0.11);
    EXPECT_LE(result.worst_s, 0.01) << by_s;
    EXPECT_EQ(result.readings + result.sets, 900U) << "nothing is lost";
  }
}

TEST(ClockJumps, ACameraThatWasAwayThenHasTheSameJump) {
  const Shows clock = set_by(-15.0, 140.0);
  for (const double back_s : {139.0, 144.0, 158.0}) {
    const Mended result =
        mended({.robot = clock, .camera = clock, .recorder = clock, .camera_is_there = [&](double t_s) {
                  return t_s < 128.0 || t_s >= back_s;
                }});
    ASSERT_EQ(result.jumps.size(), 1U) << back_s;
    EXPECT_LE(result.worst_s, 0.01) << back_s;
  }
}

TEST(ClockJumps, ARobotsClockSetForwardShowsBesideTheRecorders) {
  const Shows clock = set_by(12.0, 130.0);
  const Mended result = mended({.robot = clock, .camera = clock});
  ASSERT_EQ(result.jumps.size(), 1U);
  EXPECT_NEAR(result.jumps[0].by_s, 12.0, 0.01);
  EXPECT_LE(result.worst_s, 0.01);
}

TEST(ClockJumps, TheRecordersClockTellsHowLongWasNotRecorded) {
  const Shows clock = set_by(-30.0, 130.0);
  const Mended result =
      mended({.robot = clock, .camera = clock, .is_recorded = [](double t_s) { return t_s < 125.0 || t_s > 132.0; }});
  ASSERT_EQ(result.jumps.size(), 1U);
  EXPECT_NEAR(result.jumps[0].by_s, -30.0, 0.05);
  EXPECT_LE(result.worst_s, 0.05);
}

TEST(ClockJumps, AnOutageIsNone) {
  const Mended result = mended({.is_recorded = [](double t_s) { return t_s < 120.0 || t_s > 140.0; }});
  EXPECT_TRUE(result.jumps.empty());
  EXPECT_EQ(result.worst_s, 0.0);
  const Mended away = mended({.camera_is_there = [](double t_s) { return t_s < 120.0 || t_s > 150.0; }});
  EXPECT_TRUE(away.jumps.empty());
  EXPECT_EQ(away.worst_s, 0.0);
}

TEST(ClockJumps, WhatWaitedOnItsWayIsNone) {
  for (const double lost_s : {0.0, 4.0}) {
    const Mended result = mended({.is_recorded = [&](double t_s) { return t_s < 130.0 || t_s >= 130.0 + lost_s; },
                                  .came_at_s = [](double t_s) { return t_s < 126.0 || t_s > 134.5 ? t_s : 134.5; }});
    EXPECT_TRUE(result.jumps.empty()) << lost_s;
    EXPECT_EQ(result.worst_s, 0.0) << lost_s;
  }
}

TEST(ClockJumps, ACamerasOwnClockIsMovedAlone) {
  for (const double by_s : {-20.0, 20.0}) {
    const Mended result = mended({.camera = set_by(by_s, 131.0)});
    ASSERT_EQ(result.jumps.size(), 1U) << by_s;
    EXPECT_NEAR(result.jumps[0].by_s, by_s, 0.06);
    EXPECT_LE(result.worst_s, 0.06);
  }
}

TEST(ClockJumps, ARobotsClockLeavesACameraOfAnotherMachineAlone) {
  const Mended result = mended({.robot = set_by(-20.0, 131.0)});
  ASSERT_EQ(result.jumps.size(), 1U);
  EXPECT_LE(result.worst_s, 0.01);
}

TEST(ClockJumps, SeveralAreMovedOneAfterTheOther) {
  const auto clock = [](double t_s) { return t_s < 115.0 ? t_s : t_s < 140.0 ? t_s - 600.0 : t_s - 608.0; };
  const Mended result = mended({.robot = clock, .camera = clock, .recorder = clock});
  ASSERT_EQ(result.jumps.size(), 2U);
  EXPECT_NEAR(result.jumps[1].by_s, -8.0, 0.01);
  EXPECT_LE(result.worst_s, 0.02);
}

TEST(ClockJumps, WildStampsAndAFewOvertakenAreNone) {
  const auto wild = [](double t_s) { return std::abs(t_s - 120.0) < 0.04 ? t_s + 1e6 : t_s; };
  EXPECT_TRUE(mended({.robot = wild, .camera = wild}).jumps.empty());
  const auto early = [](double t_s) { return std::abs(t_s - 120.0) < 0.04 ? -5.0 : t_s; };
  EXPECT_TRUE(mended({.robot = early, .camera = early}).jumps.empty());
  const auto late = [](double t_s) { return t_s > 119.95 && t_s < 120.15 ? t_s + 0.2 : t_s; };
  EXPECT_TRUE(mended({.came_at_s = late}).jumps.empty());
}

TEST(ClockJumps, OfTwoDrivesOnePartIsUsedOfAllStreams) {
  const Shows clock = set_by(-20.0, 120.0);
  const Mended result = mended({.robot = clock, .camera = clock, .recorder = clock}, [](std::size_t) { return false; });
  ASSERT_EQ(result.jumps.size(), 1U);
  EXPECT_TRUE(result.jumps[0].ends_drive);
  EXPECT_EQ(result.readings, 400U);
  EXPECT_NEAR(static_cast<double>(result.sets), 200.0, 1.0);
  EXPECT_THAT(text(result.jumps[0]), HasSubstr("set back 20.0 s at 20.0 s"));
}

TEST(ClockJumps, ALogSaysItWithTimeAndSize) {
  test::LogText log;
  log.rig();
  for (std::int64_t i = 0; i < 100; ++i) {
    const std::int64_t us = 4'000'000'000 + 100'000 * i - (i < 40 ? 0 : 3'600'000'000);
    log.odometry(us).bearings(us + 10'000);
  }
  const azimuth::Run run = test::collected(log);
  EXPECT_EQ(run.odometry.size(), 100U);
  EXPECT_EQ(run.bearings.size(), 100U);
  EXPECT_EQ(run.odometry.back().stamp - run.odometry.front().stamp, Duration{9'900'000});
  EXPECT_EQ(run.bearings.back().stamp - run.odometry.back().stamp, Duration{10'000});
  EXPECT_EQ(run.skipped.text(), "the clock was set back 3600.0 s at 4.0 s (what came later is moved by as much)");
}

TEST(ClockJumps, OfALogARobotThatIsElsewhereAfterItUsesTheLongerPart) {
  test::LogText log;
  log.rig();
  for (std::int64_t i = 0; i < 100; ++i) {
    const std::int64_t us = 4'000'000 + 100'000 * (i < 30 ? i : i - 30);
    const double x_m = 0.05 * static_cast<double>(i < 30 ? i + 100 : i - 30);
    log.add(channel::kOdometry, to_message(OdometryReading{stamp_from_us(us), 0, 0, Pose2{x_m, 0.0, 0.0}}));
    log.bearings(us + 10'000);
  }
  const azimuth::Run run = test::collected(log);
  EXPECT_EQ(run.odometry.size(), 70U);
  EXPECT_EQ(run.bearings.size(), 70U);
  EXPECT_EQ(run.skipped.odometry_not_in_order, 30U);
  EXPECT_THAT(run.skipped.text(), HasSubstr("odometry is elsewhere after it: only the longest part is used"));
}

}  // namespace
}  // namespace azimuth
