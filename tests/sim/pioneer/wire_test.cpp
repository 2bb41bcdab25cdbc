#include <algorithm>
#include <bit>
#include <gtest/gtest.h>
#include <numeric>

#include "sim/pioneer/simulated_pioneer.hpp"

namespace azimuth::sim {
namespace {

Bytes counting(std::size_t count) {
  Bytes bytes(count);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

TEST(Wire, ASipTakesTheTimeTheDescriptionSays) {
  for (const auto& [baud, time_ms] : {std::pair{9600, 42.7}, {38400, 10.7}, {115200, 3.56}}) {
    Wire wire(1);
    wire.send(counting(41), baud, Stamp{});
    Bytes received;
    Stamp last{};
    while (wire.due() != Stamp::max()) wire.receive(last = wire.due(), baud, received);
    EXPECT_EQ(received, counting(41));
    EXPECT_NEAR(1e3 * to_seconds(last), time_ms, 0.05) << baud;
  }
}

TEST(Wire, BytesQueueBehindThoseBeforeThem) {
  Wire wire(1);
  wire.send(counting(10), 10000, Stamp{});
  wire.send(counting(1), 10000, stamp_from_us(5000));
  Bytes received;
  wire.receive(stamp_from_us(10000), 10000, received);
  EXPECT_EQ(received.size(), 10U);
  EXPECT_EQ(wire.due(), stamp_from_us(11000));
}

TEST(Wire, TimeOfManyBytesDoesNotDrift) {
  Wire wire(1);
  for (int i = 0; i < 1152; ++i) wire.send(counting(10), 115200, Stamp{});
  Bytes received;
  wire.receive(stamp_from_us(999'990), 115200, received);
  EXPECT_GE(received.size(), 11518U);
  EXPECT_LT(received.size(), 11520U);
}

TEST(Wire, AnotherBaudRateIsGarbageInProportion) {
  for (const auto& [sender, receiver] : {std::pair{9600, 115200}, {115200, 9600}, {38400, 19200}}) {
    Wire wire(1);
    const Bytes sent(1200, 0xFA);
    wire.send(sent, sender, Stamp{});
    Bytes received;
    wire.receive(stamp_from_us(10'000'000), receiver, received);
    EXPECT_NEAR(static_cast<double>(received.size()), 1200.0 * receiver / sender, 1.0);
    EXPECT_LT(std::ranges::count(received, 0xFA), static_cast<std::ptrdiff_t>(received.size() / 20));
  }
}

TEST(Wire, AReceiverWithoutARateFollowsTheSender) {
  Wire wire(1);
  wire.send(counting(5), 9600, Stamp{});
  wire.send(counting(5), 115200, Stamp{});
  Bytes received;
  wire.receive(stamp_from_us(1'000'000), std::nullopt, received);
  EXPECT_EQ(received.size(), 10U);
  EXPECT_EQ(received[7], 2);
}

TEST(Wire, NoiseFlipsOneBitAtItsRate) {
  Wire wire(2);
  wire.noise.flip = 0.01;
  wire.send(Bytes(100'000, 0), 115200, Stamp{});
  Bytes received;
  wire.receive(stamp_from_us(100'000'000), 115200, received);
  ASSERT_EQ(received.size(), 100'000U);
  int flipped = 0;
  for (const std::uint8_t byte : received) {
    EXPECT_LE(std::popcount(byte), 1);
    flipped += byte != 0;
  }
  EXPECT_NEAR(flipped, 1000, 150);
}

TEST(Wire, LosesBytesAtItsRate) {
  Wire wire(3);
  wire.noise.lose = 0.02;
  wire.send(Bytes(100'000, 7), 115200, Stamp{});
  Bytes received;
  wire.receive(stamp_from_us(100'000'000), 115200, received);
  EXPECT_NEAR(static_cast<double>(received.size()), 98'000.0, 200.0);
}

}  // namespace
}  // namespace azimuth::sim
