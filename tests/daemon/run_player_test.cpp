#include <gtest/gtest.h>

#include "daemon/pipeline/played_source.hpp"
#include "tests/daemon/small_run.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr auto kLimit = 100ms;

Recording tied_recording() {
  Recording recording;
  for (const std::int64_t t_us : {0, 1000, 2000}) recording.odometry.push_back({stamp_from_us(t_us), 0, 0, {}});
  for (const std::int64_t t_us : {1000, 1500, 9000}) recording.bearings.push_back({stamp_from_us(t_us), 0, {}});
  return recording;
}

TEST(RunPlayer, OdometryComesBeforeBearingsOfTheSameStamp) {
  RunPlayer player(tied_recording(), 0.0);
  std::string order;
  for (; !player.over(); player.advance()) order += player.peek().odometry ? 'o' : 'b';
  EXPECT_EQ(order, "oobbob");
  EXPECT_EQ(player.peek().odometry, nullptr);
  EXPECT_EQ(player.peek().bearings, nullptr);
}

TEST(RunPlayer, FramesComeInTheirPlaceByTheirIndex) {
  Recording recording = tied_recording();
  recording.bearings.clear();
  for (const std::int64_t t_us : {-5, 1000, 2000, 2001}) recording.frames.push_back(stamp_from_us(t_us));
  RunPlayer player(std::move(recording), 0.0);
  std::string order;
  for (; !player.over(); player.advance()) {
    const RunPlayer::Sample sample = player.peek();
    order += sample.odometry ? "o" : std::to_string(sample.frame.value());
  }
  EXPECT_EQ(order, "0oo1o23");
}

TEST(RunPlayer, KeepsTheRecordingsPaceTimesSpeed) {
  const RunPlayer::Clock::time_point start{1h};
  RunPlayer player(tied_recording(), 2.0);
  EXPECT_LE(player.due_in(start, kLimit), 0ns);
  player.advance();
  EXPECT_EQ(player.due_in(start, kLimit), 500us);
  EXPECT_EQ(player.due_in(start + 200us, kLimit), 300us);
  EXPECT_LE(player.due_in(start + 700us, kLimit), 0ns);
  for (int i = 0; i < 4; ++i) player.advance();
  EXPECT_EQ(player.due_in(start, kLimit), 4500us);
  EXPECT_EQ(player.due_in(start, 1ms), 1ms) << "never asks to sleep longer than the limit";
}

TEST(RunPlayer, AsFastAsPossibleIsAlwaysDue) {
  RunPlayer player(tied_recording(), 0.0);
  for (; !player.over(); player.advance()) EXPECT_LE(player.due_in(RunPlayer::Clock::now(), kLimit), 0ns);
}

TEST(RunPlayer, SurvivesStampsThatAreAgesApart) {
  Recording recording;
  constexpr std::int64_t kAges_us = 2'000'000'000'000'000'000;
  recording.odometry = {{stamp_from_us(-kAges_us), 0, 0, {}}, {stamp_from_us(kAges_us), 0, 0, {}}};
  RunPlayer player(std::move(recording), 1.0);
  const auto now = RunPlayer::Clock::now();
  EXPECT_LE(player.due_in(now, kLimit), 0ns);
  player.advance();
  EXPECT_EQ(player.due_in(now, kLimit), kLimit);
}

TEST(RunPlayer, AnEmptyRecordingIsOver) { EXPECT_TRUE(RunPlayer({}, 1.0).over()); }

}  // namespace
}  // namespace azimuth
