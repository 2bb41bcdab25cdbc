#include "daemon/record/event_times.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

constexpr std::int64_t kLeast_us = EventTimes::kLeast_us;

std::int64_t wall_us() {
  return std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()).count();
}

TEST(EventTimes, OfARecordingBeginNowAndGoOnWithItsSamples) {
  for (const std::int64_t first_us : {std::int64_t{0}, std::int64_t{1'248'272'273'000'000}, std::int64_t{-50'001}}) {
    const std::int64_t before_us = wall_us();
    EventTimes times = EventTimes::of_recording(stamp_from_us(first_us));
    const std::int64_t begins_us = times.now();
    EXPECT_GE(begins_us, before_us);
    EXPECT_LE(begins_us, wall_us());
    EXPECT_EQ(times.of_sample(stamp_from_us(first_us + 250'000)), begins_us + 250'000);
    EXPECT_EQ(times.now(), begins_us + 250'000 + kLeast_us) << "what is published belongs to the newest sample";
    EXPECT_EQ(times.of_sample(stamp_from_us(first_us + 100'000)), begins_us + 250'000 + 2 * kLeast_us) << "never back";
    EXPECT_EQ(times.of_sample(stamp_from_us(first_us + 300'000)), begins_us + 300'000) << "and made up for";
  }
}

TEST(EventTimes, LiveAreTheClockOfTheStamps) {
  const auto monotonic = [] {
    return std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch());
  };
  const Duration ahead = Duration(1'700'000'000'000'000) - monotonic();
  EventTimes times = EventTimes::live(ahead);
  std::int64_t last_us = times.now();
  EXPECT_LE(last_us, (monotonic() + ahead).count());
  for (int i = 0; i < 1000; ++i) {
    // Every other stamp is older than the current time or comes from a sender with another clock.
    const std::int64_t us = i % 2 == 0 ? times.now() : times.of_sample(stamp_from_us(i * 1'000'000'000'000));
    EXPECT_GE(us, last_us + kLeast_us);
    EXPECT_LE(us, std::max((monotonic() + ahead).count(), last_us + kLeast_us));
    last_us = us;
  }
  EXPECT_GE(last_us, 1'700'000'000'000'000);
}

}  // namespace
}  // namespace azimuth
