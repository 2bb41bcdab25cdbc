// The controller behind its line: sessions, packets and motion, as clients written by others rely on them.

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "slam/geometry/angle.hpp"
#include "tests/sim/pioneer/plain_client.hpp"

namespace azimuth::sim {
namespace {

using pioneer::Command;
using pioneer::encode_command;

struct Bench {
  explicit Bench(const PioneerModel& model = {}, double left = 0.0, double right = 0.0)
      : chassis(left, right), pioneer(model, chassis, 1), client(pioneer) {}
  SteadyChassis chassis;
  SimulatedPioneer pioneer;
  PlainClient client;
};

TEST(Firmware, SaysNothingUnasked) {
  Bench bench;
  EXPECT_TRUE(bench.client.listen(5s).empty());
  EXPECT_TRUE(bench.client.bytes.empty());
}

TEST(Firmware, SynchronisesAndOpens) {
  Bench bench;
  bench.client.open();
  EXPECT_EQ(bench.client.packets.at(2).data.size(), 1 + 12 + 8 + 8U);
}

TEST(Firmware, SipsComeEveryCycleAndHaveTheirLengths) {
  Bench bench;
  bench.client.open_quietly();
  const auto sips = bench.client.sips(10s);
  ASSERT_GE(sips.size(), 99U);
  for (std::size_t i = 1; i < sips.size(); ++i) EXPECT_EQ(sips[i].at - sips[i - 1].at, 100ms);
  for (const Received& sip : sips) EXPECT_EQ(sip.data.size() + pioneer::kFrameOverhead, 41U);
}

TEST(Firmware, SyncOutOfOrderIsAnsweredWithFFAndStartsOver) {
  for (const auto& wrong : {std::vector<std::uint8_t>{1}, {0, 2}, {0, 1, 1}}) {
    Bench bench;
    std::vector<Received> answer;
    for (const std::uint8_t sync : wrong) answer = bench.client.ask(encode_command(sync));
    ASSERT_EQ(answer.size(), 1U);
    EXPECT_EQ(answer.front().id(), 0xFF);
    bench.client.open();
  }
}

/// Careful clients say CLOSE first, at every baud rate, and would take an answer for that to SYNC0.
TEST(Firmware, ACloseThatFindsNoSessionIsNotAnswered) {
  for (const auto& before : {std::vector<std::uint8_t>{}, {0, 1, 2}}) {
    Bench bench;
    for (const std::uint8_t sync : before) bench.client.ask(encode_command(sync));
    EXPECT_TRUE(bench.client.ask(encode_command(Command::close), 200ms).empty());
    EXPECT_TRUE(bench.client.ask(encode_command(Command::close, 1), 200ms).empty()) << "with an argument, as ARIA";
    bench.client.open();
  }
}

TEST(Firmware, SyncMayBeginAnewAtAnyPlace) {
  Bench bench;
  for (const int count : {1, 2, 3}) {
    for (int sync = 0; sync < count; ++sync) bench.client.ask(encode_command(static_cast<std::uint8_t>(sync)));
    EXPECT_EQ(bench.client.ask(encode_command(0)).at(0).id(), 0);
  }
  for (int i = 0; i < 5; ++i) EXPECT_EQ(bench.client.ask(encode_command(0)).size(), 1U);
  bench.client.open();
}

TEST(Firmware, CloseEndsTheStreamAndANewSessionFollows) {
  Bench bench;
  bench.client.open_quietly();
  bench.client.ask(encode_command(Command::close), 200ms);
  EXPECT_TRUE(bench.client.listen(1s).empty());
  bench.client.open();
  EXPECT_FALSE(bench.client.sips(1s).empty());
}

TEST(Firmware, AnOldSessionAnswersSync0WithSipsUntilItIsClosed) {
  Bench bench;
  bench.pioneer.leave_session_open(std::nullopt);
  for (const Received& packet : bench.client.ask(encode_command(0), 500ms)) EXPECT_TRUE(is_sip(packet));
  ASSERT_GE(bench.client.packets.size(), 4U);
  bench.client.ask(encode_command(Command::close), 200ms);
  EXPECT_TRUE(bench.client.listen(500ms).empty());
  bench.client.open();
}

TEST(Firmware, OpenResetsTheOrigin) {
  Bench bench({}, 0.3, 0.4);
  bench.client.listen(20s);  // drives without a session
  bench.client.open_quietly();
  const Received first = bench.client.sips(300ms).at(0);
  EXPECT_LE(sip_x(first), 50);
  EXPECT_LE(sip_y(first), 2);
  EXPECT_NEAR(sip_heading(first), 0.28 * 0.1 * 4096 / (2 * kPi), 3);
}

TEST(Firmware, OdometryIsThatOfTheWheels) {
  const double left = 0.30, right = 0.35;
  Bench bench({}, left, right);
  bench.client.open_quietly();
  bench.client.sips(30s);
  const std::vector<SipLatch> latches = bench.pioneer.take_latches();
  const Stamp origin = latches.front().stamp - 100ms;  // of OPEN
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
  Bench bench({}, 0.3, 0.4);
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
  Bench bench(*pioneer_model("p3dx"), 0.5, 0.5);
  bench.client.open_quietly();
  bench.client.sips(10s);
  const auto latches = bench.pioneer.take_latches();
  const double driven_mm = 500.0 * to_seconds(latches.back().stamp - latches.front().stamp + 100ms);
  EXPECT_NEAR(latches.back().pose.x * 0.485, driven_mm, 0.6);
}

TEST(Firmware, ConfigurationComesOnceWhenAsked) {
  Bench bench;
  bench.client.open_quietly();
  auto packets = bench.client.ask(encode_command(Command::config), 350ms);
  std::erase_if(packets, is_sip);
  ASSERT_EQ(packets.size(), 1U);
  EXPECT_EQ(packets.front().id(), 0x20);
}

TEST(Firmware, EncodersComeOnceOrStream) {
  Bench bench({}, 0.2, 0.2);
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
  EXPECT_NEAR(step & 0xFFFF, 20 * 128, 1);  // 20 mm a cycle
  encoders(0);                              // one is on its way still
  EXPECT_EQ(encoders(0).size(), 0U);
}

TEST(Firmware, IoPacketsComeOnceOrStreamAndTellTheirInputs) {
  Bench bench;
  bench.client.open_quietly();
  bench.pioneer.firmware().quirks.right_stall_bumpers = 0b0000'1001;
  bench.pioneer.firmware().quirks.left_stall_bumpers = 0b0010'0000;
  const auto asked = [&](int request) {
    auto packets = bench.client.ask(encode_command(Command::io_request, request), 1s);
    std::erase_if(packets, [](const Received& packet) { return packet.id() != 0xF0; });
    return packets;
  };
  bench.client.ask(pioneer::encode_frame(Bytes{30, 0x3B, 0x5A, 0xFF}), 20ms);  // DIGOUT: all, then the low half only
  bench.client.ask(encode_command(Command::digital_out, 0x0F01), 20ms);
  const auto once = asked(1);
  ASSERT_EQ(once.size(), 1U);
  Bytes expected{0xF0, 4, 0, 0b100, 0b10000, 0xFF, 1, 0x51, 8};
  expected.resize(expected.size() + 16);
  EXPECT_EQ(once.front().data, expected);
  EXPECT_GE(asked(2).size(), 9U);
  asked(0);  // one is on its way still
  EXPECT_EQ(asked(0).size(), 0U);
  EXPECT_EQ(bench.client.sips(200ms).back().data.at(20 + 4), 0x51) << "the standard SIP has the outputs, too";
}

/// What the controller does not know it lets pass, whatever its argument; it only keeps the watchdog quiet.
TEST(Firmware, UnknownCommandsAreIgnored) {
  Bench bench;
  bench.client.open_quietly();
  for (int number = 0; number < 256; ++number) {
    const auto command = static_cast<std::uint8_t>(number);
    if (command == 2) continue;   // CLOSE
    if (command == 50) continue;  // HOSTBAUD
    bench.client.ask(pioneer::encode_command(command, std::string_view("\3\1\2\0xyz", 7)), 5ms);
    bench.client.ask(pioneer::encode_command(command), 5ms);
  }
  EXPECT_GE(bench.client.sips(1s).size(), 9U);
  EXPECT_EQ(bench.pioneer.firmware().driven(), std::nullopt) << "the motors were never on";
}

TEST(Firmware, GyroFeelsTheBodyAndComesBeforeTheSip) {
  PioneerModel model;
  model.has_gyro = true;
  Bench bench(model, -0.1, 0.1);
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
  Bench bench;
  bench.client.open_quietly();
  for (const Received& packet : bench.client.ask(encode_command(Command::gyro, 1), 1s)) EXPECT_TRUE(is_sip(packet));
}

TEST(Firmware, SetOriginStartsOver) {
  Bench bench({}, 0.5, 0.5);
  bench.client.open_quietly();
  EXPECT_GT(sip_x(bench.client.sips(5s).back()), 2000);
  bench.client.send(encode_command(Command::set_origin));
  EXPECT_LT(sip_x(bench.client.sips(200ms).back()), 120);
}

TEST(Firmware, ClientsDriveOnlyWithTheMotorsOn) {
  Bench bench({}, 0.1, 0.1);
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
  Bench bench;
  bench.client.open_quietly();
  bench.client.ask(encode_command(Command::enable, 1), 100ms);
  bench.client.ask(encode_command(Command::rotation, -30), 1s);
  EXPECT_NEAR(bench.pioneer.firmware().driven()->turn_rate_rad_per_s, degrees_to_rad(-30), 1e-9);
  const int left = 10, right = 15;  // times 20 mm/s
  bench.client.ask(encode_command(Command::wheel_velocities, (left << 8) | right), 1900ms);
  EXPECT_NEAR(bench.pioneer.firmware().driven()->speed_m_per_s, 0.25, 1e-9);
  EXPECT_NEAR(bench.pioneer.firmware().driven()->turn_rate_rad_per_s, 0.1 / bench.chassis.track_m, 1e-9);
  bench.client.ask(encode_command(Command::emergency_stop), 100ms);
  EXPECT_EQ(bench.pioneer.firmware().driven(), Twist{});
  EXPECT_NE(u16(bench.client.sips(200ms).back().data, 16) & 0x20, 0);
}

TEST(Firmware, WatchdogStopsAClientsDriveAndKeepsTheSession) {
  Bench bench;
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

TEST(Firmware, HostBaudHoldsForTheSession) {
  Bench bench;
  bench.pioneer.set_client_baud(9600);
  bench.client.open_quietly();
  bench.client.ask(encode_command(Command::host_baud, 4), 10ms);
  bench.pioneer.set_client_baud(115200);
  bench.client.listen(10ms);
  bench.client.send(encode_command(Command::pulse));
  EXPECT_GE(bench.client.sips(1s).size(), 9U);
  EXPECT_EQ(bench.pioneer.firmware().baud(), 115200);
  bench.client.ask(encode_command(Command::close), 200ms);
  EXPECT_EQ(bench.pioneer.firmware().baud(), 9600);
  bench.pioneer.set_client_baud(9600);
  bench.client.open();
}

TEST(Firmware, AtTheWrongBaudThereIsGarbageAndNoPacket) {
  Bench bench;
  bench.pioneer.set_client_baud(9600);
  bench.client.open_quietly();
  bench.pioneer.set_client_baud(38400);
  const std::size_t before = bench.client.bytes.size();
  EXPECT_TRUE(bench.client.listen(3s).empty());
  EXPECT_GT(bench.client.bytes.size(), before + 3000);
  const std::uint64_t commands = bench.pioneer.firmware().commands();
  for (int i = 0; i < 20; ++i) bench.client.ask(encode_command(Command::pulse), 20ms);
  EXPECT_EQ(bench.pioneer.firmware().commands(), commands);
}

TEST(Firmware, AnOutOfRangeBaudIsIgnored) {
  Bench bench;
  bench.client.open_quietly();
  bench.client.ask(encode_command(Command::host_baud, 9), 100ms);
  EXPECT_EQ(bench.pioneer.firmware().baud(), 9600);
}

// The sequence the makers' own library goes through: CLOSE at every rate, SYNC0 that go unanswered at the wrong one,
// "dislodging" OPENs, then its set of requests after the start.
TEST(Firmware, BearsTheOpeningOfTheMakersLibrary) {
  PioneerModel model;
  model.start_baud = 19200;
  Bench bench(model);
  bench.pioneer.leave_session_open(38400);
  for (const int baud : {9600, 38400, 115200, 19200, 57600}) {
    bench.pioneer.set_client_baud(baud);
    bench.client.ask(encode_command(Command::close), 3ms);
  }
  bench.pioneer.set_client_baud(9600);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(bench.client.ask(encode_command(0), 500ms).empty()) << "wrong baud rate";
  }
  bench.client.ask(encode_command(Command::open), 100ms);
  bench.pioneer.set_client_baud(19200);
  bench.client.listen(200ms);
  bench.client.open();
  bench.client.send(encode_command(Command::pulse));
  bench.client.send(encode_command(Command::config));
  bench.client.send(encode_command(Command::polling, "\1\2\3\4"));
  bench.client.send(encode_command(Command::enable, 0));
  bench.client.send(encode_command(Command::sonar, 0));
  bench.client.send(encode_command(Command::digital_out, 0x7F00));
  const auto packets = bench.client.listen(2s);
  EXPECT_EQ(std::ranges::count(packets, 0x20, &Received::id), 1);
  EXPECT_GE(std::ranges::count_if(packets, is_sip), 19);
  for (int i = 0; i < 3; ++i) bench.client.send(encode_command(Command::close));
  bench.client.listen(200ms);
  EXPECT_FALSE(bench.pioneer.firmware().in_session());
}

}  // namespace
}  // namespace azimuth::sim
