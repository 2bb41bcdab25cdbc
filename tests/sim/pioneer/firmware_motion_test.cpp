// The controller's motion, and the motion that it reports.

#include <cmath>
#include <gtest/gtest.h>

#include "slam/geometry/angle.hpp"
#include "tests/sim/pioneer/plain_client.hpp"

namespace azimuth::sim {
namespace {

using pioneer::Command;
using pioneer::encode_command;

TEST(Firmware, OpenResetsTheOrigin) {
  FirmwareBench bench({}, 0.3, 0.4);
  bench.client.listen(20s);  // drives without a session
  bench.client.open_quietly();
  const Received first = bench.client.sips(300ms).at(0);
  EXPECT_LE(sip_x(first), 50);
  EXPECT_LE(sip_y(first), 2);
  EXPECT_NEAR(sip_heading(first), 0.28 * 0.1 * 4096 / (2 * kPi), 3);
}

TEST(Firmware, OdometryIsThatOfTheWheels) {
  const double left = 0.30, right = 0.35;
  FirmwareBench bench({}, left, right);
  bench.client.open_quietly();
  bench.client.sips(30s);
  const std::vector<SipLatch> latches = bench.pioneer.take_latches();
  const Stamp origin = latches.front().stamp - 100ms;  // of the OPEN command
  const double rate = (right - left) / bench.chassis.track_m;
  for (const SipLatch& latch : latches) {
    const double t_s = to_seconds(latch.stamp - origin);
    const double radius_m = (left + right) / 2 / rate;
    EXPECT_NEAR(static_cast<std::int16_t>(latch.pose.x), 1000 * radius_m * std::sin(rate * t_s), 1.6);
    EXPECT_NEAR(static_cast<std::int16_t>(latch.pose.y), 1000 * radius_m * (1 - std::cos(rate * t_s)), 1.6);
    EXPECT_NEAR(wrap(latch.pose.heading * 2 * kPi / 4096 - rate * t_s), 0.0, 0.003);
  }
}

TEST(Firmware, VelocitiesAndIdTellTheMotion) {
  FirmwareBench bench({}, 0.3, 0.4);
  bench.client.open_quietly();
  const Received moving = bench.client.sips(1s).back();
  EXPECT_EQ(moving.id(), 0x33);
  EXPECT_NEAR(i16(moving.data, 7), 300, 1);
  EXPECT_NEAR(i16(moving.data, 9), 400, 1);
  EXPECT_NEAR(i16(moving.data, 20 + 8), 160, 2);  // 0.28 rad/s in 0.1 deg/s
  bench.chassis.left_m_per_s = bench.chassis.right_m_per_s = 0.0;
  EXPECT_EQ(bench.client.sips(1s).back().id(), 0x32);
}

TEST(Firmware, OlderControllersCountInTheirOwnUnits) {
  FirmwareBench bench(*pioneer_model("p3dx"), 0.5, 0.5);
  bench.client.open_quietly();
  bench.client.sips(10s);
  const auto latches = bench.pioneer.take_latches();
  const double driven_mm = 500.0 * to_seconds(latches.back().stamp - latches.front().stamp + 100ms);
  EXPECT_NEAR(latches.back().pose.x * 0.485, driven_mm, 0.6);
}

TEST(Firmware, EncodersComeOnceOrStream) {
  FirmwareBench bench({}, 0.2, 0.2);
  bench.client.open_quietly();
  const auto encoders = [&](int request) {
    auto packets = bench.client.ask(encode_command(Command::encoder, request), 1s);
    std::erase_if(packets, [](const Received& packet) { return packet.id() != 0x90; });
    return packets;
  };
  EXPECT_EQ(encoders(1).size(), 1U);
  const auto streaming = encoders(2);
  EXPECT_GE(streaming.size(), 9U);
  const int step = u16(streaming[5].data, 1) - u16(streaming[4].data, 1);
  EXPECT_NEAR(step & 0xFFFF, 20 * 128, 1);  // 20 mm per cycle
  encoders(0);                              // one packet is still on its way
  EXPECT_EQ(encoders(0).size(), 0U);
}

TEST(Firmware, GyroFeelsTheBodyAndComesBeforeTheSip) {
  PioneerModel model;
  model.has_gyro = true;
  FirmwareBench bench(model, -0.1, 0.1);
  bench.client.open_quietly();
  bench.client.ask(encode_command(Command::gyro, 1), 150ms);
  const auto packets = bench.client.listen(10s);
  double sum = 0.0;
  int samples = 0;
  for (std::size_t i = 0; i < packets.size(); ++i) {
    if (packets[i].id() != 0x98) continue;
    ASSERT_EQ(packets[i].data[1], 4);
    if (i + 1 < packets.size()) {
      EXPECT_TRUE(is_sip(packets[i + 1]));
    }
    for (std::size_t sample = 0; sample < 4; ++sample, ++samples) sum += u16(packets[i].data, 2 + 3 * sample);
  }
  ASSERT_GE(samples, 390);
  const double deg_per_s = -(sum / samples - 511.3) * (5.0 / 1023) * (300 / 2.5) * 1.626;
  EXPECT_NEAR(deg_per_s, rad_to_degrees(0.2 / bench.chassis.track_m), 0.2);
}

TEST(Firmware, WithoutAGyroThereAreNoGyroPackets) {
  FirmwareBench bench;
  bench.client.open_quietly();
  for (const Received& packet : bench.client.ask(encode_command(Command::gyro, 1), 1s)) EXPECT_TRUE(is_sip(packet));
}

TEST(Firmware, SetOriginStartsOver) {
  FirmwareBench bench({}, 0.5, 0.5);
  bench.client.open_quietly();
  EXPECT_GT(sip_x(bench.client.sips(5s).back()), 2000);
  bench.client.send(encode_command(Command::set_origin));
  EXPECT_LT(sip_x(bench.client.sips(200ms).back()), 120);
}

TEST(Firmware, ClientsDriveOnlyWithTheMotorsOn) {
  FirmwareBench bench({}, 0.1, 0.1);
  bench.client.open_quietly();
  bench.client.ask(encode_command(Command::velocity, 400), 500ms);
  EXPECT_FALSE(bench.pioneer.firmware().driven());
  bench.client.ask(encode_command(Command::enable, 1), 100ms);
  bench.client.ask(encode_command(Command::velocity, 400), 1900ms);
  EXPECT_NEAR(bench.pioneer.firmware().driven()->speed_m_per_s, 0.4, 1e-9);
  EXPECT_EQ(u16(bench.client.sips(200ms).back().data, 16) & 1, 1);
  bench.client.ask(encode_command(Command::stop), 1900ms);
  EXPECT_EQ(bench.pioneer.firmware().driven(), Twist{});
  bench.client.ask(encode_command(Command::close), 100ms);
  EXPECT_FALSE(bench.pioneer.firmware().driven()) << "the robot is left to whoever drives it otherwise";
}

TEST(Firmware, EveryMotionCommandIsUnderstood) {
  FirmwareBench bench;
  bench.client.open_quietly();
  bench.client.ask(encode_command(Command::enable, 1), 100ms);
  bench.client.ask(encode_command(Command::rotation, -30), 1s);
  EXPECT_NEAR(bench.pioneer.firmware().driven()->turn_rate_rad_per_s, degrees_to_rad(-30), 1e-9);
  const int left = 10, right = 15;  // in units of 20 mm/s
  bench.client.ask(encode_command(Command::wheel_velocities, (left << 8) | right), 1900ms);
  EXPECT_NEAR(bench.pioneer.firmware().driven()->speed_m_per_s, 0.25, 1e-9);
  EXPECT_NEAR(bench.pioneer.firmware().driven()->turn_rate_rad_per_s, 0.1 / bench.chassis.track_m, 1e-9);
  bench.client.ask(encode_command(Command::emergency_stop), 100ms);
  EXPECT_EQ(bench.pioneer.firmware().driven(), Twist{});
  EXPECT_NE(u16(bench.client.sips(200ms).back().data, 16) & 0x20, 0);
}

TEST(Firmware, WatchdogStopsAClientsDriveAndKeepsTheSession) {
  FirmwareBench bench;
  bench.client.open_quietly();
  bench.client.ask(encode_command(Command::enable, 1), 100ms);
  bench.client.ask(encode_command(Command::velocity, 300), 1900ms);
  EXPECT_EQ(bench.pioneer.firmware().driven()->speed_m_per_s, 0.3);
  bench.client.listen(3s);
  EXPECT_EQ(bench.pioneer.firmware().driven()->speed_m_per_s, 0.0);
  EXPECT_GE(bench.client.sips(1s).size(), 9U);
  bench.client.ask(encode_command(Command::pulse), 1900ms);
  EXPECT_EQ(bench.pioneer.firmware().driven()->speed_m_per_s, 0.3) << "goes on with the next command";
}

}  // namespace
}  // namespace azimuth::sim
