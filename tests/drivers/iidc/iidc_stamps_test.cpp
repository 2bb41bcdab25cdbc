#include "drivers/iidc/iidc_stamps.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "drivers/iidc/iidc_camera.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth::iidc {
namespace {

constexpr std::int64_t kWall = 1'700'000'000'000'000, kMonotonic = 5'000'000;

ClockReading after(std::int64_t us, std::int64_t step_us = 0) { return {kWall + us + step_us, kMonotonic + us}; }
std::uint64_t wall_at(std::int64_t us, std::int64_t step_us = 0) {
  return static_cast<std::uint64_t>(kWall + us + step_us);
}
std::int64_t since_start(Stamp stamp) { return to_us(stamp) - kMonotonic; }

TEST(IidcStampClock, AgeIsTakenFromTheMonotonicClock) {
  StampClock clock(after(0));
  EXPECT_EQ(since_start(clock.monotonic(wall_at(1000), after(1500))), 1000);
  EXPECT_EQ(since_start(clock.monotonic(wall_at(67000), after(67000))), 67000);
}

TEST(IidcStampClock, StampsThatCannotBeTrueBecomeTheTimeOfReading) {
  StampClock clock(after(0));
  EXPECT_EQ(since_start(clock.monotonic(0, after(1500))), 1500);
  EXPECT_EQ(since_start(clock.monotonic(wall_at(1600), after(1501))), 1501);
  EXPECT_EQ(since_start(clock.monotonic(wall_at(2000) - 10'000'001, after(2000))), 2000);
  EXPECT_EQ(since_start(clock.monotonic(~std::uint64_t{0}, after(2001))), 2001);
}

TEST(IidcStampClock, StepsOfTheWallClockDoNotMoveStamps) {
  for (const std::int64_t step_us : {-3'600'000'000LL, -300'000LL, 300'000LL, 3'600'000'000LL}) {
    StampClock clock(after(0));
    EXPECT_EQ(since_start(clock.monotonic(wall_at(10'000), after(11'000))), 10'000);
    // Two frames were waiting when the clock was stepped.
    EXPECT_EQ(since_start(clock.monotonic(wall_at(40'000), after(71'000, step_us))), 71'000);
    EXPECT_EQ(since_start(clock.monotonic(wall_at(70'000, step_us), after(71'100, step_us))), 71'100);
    clock.drained(after(71'200, step_us));
    EXPECT_EQ(since_start(clock.monotonic(wall_at(100'000, step_us), after(101'000, step_us))), 100'000);
  }
}

TEST(IidcStampClock, SlewIsNoStep) {
  StampClock clock(after(0));
  for (std::int64_t us = 0, slew_us = 0; us < 100'000'000; us += 10'000'000, slew_us += 5'000)
    EXPECT_EQ(since_start(clock.monotonic(wall_at(us - 400, slew_us), after(us, slew_us))), us - 400);
}

TEST(IidcFrameCounter, FramesInTimeCountOne) {
  FrameCounter counter(15.0);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(counter.next(stamp_from_us(i * 66'667)), static_cast<std::uint64_t>(i));
}

TEST(IidcFrameCounter, GapsCountExactly) {
  FrameCounter counter(30.0);
  std::uint64_t sent = 0;
  for (const std::uint64_t lost : {0, 0, 1, 0, 2, 0, 0, 7, 0, 30, 0, 0, 1, 1, 0}) {
    EXPECT_EQ(counter.next(stamp_from_us(static_cast<std::int64_t>(sent) * 33'333)), sent);
    sent += lost + 1;
  }
}

/// Frames are dropped and delayed at random. The count must be right as long as no frame is nearly half an interval
/// late and the losses are not perfectly regular.
RC_GTEST_PROP(IidcFrameCounter, JitterDoesNotMiscount, (const std::vector<bool>& kept)) {
  FrameCounter counter(20.0);
  std::optional<std::uint64_t> first;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i] && i % 6 > 1) continue;
    const auto jitter_us = *rc::gen::inRange<std::int64_t>(0, 12'000);
    const std::uint64_t sequence = counter.next(stamp_from_us(static_cast<std::int64_t>(i) * 50'000 + jitter_us));
    if (!first) first = i;
    RC_ASSERT(sequence == i - *first);
  }
}

TEST(IidcFrameCounter, CameraThatIsSlowerThanAgreedIsBelievedSoon) {
  FrameCounter counter(30.0);
  std::uint64_t last = 0;
  for (int i = 0; i < FrameCounter::kSteady; ++i) last = counter.next(stamp_from_us(i * 90'000));
  EXPECT_GT(last, static_cast<std::uint64_t>(FrameCounter::kSteady));
  for (int i = FrameCounter::kSteady; i < 50; ++i) {
    const std::uint64_t next = counter.next(stamp_from_us(i * 90'000));
    EXPECT_TRUE(i == FrameCounter::kSteady || next == last + 1) << i;
    last = next;
  }
  EXPECT_EQ(counter.next(stamp_from_us(52 * 90'000)), last + 3);
}

TEST(IidcFrameCounter, WithoutAnAgreedRateTheFirstFramesCountOneEach) {
  FrameCounter counter(0.0);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(counter.next(stamp_from_us(i * 40'000)), static_cast<std::uint64_t>(i));
  EXPECT_EQ(counter.next(stamp_from_us(22 * 40'000)), 22U);
}

TEST(IidcFrameCounter, ALateFrameDoesNotHideALaterGap) {
  FrameCounter counter(10.0);
  EXPECT_EQ(counter.next(stamp_from_us(0)), 0U);
  EXPECT_EQ(counter.next(stamp_from_us(170'000)), 2U);  // so late that it looks like two frames
  EXPECT_EQ(counter.next(stamp_from_us(200'000)), 3U);
  EXPECT_EQ(counter.next(stamp_from_us(300'000)), 4U);
  EXPECT_EQ(counter.next(stamp_from_us(600'000)), 7U);
}

TEST(IidcFrameCounter, StampsThatStandStillOrGoBackCountOne) {
  FrameCounter counter(10.0);
  EXPECT_EQ(counter.next(stamp_from_us(1'000'000)), 0U);
  EXPECT_EQ(counter.next(stamp_from_us(1'000'000)), 1U);
  EXPECT_EQ(counter.next(stamp_from_us(0)), 2U);
  EXPECT_EQ(counter.next(stamp_from_us(100'000)), 3U);
}

TEST(IidcUsbPort, IsFoundByBusAndAddress) {
  const test::TemporaryFolder folder;
  const auto device = [&](const char* name, const char* bus, const char* address) {
    std::filesystem::create_directory(folder / name);
    std::ofstream(folder / name / "busnum") << bus << '\n';
    std::ofstream(folder / name / "devnum") << address << '\n';
  };
  device("usb1", "1", "1");
  device("1-2.3", "1", "7");
  device("2-1", "2", "7");
  device("3-1", "junk", "");
  std::filesystem::create_directory(folder / "1-2.3:1.0");  // a USB interface
  EXPECT_EQ(usb_port_of(1, 7, folder.path()), "1-2.3");
  EXPECT_EQ(usb_port_of(2, 7, folder.path()), "2-1");
  EXPECT_EQ(usb_port_of(3, 7, folder.path()), "");
  EXPECT_EQ(usb_port_of(1, 7, folder / "none"), "");
}

}  // namespace
}  // namespace azimuth::iidc
