#include "daemon/record/recorder.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include "drivers/storage/event_log.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/daemon/record/recorder_fixture.hpp"
#include "tests/daemon/record/recording.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::expect_readings;
using test::Feeder;
using test::RecorderTest;
using testing::HasSubstr;
using testing::MatchesRegex;

std::int64_t now_us() {
  return std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()).count();
}

TEST_F(RecorderTest, EverythingComesBackBitForBit) {
  OdometryReading gap = test::reading(500);
  gap.origin = 3;
  gap.sigma_gap_m = 0.1;
  gap.sigma_gap_rad = 0.2;
  {
    Feeder feeder(settings());
    feeder.feed(500);
    feeder.recorder().odometry(gap);
    EXPECT_TRUE(feeder.status().on);
    EXPECT_EQ(feeder.status().events, feeder.fed() + 1);
    EXPECT_EQ(feeder.status().lost_events, 0U);
  }
  const azimuth::Run run = test::load(session());
  ASSERT_EQ(run.odometry.size(), 501U);
  EXPECT_EQ(run.odometry.back(), gap);
  EXPECT_EQ(run.bearings.size(), 50U);
  EXPECT_EQ(run.rig_toml, test::documents()[0].text);
  EXPECT_EQ(run.configuration_toml, test::documents()[1].text);
  EXPECT_EQ(run.recorded_by, "1.2.3");
  EXPECT_EQ(run.skipped, Skipped{});
  EXPECT_TRUE(run.from_the_start);
}

TEST_F(RecorderTest, SessionsAreNamedByTheirStart) {
  { const Feeder first(settings()), second(settings()), third(settings()); }
  const auto sessions = test::sessions(folder_.path());
  ASSERT_EQ(sessions.size(), 3U);
  const std::string start = R"([0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}-[0-9]{2}-[0-9]{2}Z)";
  EXPECT_THAT(sessions[0].filename().string(), MatchesRegex(start));
  EXPECT_THAT(sessions[2].filename().string(), MatchesRegex(start + "(-[23])?"));
}

TEST_F(RecorderTest, MessagesAreRecordedAsSentAndSamplesOnce) {
  RecordSettings prefixed = settings();
  prefixed.channel_prefix = "R1_";
  const std::vector<std::byte> data(40, std::byte{7});
  {
    Feeder feeder(prefixed);
    feeder.feed(1);
    for (const char* channel : {"AZIMUTH_ODOM", "AZIMUTH_BEARINGS", "AZIMUTH_STATUS"})
      feeder.recorder().message(channel, data);
    EXPECT_EQ(feeder.status().events, 3U);
  }
  auto log = EventLogReader::open(session() / "000.lcm");
  ASSERT_TRUE(log);
  std::vector<std::string> channels;
  while (const auto event = log->next()) {
    channels.emplace_back(event->channel);
    if (event->channel != "R1_AZIMUTH_STATUS") continue;
    EXPECT_TRUE(std::ranges::equal(event->data, data));
  }
  EXPECT_THAT(channels, testing::ElementsAre("R1_AZIMUTH_DOCUMENT", "R1_AZIMUTH_DOCUMENT", "R1_AZIMUTH_DOCUMENT",
                                             "R1_AZIMUTH_DOCUMENT", "R1_AZIMUTH_ODOM", "R1_AZIMUTH_BEARINGS",
                                             "R1_AZIMUTH_STATUS"));
  EXPECT_EQ(test::load(session(), {.channel_prefix = "R1_"}).odometry.size(), 1U);
}

TEST_F(RecorderTest, EventTimesNeverGoBackAndLieAsFarApartAsTheSamples) {
  RecordSettings small = settings();
  small.max_file_mb = 0.05;
  const std::int64_t before_us = now_us();
  {
    Feeder feeder(small, EventTimes::of_recording(test::reading(0).stamp));
    for (int i = 0; i < 100; ++i) {
      feeder.feed(10);
      feeder.recorder().message("AZIMUTH_STATUS", std::vector<std::byte>(400));
    }
  }
  std::optional<std::int64_t> first_us, last_us;
  for (const SegmentFile& segment : session_segments(session())) {
    auto log = EventLogReader::open(segment.file);
    ASSERT_TRUE(log);
    while (const auto event = log->next()) {
      EXPECT_GE(event->utime_us, last_us.value_or(before_us)) << event->channel;
      last_us = event->utime_us;
      if (!first_us) first_us = last_us;
    }
  }
  ASSERT_TRUE(last_us);
  const std::int64_t drive_us = to_us(test::reading(999).stamp) - to_us(test::reading(0).stamp);
  EXPECT_NEAR(static_cast<double>(*last_us - *first_us), static_cast<double>(drive_us), 10e3);
  EXPECT_LT(*first_us, now_us());
  EXPECT_EQ(test::load(session()).odometry.front(), test::reading(0)) << "their own stamps are untouched";
}

TEST_F(RecorderTest, FeaturesAreRecordedWithAllThatIsKnown) {
  BearingSet seen = test::bearing_set(1, 4), dark = test::bearing_set(2, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    seen.bearings[i].kind = static_cast<Kind>(i);
    seen.descriptors.emplace_back().values[i] = 200;
    seen.neighbours.emplace_back().index[0] = static_cast<std::uint16_t>(3 - i);
  }
  dark.trouble = ImageTrouble::dark;
  {
    Feeder feeder(settings());
    feeder.feed(1);
    feeder.recorder().bearings(seen);
    feeder.recorder().bearings(dark);
    // the echo of the descriptors that `seen` carries
    feeder.recorder().message("AZIMUTH_FEATURES", std::vector<std::byte>(40));
    EXPECT_EQ(feeder.status().events, 4U);
  }
  const azimuth::Run run = test::load(session());
  ASSERT_EQ(run.bearings.size(), 3U);
  EXPECT_EQ(run.bearings[1].bearings[3].kind, 3);
  EXPECT_EQ(run.bearings[1].descriptors, seen.descriptors);
  EXPECT_EQ(run.bearings[1].neighbours, seen.neighbours);
  EXPECT_EQ(run.bearings[2].trouble, ImageTrouble::dark);
  EXPECT_EQ(run.skipped, Skipped{});
}

TEST_F(RecorderTest, WithoutAFolderNothingHappens) {
  RecordSettings off = settings();
  off.folder.clear();
  Feeder feeder(off);
  feeder.feed(1000);
  EXPECT_FALSE(feeder.status().on);
  EXPECT_EQ(feeder.status().reason, "no folder is configured");
  EXPECT_EQ(feeder.status().lost_events, 0U);
}

TEST_F(RecorderTest, FlushesInTime) {
  Feeder feeder(settings());
  feeder.feed(1000);
  // The log, read while the recorder still runs, misses less than a flush interval.
  const auto missing = 1000 - test::load(session()).odometry.size();
  EXPECT_LE(missing * test::kReadingInterval, 200ms);
}

TEST_F(RecorderTest, WhatTheFormatCannotHoldIsLostAndNothingElse) {
  {
    Feeder feeder(settings());
    feeder.feed(10);
    feeder.recorder().message(std::string(64, 'C'), {});
    feeder.recorder().message("", {});
    feeder.feed(10);
    EXPECT_EQ(feeder.status().lost_events, 2U);
    EXPECT_EQ(feeder.status().events, feeder.fed());
    EXPECT_TRUE(feeder.status().on);
  }
  expect_readings(test::load(session()), 0, 20);
}

TEST_F(RecorderTest, NothingAllocatesWhileASegmentIsWritten) {
  Feeder feeder(settings());
  const std::vector<std::byte> map(57'600);
  const BearingSet set = test::bearing_set(0, kTypicalBearings);
  feeder.feed(100);
  feeder.recorder().message("AZIMUTH_MAP_CHUNK", map);
  std::size_t allocated = 0;
  for (int i = 0; i < 100; ++i) {
    feeder.wait(50ms);
    const std::size_t before = allocations();
    for (std::uint64_t k = 0; k < 50; ++k) feeder.recorder().odometry(test::reading(k));
    feeder.recorder().bearings(set);
    feeder.recorder().message("AZIMUTH_MAP_CHUNK", map);
    allocated += allocations() - before;
  }
  EXPECT_EQ(allocated, 0U);
  const std::size_t before = allocations();
  feeder.wait(900ms);
  EXPECT_EQ(allocations() - before, 0U) << "flushing";
}

}  // namespace
}  // namespace azimuth
