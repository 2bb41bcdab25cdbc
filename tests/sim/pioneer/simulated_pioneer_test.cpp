// Controller and line together: every fault has its named effect, and everything is reproducible.

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "sim/pioneer/fault_schedule.hpp"
#include "tests/sim/pioneer/plain_client.hpp"

namespace azimuth::sim {
namespace {

using pioneer::Command;
using pioneer::encode_command;

class SimulatedPioneerTest : public testing::Test {
 public:
  void fault(std::string_view text) {
    const auto parsed = parse_fault(text);
    ASSERT_TRUE(parsed) << text;
    parsed->apply(pioneer);
  }
  void drive(double left_m_per_s, double right_m_per_s) {
    chassis.left_m_per_s = left_m_per_s;
    chassis.right_m_per_s = right_m_per_s;
  }

  SteadyChassis chassis{0.0, 0.0};
  SimulatedPioneer pioneer{PioneerModel{}, chassis, 7};
  PlainClient client{pioneer};
};

TEST_F(SimulatedPioneerTest, BadConfigChecksumSpoilsOnlyThatPacket) {
  fault("bad_config_checksum");
  client.open_quietly();
  const std::size_t before = client.bytes.size();
  auto packets = client.ask(encode_command(Command::config), 500ms);
  EXPECT_TRUE(std::ranges::all_of(packets, is_sip));
  EXPECT_GE(client.bad_checksums(), 1U);
  const std::vector<std::uint8_t> type{0x20, 'P', 'i', 'o', 'n', 'e', 'e', 'r', 0};
  const auto found = std::search(client.bytes.begin() + static_cast<std::ptrdiff_t>(before), client.bytes.end(),
                                 type.begin(), type.end());
  EXPECT_NE(found, client.bytes.end()) << "its text came through unharmed";
  fault("bad_config_checksum=off");
  packets = client.ask(encode_command(Command::config), 500ms);
  EXPECT_TRUE(std::ranges::any_of(packets, [](const Received& packet) { return packet.id() == 0x20; }));
}

TEST_F(SimulatedPioneerTest, NoiseSpoilsChecksumsAtItsRate) {
  client.open_quietly();
  fault("noise=0.002");
  const auto sips = client.sips(200s);
  const double expected = 2000 * std::pow(1 - 0.002, 41);  // a SIP arrives if all its bytes are undamaged
  EXPECT_NEAR(static_cast<double>(sips.size()), expected, 60);
  fault("noise=0");
  EXPECT_GE(client.sips(10s).size(), 99U);
}

TEST_F(SimulatedPioneerTest, LostBytesCostTheirPackets) {
  client.open_quietly();
  fault("lose_bytes=0.005");
  EXPECT_NEAR(static_cast<double>(client.sips(200s).size()), 2000 * std::pow(1 - 0.005, 41), 90);
}

TEST_F(SimulatedPioneerTest, LostSipsAreMissingAsAWhole) {
  client.open_quietly();
  fault("lose_sips=0.2");
  EXPECT_NEAR(static_cast<double>(client.sips(200s).size()), 1600, 80);
  EXPECT_EQ(client.bad_checksums(), 0U);
  EXPECT_EQ(pioneer.counts().sips + pioneer.counts().lost_sips, 2000U + 0U);
}

/// The largest decrease of a counter that otherwise grows.
int wrap_of(const std::vector<Received>& sips, int (*field)(const Received&)) {
  int largest = 0;
  for (std::size_t i = 1; i < sips.size(); ++i) largest = std::max(largest, field(sips[i - 1]) - field(sips[i]));
  return largest;
}

TEST_F(SimulatedPioneerTest, PositionsWrapAt15And16Bits) {
  drive(0.4, 0.4);
  fault("wrap15");
  client.open_quietly();
  const auto narrow = client.sips(3s);
  EXPECT_EQ(sip_y(narrow.front()), 32700);
  EXPECT_NEAR(wrap_of(narrow, sip_x), 32768 - 40, 1);
  client.ask(encode_command(Command::close), 200ms);
  fault("wrap16");
  client.open_quietly();
  EXPECT_NEAR(wrap_of(client.sips(5s), sip_x), 65536 - 40, 1);
}

TEST_F(SimulatedPioneerTest, HeadingWrapsFromItsStart) {
  drive(-0.1, 0.1);
  fault("heading=170");
  client.open_quietly();
  const auto sips = client.sips(2s);
  EXPECT_NEAR(sip_heading(sips.front()), 170.0 * 4096 / 360, 60);
  EXPECT_NEAR(wrap_of(sips, sip_heading), 4096 - 37, 2);
  for (const Received& sip : sips) {
    EXPECT_GE(sip_heading(sip), -2048);
    EXPECT_LE(sip_heading(sip), 2047);
  }
}

TEST_F(SimulatedPioneerTest, RebootEndsSessionAndOdometry) {
  drive(0.2, 0.2);
  for (const auto& [text, id] : {std::pair{"reboot=0xFF", 0xFF}, {"reboot=0xFE", 0xFE}}) {
    client.open_quietly();
    client.sips(2s);
    fault(text);
    const auto packets = client.listen(2s);
    ASSERT_FALSE(packets.empty());
    EXPECT_EQ(packets.back().id(), id);
    EXPECT_FALSE(pioneer.firmware().in_session());
    EXPECT_TRUE(client.listen(1s).empty());
  }
  client.open_quietly();
  EXPECT_LT(sip_x(client.sips(300ms).front()), 60);
}

TEST_F(SimulatedPioneerTest, ARebootingControllerIsDeafForAMoment) {
  fault("reboot");
  EXPECT_EQ(client.ask(encode_command(0), 100ms).size(), 1U) << "only the reboot tells";
  client.listen(600ms);
  client.open();
}

TEST_F(SimulatedPioneerTest, WatchdogFaultStopsForeignWheelsToo) {
  drive(0.3, 0.3);
  fault("watchdog=700");
  client.open_quietly();
  EXPECT_EQ(client.sips(500ms).back().id(), 0x33);
  const auto held = client.sips(2s);
  EXPECT_EQ(held.back().id(), 0x32);
  EXPECT_GE(held.size(), 19U) << "the session stays";
  client.send(encode_command(Command::pulse));
  EXPECT_EQ(client.sips(400ms).back().id(), 0x33);
}

TEST_F(SimulatedPioneerTest, HostBaudCanBeRefused) {
  fault("hostbaud");
  client.open_quietly();
  client.ask(encode_command(Command::host_baud, 4), 100ms);
  EXPECT_EQ(pioneer.firmware().baud(), 9600);
}

TEST_F(SimulatedPioneerTest, SonarTrafficFillsALineOf9600) {
  fault("sonar");
  client.open_quietly();
  Bytes().swap(client.bytes);
  const auto sips = client.sips(10s);
  for (const Received& sip : sips) EXPECT_EQ(sip.data.size() + pioneer::kFrameOverhead, 89U);
  EXPECT_GT(client.bytes.size(), 8800U) << "of 9600 there is room for";
  client.ask(encode_command(Command::encoder, 2), 30s);  // more than the line can carry
  EXPECT_GT(pioneer.counts().crowded_out, 0U);
  EXPECT_EQ(client.bad_checksums(), 0U) << "what does not fit is left out whole";
}

TEST_F(SimulatedPioneerTest, AnOldSessionMayHaveRaisedTheBaud) {
  fault("old_session=115200");
  pioneer.set_client_baud(9600);
  EXPECT_TRUE(client.ask(encode_command(0), 500ms).empty());
  EXPECT_GT(client.bytes.size(), 0U);
  pioneer.set_client_baud(115200);
  EXPECT_GE(client.sips(500ms).size(), 4U);
  client.ask(encode_command(Command::close), 100ms);
  pioneer.set_client_baud(9600);
  client.open();
}

TEST_F(SimulatedPioneerTest, SilencePassesAndTheSessionWithIt) {
  client.open_quietly();
  fault("silence=3");
  client.send(encode_command(Command::close));  // gets lost
  EXPECT_LE(client.sips(3s).size(), 1U);
  EXPECT_GE(client.sips(1s).size(), 9U);
}

TEST_F(SimulatedPioneerTest, UnplugTakesTheDeviceAwayForItsTime) {
  drive(0.1, 0.1);
  client.open_quietly();
  const int before = sip_x(client.sips(1s).back());
  fault("unplug=2");
  EXPECT_FALSE(pioneer.plugged_in());
  client.listen(1990ms);
  EXPECT_FALSE(pioneer.plugged_in());
  client.listen(20ms);
  EXPECT_TRUE(pioneer.plugged_in());
  EXPECT_NEAR(sip_x(client.sips(200ms).back()), before + 220, 25) << "the robot went on without its line";
}

TEST_F(SimulatedPioneerTest, SipIdsMayTellNothing) {
  client.open_quietly();
  fault("sip_id=0x33");
  EXPECT_EQ(client.sips(500ms).back().id(), 0x33);
  drive(0.2, 0.2);
  fault("sip_id=0x32");
  EXPECT_EQ(client.sips(500ms).back().id(), 0x32);
  fault("sip_id=moving");
  EXPECT_EQ(client.sips(500ms).back().id(), 0x33);
}

TEST_F(SimulatedPioneerTest, GyroAndEncoderPacketsComeUnaskedOrNotAtAll) {
  fault("gyro=always");
  fault("encoder=always");
  client.open_quietly();
  auto packets = client.listen(2s);
  EXPECT_GE(std::ranges::count(packets, 0x98, &Received::id), 18);
  EXPECT_GE(std::ranges::count(packets, 0x90, &Received::id), 18);
  fault("gyro=off");
  fault("encoder=off");
  client.ask(encode_command(Command::encoder, 2), 200ms);
  packets = client.listen(2s);
  EXPECT_TRUE(std::ranges::all_of(packets, is_sip));
}

TEST_F(SimulatedPioneerTest, JumpsCoverMoreThan100mmPerSip) {
  client.open_quietly();
  fault("jump=1.5");
  client.sips(300ms);
  const auto sips = client.sips(2s);
  for (std::size_t i = 1; i < sips.size(); ++i) EXPECT_NEAR(sip_x(sips[i]) - sip_x(sips[i - 1]), 150, 1);
}

TEST_F(SimulatedPioneerTest, StallAndBumpersShow) {
  client.open_quietly();
  fault("stall=left");
  fault("bumpers=front");
  const Received sip = client.sips(300ms).back();
  EXPECT_EQ(sip.data[12], 0x01);
  EXPECT_EQ(sip.data[13], 0x08);
}

TEST_F(SimulatedPioneerTest, LatchesAreTheSipsOnTheLine) {
  drive(0.3, 0.25);
  client.open_quietly();
  const auto sips = client.sips(20s);
  const auto latches = pioneer.take_latches();
  ASSERT_GE(latches.size(), sips.size());
  const std::size_t more = latches.size() - sips.size();
  ASSERT_LE(more, 1U);  // the last packet is still on its way
  for (std::size_t i = 0; i < sips.size(); ++i) {
    EXPECT_EQ(latches[i].pose.x, sip_x(sips[i]));
    EXPECT_EQ(latches[i].pose.heading, sip_heading(sips[i]));
    const Duration way = sips[i].at - latches[i].stamp;
    EXPECT_GE(way, 42ms);  // 41 bytes at 9600 baud, or more with the sonar of the first SIP
    EXPECT_LT(way, 60ms);
  }
}

/// All bytes to the client in half an hour with changing faults.
Bytes bytes_of_a_bad_half_hour(std::uint64_t seed) {
  SteadyChassis chassis(0.4, 0.42);
  SimulatedPioneer pioneer(PioneerModel{}, chassis, seed);
  PlainClient client(pioneer);
  client.open();
  client.send(encode_command(Command::encoder, 2));
  for (int minute = 0; minute < 30; ++minute) {
    pioneer.set_noise(minute % 2 == 0 ? 0.001 : 0.0);
    pioneer.set_lost_bytes(minute % 3 == 0 ? 0.001 : 0.0);
    pioneer.set_lost_sips(minute % 5 == 0 ? 0.2 : 0.0);
    if (minute == 10) pioneer.silence(2s);
    for (int second = 0; second < 60; ++second) client.ask(encode_command(Command::pulse), 1s);
  }
  EXPECT_GT(client.packets.size(), 15'000U);
  return client.bytes;
}

TEST(SimulatedPioneerSoak, TheSameSeedGivesTheSameBytes) {
  const Bytes bytes = bytes_of_a_bad_half_hour(1);
  EXPECT_EQ(bytes, bytes_of_a_bad_half_hour(1));
  EXPECT_NE(bytes, bytes_of_a_bad_half_hour(2));
}

TEST(SimulatedPioneerSoak, StepsOfAnySizeGiveTheSameBytes) {
  const auto run = [](Duration step) {
    SteadyChassis chassis(0.4, 0.42);
    SimulatedPioneer pioneer(PioneerModel{}, chassis, 3);
    pioneer.set_noise(0.01);
    pioneer.leave_session_open(std::nullopt);
    for (Stamp now{}; now <= stamp_from_us(20'000'000); now += step) pioneer.advance(now);
    Bytes bytes;
    pioneer.take_bytes(bytes);
    return bytes;
  };
  EXPECT_EQ(run(1ms), run(1s));
}

}  // namespace
}  // namespace azimuth::sim
