#include "drivers/lcm/lcm_odometry.hpp"

#include <cmath>
#include <limits>

#include "tests/drivers/lcm/lcm_odometry_fixture.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST_F(LcmOdometryTest, HandsReadingsOn) {
  const Stamp start = now_;
  send(reading(17, 1.0));
  send(reading(18, 1.1));
  const auto all = taken();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].stamp, start);
  EXPECT_EQ(all[1].stamp, start + 100ms);
  EXPECT_EQ(all[1].T_odom_body.x_m, 1.1);
  EXPECT_EQ(all[1].T_odom_body.y_m, 2.0);
  EXPECT_EQ(all[1].T_odom_body.heading_rad, 0.5);
  EXPECT_EQ(all[1].sequence, all[0].sequence + 1);
  EXPECT_EQ(all[1].origin, all[0].origin);
  EXPECT_EQ(odometry_.counts().missing, 0U);
}

TEST_F(LcmOdometryTest, UnderstandsThePoseOfBotCore) {
  for (const double heading_rad : {0.0, 1.0, -2.5, 3.1}) send(pose(0.1, heading_rad));
  const auto all = taken();
  ASSERT_EQ(all.size(), 4U);
  EXPECT_NEAR(all[1].T_odom_body.heading_rad, 1.0, 1e-12);
  EXPECT_NEAR(all[2].T_odom_body.heading_rad, -2.5, 1e-12);
  EXPECT_NEAR(all[3].T_odom_body.heading_rad, 3.1, 1e-12);
  EXPECT_EQ(all[3].T_odom_body.y_m, -1.0);
  EXPECT_EQ(all[3].sequence, all[0].sequence + 3);
  EXPECT_EQ(all[3].origin, all[0].origin);
}

/// A small tilt of the body must not change its heading.
TEST_F(LcmOdometryTest, TakesTheTurnAboutTheVertical) {
  pose_t message = pose(0.0, 0.0);
  const double yaw = 0.7, pitch = 0.2;  // yaw first, then pitch about the body's own axis
  message.orientation[0] = std::cos(yaw / 2) * std::cos(pitch / 2);
  message.orientation[1] = -std::sin(yaw / 2) * std::sin(pitch / 2);
  message.orientation[2] = std::cos(yaw / 2) * std::sin(pitch / 2);
  message.orientation[3] = std::sin(yaw / 2) * std::cos(pitch / 2);
  send(message);
  const auto all = taken();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NEAR(all[0].T_odom_body.heading_rad, yaw, 1e-12);
}

TEST_F(LcmOdometryTest, GapsAreThoseOfTheSender) {
  send(reading(5));
  send(reading(9));
  const auto all = taken();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].sequence, all[0].sequence + 4);
  EXPECT_EQ(odometry_.counts().missing, 3U);
  EXPECT_EQ(all[1].origin, all[0].origin);
}

TEST_F(LcmOdometryTest, ASenderThatNeverCountsHasNoGapsAndOneOrigin) {
  for (int i = 0; i < 3; ++i) send(reading(0));
  const auto all = taken();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[2].sequence, all[0].sequence + 2);
  EXPECT_EQ(all[2].origin, all[0].origin);
}

TEST_F(LcmOdometryTest, ARestartIsANewOriginAndSequencesGoOn) {
  send(reading(500, 8.0));
  const std::function<void()> restarts[] = {[this] { send(reading(0, 8.0)); },    // the sequence restarts
                                            [this] { send(reading(1, 200.0)); },  // the pose jumps
                                            // The sequence is nonsense.
                                            [this] { send(reading(std::int64_t{1} << 60, 200.0)); },
                                            [this] {
                                              odometry_t other = reading((std::int64_t{1} << 60) + 1, 200.0);
                                              other.origin = 4;
                                              send(other);
                                            },
                                            [this] { send(pose(200.0, 0.0)); },  // the type changes
                                            [this] {
                                              now_ += 1s;
                                              send(pose(200.0, 0.0), kOtherLcmRobot);  // another process sends
                                            }};
  std::uint32_t origin = 1;
  std::uint64_t sequence = taken().at(0).sequence;
  for (const auto& restart : restarts) {
    restart();
    const auto all = taken();
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].origin, ++origin);
    EXPECT_EQ(all[0].sequence, ++sequence);
  }
  EXPECT_EQ(odometry_.counts().origins, origin);
  EXPECT_EQ(odometry_.counts().missing, 0U);
}

TEST_F(LcmOdometryTest, OneSenderAtATime) {
  send(reading(1));
  send(reading(77), kOtherLcmRobot);
  send(reading(2));
  EXPECT_EQ(taken().size(), 2U);
  EXPECT_EQ(odometry_.counts().other_senders, 1U);
  now_ += 1s;  // no messages
  encoded_.assign(10, std::byte{1});
  offer_encoded(kOtherLcmRobot);
  send(reading(3));
  EXPECT_EQ(taken().size(), 1U) << "nonsense takes nothing over";
  now_ += 1s;
  send(reading(78), kOtherLcmRobot);
  send(reading(4));
  EXPECT_EQ(taken().size(), 1U);
  EXPECT_EQ(odometry_.counts().other_senders, 2U);
  EXPECT_EQ(odometry_.senders(), 2U);
}

TEST_F(LcmOdometryTest, WhatCannotBeIsCountedAndLeavesNoTrace) {
  send(reading(1));
  const std::function<void(odometry_t&)> errors[] = {
      [](odometry_t& message) { message.x_m = kNaN; }, [](odometry_t& message) { message.y_m = 1e9; },
      [](odometry_t& message) { message.heading_rad = kNaN; }, [](odometry_t& message) { message.sigma_gap_m = -1.0; }};
  std::uint64_t malformed = 0;
  for (const auto& spoil : errors) {
    odometry_t message = reading(2);
    spoil(message);
    send(message);
    EXPECT_EQ(odometry_.counts().malformed, ++malformed);
  }
  const std::function<void(pose_t&)> pose_errors[] = {
      [](pose_t& message) { message.orientation[0] = 0.0; }, [](pose_t& message) { message.orientation[1] = kNaN; },
      [](pose_t& message) { message.orientation[2] = 1e300; }, [](pose_t& message) { message.pos[0] = 1e300; }};
  for (const auto& spoil : pose_errors) {
    pose_t message = pose(0.0, 0.0);
    spoil(message);
    send(message);
    EXPECT_EQ(odometry_.counts().malformed, ++malformed);
  }
  encode(reading(2), encoded_);
  encoded_.push_back({});
  offer_encoded();
  EXPECT_EQ(odometry_.counts().malformed, ++malformed);
  send(bearings_t{});
  EXPECT_EQ(odometry_.counts().malformed, ++malformed) << "of another type";
  EXPECT_EQ(taken().size(), 1U);
  send(reading(2));
  EXPECT_EQ(taken().size(), 1U);
  EXPECT_EQ(odometry_.counts().origins, 1U);
}

TEST_F(LcmOdometryTest, OtherChannelsAndPartsAreNotItsBusiness) {
  send(reading(1), kLcmRobot, "ODOMETRY2");
  send(reading(1), kLcmRobot, "ODOM");
  encode(reading(1), encoded_);
  for (const auto& part : test::in_parts(1, "ODOMETRY", encoded_, 40))
    test::offer(odometry_, part, kLcmRobot, {now_, {}});
  EXPECT_TRUE(taken().empty());
  EXPECT_EQ(odometry_.counts().malformed, 0U);
}

TEST_F(LcmOdometryTest, WrongStampsAreCountedAndDropped) {
  send(reading(1));
  odometry_t old = reading(2);
  old.utime -= 2'000'000;
  send(old);
  odometry_t late = reading(2);
  late.utime -= 250'000;
  send(late);
  EXPECT_EQ(taken().size(), 1U);
  EXPECT_EQ(odometry_.stamp_counts().too_old, 1U);
  EXPECT_EQ(odometry_.stamp_counts().out_of_order, 1U);
}

TEST_F(LcmOdometryTest, OfManyUntakenTheNewestStay) {
  const int many = LcmOdometry::kMaxUntaken + 10;
  for (int i = 1; i <= many; ++i) send(reading(i));
  const auto all = taken();
  ASSERT_EQ(all.size(), LcmOdometry::kMaxUntaken);
  EXPECT_EQ(odometry_.counts().replaced, 10U);
  EXPECT_EQ(all.back().stamp, now_ - 100ms);
}

TEST_F(LcmOdometryTest, AllocatesNothing) {
  std::vector<test::Datagram> datagrams;
  for (int i = 1; i < 50; ++i, now_ += 1ms) {
    encode(reading(i), encoded_);
    datagrams.push_back(test::whole_message(0, "ODOMETRY", encoded_));
    encode(pose(0.0, 0.1), encoded_);
    datagrams.push_back(test::whole_message(0, "ODOMETRY", encoded_));
  }
  const std::size_t before = allocations();
  for (const auto& datagram : datagrams) test::offer(odometry_, datagram, kLcmRobot, {now_, {}});
  EXPECT_EQ(allocations(), before);
  EXPECT_GE(odometry_.counts().readings, 49U);
}
}  // namespace
}  // namespace azimuth
