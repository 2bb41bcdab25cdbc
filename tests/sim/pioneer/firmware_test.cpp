// Sessions and packets of the controller, as existing clients rely on them.

#include <algorithm>
#include <gtest/gtest.h>

#include "slam/geometry/angle.hpp"
#include "tests/sim/pioneer/plain_client.hpp"

namespace azimuth::sim {
namespace {

using pioneer::Command;
using pioneer::encode_command;

TEST(Firmware, SaysNothingUnasked) {
  FirmwareBench bench;
  EXPECT_TRUE(bench.client.listen(5s).empty());
  EXPECT_TRUE(bench.client.bytes.empty());
}

TEST(Firmware, SynchronisesAndOpens) {
  FirmwareBench bench;
  bench.client.open();
  EXPECT_EQ(bench.client.packets.at(2).data.size(), 1 + 12 + 8 + 8U);
}

TEST(Firmware, SipsComeEveryCycleAndHaveTheirLengths) {
  FirmwareBench bench;
  bench.client.open_quietly();
  const auto sips = bench.client.sips(10s);
  ASSERT_GE(sips.size(), 99U);
  for (std::size_t i = 1; i < sips.size(); ++i) EXPECT_EQ(sips[i].at - sips[i - 1].at, 100ms);
  for (const Received& sip : sips) EXPECT_EQ(sip.data.size() + pioneer::kFrameOverhead, 41U);
}

TEST(Firmware, SyncOutOfOrderIsAnsweredWithFFAndStartsOver) {
  for (const auto& wrong : {std::vector<std::uint8_t>{1}, {0, 2}, {0, 1, 1}}) {
    FirmwareBench bench;
    std::vector<Received> answer;
    for (const std::uint8_t sync : wrong) answer = bench.client.ask(encode_command(sync));
    ASSERT_EQ(answer.size(), 1U);
    EXPECT_EQ(answer.front().id(), 0xFF);
    bench.client.open();
  }
}

/// Careful clients first send CLOSE at every baud rate, and would take an answer to it for the answer to SYNC0.
TEST(Firmware, ACloseThatFindsNoSessionIsNotAnswered) {
  for (const auto& before : {std::vector<std::uint8_t>{}, {0, 1, 2}}) {
    FirmwareBench bench;
    for (const std::uint8_t sync : before) bench.client.ask(encode_command(sync));
    EXPECT_TRUE(bench.client.ask(encode_command(Command::close), 200ms).empty());
    EXPECT_TRUE(bench.client.ask(encode_command(Command::close, 1), 200ms).empty()) << "with an argument, as ARIA";
    bench.client.open();
  }
}

TEST(Firmware, SyncMayBeginAnewAtAnyPlace) {
  FirmwareBench bench;
  for (const int count : {1, 2, 3}) {
    for (int sync = 0; sync < count; ++sync) bench.client.ask(encode_command(static_cast<std::uint8_t>(sync)));
    EXPECT_EQ(bench.client.ask(encode_command(0)).at(0).id(), 0);
  }
  for (int i = 0; i < 5; ++i) EXPECT_EQ(bench.client.ask(encode_command(0)).size(), 1U);
  bench.client.open();
}

TEST(Firmware, CloseEndsTheStreamAndANewSessionFollows) {
  FirmwareBench bench;
  bench.client.open_quietly();
  bench.client.ask(encode_command(Command::close), 200ms);
  EXPECT_TRUE(bench.client.listen(1s).empty());
  bench.client.open();
  EXPECT_FALSE(bench.client.sips(1s).empty());
}

TEST(Firmware, AnOldSessionAnswersSync0WithSipsUntilItIsClosed) {
  FirmwareBench bench;
  bench.pioneer.leave_session_open(std::nullopt);
  for (const Received& packet : bench.client.ask(encode_command(0), 500ms)) EXPECT_TRUE(is_sip(packet));
  ASSERT_GE(bench.client.packets.size(), 4U);
  bench.client.ask(encode_command(Command::close), 200ms);
  EXPECT_TRUE(bench.client.listen(500ms).empty());
  bench.client.open();
}

TEST(Firmware, ConfigurationComesOnceWhenAsked) {
  FirmwareBench bench;
  bench.client.open_quietly();
  auto packets = bench.client.ask(encode_command(Command::config), 350ms);
  std::erase_if(packets, is_sip);
  ASSERT_EQ(packets.size(), 1U);
  EXPECT_EQ(packets.front().id(), 0x20);
}

TEST(Firmware, IoPacketsComeOnceOrStreamAndTellTheirInputs) {
  FirmwareBench bench;
  bench.client.open_quietly();
  bench.pioneer.firmware().quirks.right_stall_bumpers = 0b0000'1001;
  bench.pioneer.firmware().quirks.left_stall_bumpers = 0b0010'0000;
  const auto asked = [&](int request) {
    auto packets = bench.client.ask(encode_command(Command::io_request, request), 1s);
    std::erase_if(packets, [](const Received& packet) { return packet.id() != 0xF0; });
    return packets;
  };
  // DIGOUT: all bits, then only the low half.
  bench.client.ask(pioneer::encode_frame(Bytes{30, 0x3B, 0x5A, 0xFF}), 20ms);
  bench.client.ask(encode_command(Command::digital_out, 0x0F01), 20ms);
  const auto once = asked(1);
  ASSERT_EQ(once.size(), 1U);
  Bytes expected{0xF0, 4, 0, 0b100, 0b10000, 0xFF, 1, 0x51, 8};
  expected.resize(expected.size() + 16);
  EXPECT_EQ(once.front().data, expected);
  EXPECT_GE(asked(2).size(), 9U);
  asked(0);  // one packet is still on its way
  EXPECT_EQ(asked(0).size(), 0U);
  EXPECT_EQ(bench.client.sips(200ms).back().data.at(20 + 4), 0x51) << "the standard SIP has the outputs, too";
}

/// The controller ignores unknown commands with any argument, except that they reset the watchdog.
TEST(Firmware, UnknownCommandsAreIgnored) {
  FirmwareBench bench;
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

TEST(Firmware, HostBaudHoldsForTheSession) {
  FirmwareBench bench;
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
  FirmwareBench bench;
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
  FirmwareBench bench;
  bench.client.open_quietly();
  bench.client.ask(encode_command(Command::host_baud, 9), 100ms);
  EXPECT_EQ(bench.pioneer.firmware().baud(), 9600);
}

// The connection sequence of the manufacturer's library: CLOSE at every rate, SYNC0 that the controller cannot answer
// at a wrong rate, "dislodging" OPENs, then the requests after the start.
TEST(Firmware, BearsTheOpeningOfTheMakersLibrary) {
  PioneerModel model;
  model.start_baud = 19200;
  FirmwareBench bench(model);
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
