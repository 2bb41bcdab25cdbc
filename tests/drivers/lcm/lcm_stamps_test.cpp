#include "drivers/lcm/lcm_stamps.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr Stamp kNow = stamp_from_us(1'700'000'000'000'000);

TEST(LcmStamps, AreTheSendersWhereTheyCanBeTrue) {
  LcmStamps stamps(LcmStampKind::sender, 1s);
  EXPECT_EQ(stamps.judge(kNow - 30ms, {kNow, {}}), kNow - 30ms);
  EXPECT_EQ(stamps.judge(kNow, {kNow, {}}), kNow);
  EXPECT_EQ(stamps.judge(kNow + LcmStamps::kTolerance, {kNow, {}}), kNow + LcmStamps::kTolerance);
  EXPECT_EQ(stamps.counts().too_old + stamps.counts().in_future + stamps.counts().out_of_order, 0U);
}

TEST(LcmStamps, WhatCannotBeTrueIsCountedAndDropped) {
  LcmStamps stamps(LcmStampKind::sender, 1s);
  EXPECT_FALSE(stamps.judge(kNow - 1001ms, {kNow, {}}));
  EXPECT_FALSE(stamps.judge(stamp_from_us(0), {kNow, {}}));
  EXPECT_FALSE(stamps.judge(stamp_from_us(std::numeric_limits<std::int64_t>::min()), {kNow, {}}));
  EXPECT_EQ(stamps.counts().too_old, 3U);
  EXPECT_FALSE(stamps.judge(kNow + 21ms, {kNow, {}}));
  EXPECT_FALSE(stamps.judge(stamp_from_us(std::numeric_limits<std::int64_t>::max()), {kNow, {}}));
  EXPECT_EQ(stamps.counts().in_future, 2U);
  EXPECT_EQ(stamps.judge(kNow, {kNow, {}}), kNow) << "no trace of them is left";
}

TEST(LcmStamps, KnowHowFarOffTheSendersClockIs) {
  LcmStamps stamps(LcmStampKind::sender, 1s);
  EXPECT_FALSE(stamps.judge(kNow - 1h + 5s, {kNow, 5s}));
  EXPECT_EQ(stamps.counts().last_off_s, -3600.0);
  EXPECT_FALSE(stamps.judge(kNow + 2s, {kNow, {}}));
  EXPECT_EQ(stamps.counts().last_off_s, 2.0);
  EXPECT_FALSE(stamps.judge(stamp_from_us(std::numeric_limits<std::int64_t>::min()), {kNow, {}}));
  EXPECT_LT(stamps.counts().last_off_s, -9e12);
  EXPECT_EQ(stamps.counts().misdated(), 3U);
}

TEST(LcmStamps, AscendStrictly) {
  LcmStamps stamps(LcmStampKind::sender, 1s);
  EXPECT_TRUE(stamps.judge(kNow, {kNow, {}}));
  EXPECT_FALSE(stamps.judge(kNow, {kNow, {}}));
  EXPECT_FALSE(stamps.judge(kNow - 1us, {kNow, {}}));
  EXPECT_TRUE(stamps.judge(kNow + 1us, {kNow, {}}));
  EXPECT_EQ(stamps.counts().out_of_order, 2U);
}

/// The wall clock is an hour slow at the daemon's start and is set later.
TEST(LcmStamps, RunEvenlyWhenTheWallClockIsSet) {
  LcmStamps stamps(LcmStampKind::sender, 1s);
  EXPECT_EQ(stamps.judge(kNow - 30ms, {kNow, {}}), kNow - 30ms);
  EXPECT_EQ(stamps.judge(kNow + 1h + 70ms, {kNow + 100ms, 1h}), kNow + 70ms);
  EXPECT_EQ(stamps.judge(kNow - 2h + 170ms, {kNow + 200ms, -2h}), kNow + 170ms);
}

TEST(LcmStamps, AreThoseOfTheReceiptWhereThatIsWanted) {
  LcmStamps stamps(LcmStampKind::receipt, 1s);
  EXPECT_EQ(stamps.judge(stamp_from_us(5), {kNow, {}}), kNow);
  EXPECT_EQ(stamps.judge(stamp_from_us(-5), {kNow + 1ms, {}}), kNow + 1ms);
  EXPECT_FALSE(stamps.judge(stamp_from_us(7), {kNow + 1ms, {}}));
  EXPECT_EQ(stamps.counts().out_of_order, 1U);
}

TEST(LcmWallLead, ChangesOnlyWhenTheClockWasMoved) {
  LcmWallLead lead;
  EXPECT_EQ(lead.value(), 0s);
  lead.look(kNow, kNow + 1h, kNow + 10ms);
  EXPECT_EQ(lead.value(), 1h - 5ms) << "the first reading is better than none";
  lead.look(kNow, kNow + 1h + 1us, kNow + 2us);
  EXPECT_EQ(lead.value(), 1h) << "this one was closer";
  lead.look(kNow, kNow + 1h + 400us, kNow + 2us);
  EXPECT_EQ(lead.value(), 1h) << "not enough to matter";
  lead.look(kNow, kNow + 1h + 3ms, kNow + 3ms);
  EXPECT_EQ(lead.value(), 1h) << "the thread slept";
  lead.look(kNow, kNow + 2h, kNow);
  EXPECT_EQ(lead.value(), 2h);
  lead.look(kNow, kNow - 1h, kNow);
  EXPECT_EQ(lead.value(), -1h);
}

}  // namespace
}  // namespace azimuth
