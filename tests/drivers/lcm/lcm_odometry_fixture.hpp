#pragma once
// LCM messages with a robot's odometry, in virtual time.

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "drivers/lcm/lcm_odometry.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/drivers/lcm/datagrams.hpp"

namespace azimuth {

inline constexpr LcmPeer kLcmRobot = 1, kOtherLcmRobot = 2;

class LcmOdometryTest : public ::testing::Test {
 protected:
  /// Sends a message that arrives 5 ms after its stamp, and advances the time by 100 ms.
  template <class Message>
  void send(const Message& message, LcmPeer sender = kLcmRobot, const char* channel = "ODOMETRY") {
    encode(message, encoded_);
    offer_encoded(sender, channel);
  }
  void offer_encoded(LcmPeer sender = kLcmRobot, const char* channel = "ODOMETRY") {
    EXPECT_TRUE(test::offer(odometry_, test::whole_message(0, channel, encoded_), sender,
                            {now_ + std::chrono::milliseconds(5), {}}));
    now_ += std::chrono::milliseconds(100);
  }
  odometry_t reading(std::int64_t sequence, double x_m = 0.0) const {
    odometry_t message{};
    message.utime = to_us(now_);
    message.seq = sequence;
    message.origin = 3;
    message.x_m = x_m;
    message.y_m = 2.0;
    message.heading_rad = 0.5;
    return message;
  }
  pose_t pose(double x_m, double heading_rad) const {
    pose_t message{};
    message.utime = to_us(now_);
    message.pos[0] = x_m;
    message.pos[1] = -1.0;
    message.orientation[0] = std::cos(heading_rad / 2);
    message.orientation[3] = std::sin(heading_rad / 2);
    return message;
  }
  std::vector<OdometryReading> taken() {
    std::vector<OdometryReading> all;
    OdometryReading one;
    while (odometry_.take(one)) all.push_back(one);
    return all;
  }

  Stamp now_ = stamp_from_us(1'700'000'000'000'000);
  LcmSourceSettings settings_;
  LcmOdometry odometry_{settings_};
  std::vector<std::byte> encoded_;
};

}  // namespace azimuth
