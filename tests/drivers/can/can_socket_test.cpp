// Tests the socket with datagrams of another family, for which the kernel does everything except filtering, and on a
// virtual bus where one can be created.

#include "drivers/can/can_socket.hpp"

#include <cerrno>
#include <cstdlib>
#include <gtest/gtest.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <thread>
#include <unistd.h>

#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

CanFrame frame_of(std::uint32_t number, std::uint8_t first = 0) {
  CanFrame frame;
  frame.id.number = number;
  frame.size = 8;
  frame.data[0] = first;
  return frame;
}

/// A socket and its other end.
class Pair {
 public:
  Pair() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0, ends.data()), 0);
    other = UniqueFd(ends[1]);
    socket.emplace("pair", UniqueFd(ends[0]), 0);
  }
  bool send(std::span<const std::uint8_t> bytes) const {
    return ::send(other.get(), bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
  }
  bool send(const CanFrame& frame) const {
    std::array<std::uint8_t, kMostCanSocketBytes> datagram{};
    return send(std::span(datagram).first(encode_can_frame(frame, datagram)));
  }

  UniqueFd other;
  std::optional<CanSocket> socket;
  std::array<CanReception, 100> received{};
};

TEST(CanSocket, ReadsFramesInOrderAndWhenTheyCame) {
  Pair pair;
  std::array<DeviceClock::time_point, 6> sent_at{};
  for (std::uint8_t i = 0; i < 5; ++i) {
    sent_at.at(i) = DeviceClock::now();
    ASSERT_TRUE(pair.send(frame_of(0x181, i)));
    std::this_thread::sleep_for(2ms);
  }
  sent_at[5] = DeviceClock::now();
  const CanLink::Received got = pair.socket->receive(pair.received);
  EXPECT_FALSE(got.error);
  ASSERT_EQ(got.count, 5U);
  for (std::uint8_t i = 0; i < 5; ++i) {
    EXPECT_EQ(pair.received.at(i).frame, frame_of(0x181, i));
    EXPECT_GE(pair.received.at(i).at, sent_at.at(i) - 1ms);
    EXPECT_LE(pair.received.at(i).at, DeviceClock::now());
  }
  EXPECT_EQ(pair.socket->receive(pair.received).count, 0U);
}

TEST(CanSocket, ReadsAtMostWhatThereIsRoomFor) {
  Pair pair;
  std::size_t sent = 0;
  while (sent < 90 && pair.send(frame_of(0x181, static_cast<std::uint8_t>(sent)))) ++sent;
  std::size_t got = 0;
  const std::span<CanReception> seven(pair.received.data(), 7);
  while (const std::size_t count = pair.socket->receive(seven).count) {
    ASSERT_LE(count, 7U);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(seven[i].frame.data[0], static_cast<std::uint8_t>(got++));
  }
  EXPECT_EQ(got, sent);
}

TEST(CanSocket, WhatIsNoFrameIsCountedAndTheRestIsRead) {
  Pair pair;
  for (const std::size_t size : {1U, 15U, 17U, 71U, 73U, 200U}) ASSERT_TRUE(pair.send(std::vector<std::uint8_t>(size)));
  ASSERT_TRUE(pair.send(frame_of(0x181, 7)));
  ASSERT_EQ(pair.socket->receive(pair.received).count, 1U);
  EXPECT_EQ(pair.received[0].frame, frame_of(0x181, 7));
  EXPECT_EQ(pair.socket->counts().malformed, 6U);
}

TEST(CanSocket, ABrokenDescriptorIsAnErrorWithItsName) {
  CanSocket socket("can7", UniqueFd(), 0);
  std::array<CanReception, 4> received{};
  const CanLink::Received got = socket.receive(received);
  ASSERT_TRUE(got.error);
  EXPECT_EQ(got.error->text(), "can7: read: Bad file descriptor");
}

TEST(CanSocket, AServiceThatMayNotUseCanIsToldWhatAllowsIt) {
  EXPECT_EQ((CanTrouble{"can0", "CAN socket", EAFNOSUPPORT}.text()),
            "can0: CAN socket: the kernel has no CAN, or the service may not use it (the drop-in can.conf allows it)");
}

TEST(CanSocket, AnInterfaceThatDoesNotExistIsRefusedWithItsName) {
  for (const char* const name : {"", "nocan0", "a-name-that-is-longer-than-any"}) {
    const OpenedCanLink opened = CanSocket::open(name, {});
    const auto* const trouble = opened ? nullptr : &opened.error();
    ASSERT_NE(trouble, nullptr) << name;
    EXPECT_EQ(trouble->interface, name);
    EXPECT_TRUE(trouble->what == "no such interface" || trouble->error_number != 0);
  }
}

TEST(CanSocket, NothingAllocatesWhileFramesCome) {
  Pair pair;
  pair.send(frame_of(1));
  pair.socket->receive(pair.received);
  for (int i = 0; i < 8; ++i) pair.send(frame_of(1));
  const std::size_t before = allocations();
  EXPECT_EQ(pair.socket->receive(pair.received).count, 8U);
  EXPECT_EQ(allocations(), before);
}

/// The kernel's condition: received & mask == wanted & mask.
bool passes(const std::vector<can_filter>& filters, canid_t word) {
  for (const can_filter& filter : filters)
    if ((word & filter.can_mask) == (filter.can_id & filter.can_mask)) return true;
  return false;
}

TEST(CanSocket, FiltersLetExactlyTheWantedFramesPass) {
  const std::array<CanId, 3> ids{{{0x181, false}, {0x7FF, false}, {0x181, true}}};
  const std::vector<can_filter> standard = can_filters(std::span(ids).first(2)), all = can_filters(ids);
  EXPECT_EQ(standard.size(), 2U);
  for (canid_t id = 0; id < 0x800; ++id) {
    EXPECT_EQ(passes(standard, id), id == 0x181 || id == 0x7FF);
    EXPECT_FALSE(passes(standard, id | CAN_EFF_FLAG));
    EXPECT_FALSE(passes(all, id | CAN_RTR_FLAG));
    EXPECT_EQ(passes(all, id | CAN_EFF_FLAG), id == 0x181);
  }
  EXPECT_FALSE(passes(all, 0x10000181U | CAN_EFF_FLAG));
}

TEST(WallClockStamps, AreThoseOfTheMonotonicClock) {
  WallClockStamps stamps;
  const DeviceClock::time_point now(1000s);
  stamps.look(5000s, now);
  stamps.note_empty(now - 1s);
  EXPECT_EQ(stamps.monotonic(4999800ms), now - 200ms);
  EXPECT_EQ(stamps.monotonic(5000s + 1ms), now) << "never later than the look";
  EXPECT_EQ(stamps.replaced(), 0U);
}

TEST(WallClockStamps, SurviveASettingOfTheWallClock) {
  for (const auto step : {3600s, -3600s}) {
    WallClockStamps stamps;
    stamps.look(5000s, DeviceClock::time_point(1000s));
    stamps.note_empty(DeviceClock::time_point(1000s));
    // The frame arrives at 1000.5 s, then the clock is set, and the driver reads at 1001 s.
    stamps.look(5001s + step, DeviceClock::time_point(1001s));
    EXPECT_EQ(stamps.monotonic(5000500ms), DeviceClock::time_point(1000500ms));
    // This frame arrived after the clock was set.
    EXPECT_EQ(stamps.monotonic(5000800ms + step), DeviceClock::time_point(1000800ms));
    EXPECT_EQ(stamps.replaced(), 0U);
    // This stamp agrees with neither clock.
    EXPECT_EQ(stamps.monotonic(100s), DeviceClock::time_point(1001s));
    EXPECT_EQ(stamps.replaced(), 1U);
  }
}

TEST(WallClockStamps, FollowAClockThatIsSlewed) {
  WallClockStamps stamps;
  for (int i = 0; i < 1000; ++i) {
    const DeviceClock::time_point now(1000s + i * 10ms);
    const auto wall = 5000s + i * 10ms + i * 5us;  // 500 ppm
    stamps.look(wall, now);
    ASSERT_EQ(stamps.monotonic(wall - 1ms), now - 1ms);
    stamps.note_empty(now);
  }
}

/// A virtual bus of this test. The test needs a kernel with vcan and the right to create one.
TEST(CanSocket, OnAVirtualBusTheKernelFilters) {
  const std::string name = "aztest" + std::to_string(::getpid() % 10000);
  const std::string make = "ip link add " + name + " type vcan 2>/dev/null && ip link set " + name + " up";
  if (std::system(make.c_str()) != 0) GTEST_SKIP() << "no virtual CAN bus can be made here";
  const std::array<CanId, 2> ids{{{0x181, false}, {0x12345, true}}};
  OpenedCanLink opened = CanSocket::open(name, ids);
  ASSERT_TRUE(opened) << opened.error().text();
  CanLink& link = **opened;
  const UniqueFd sender(::socket(PF_CAN, SOCK_RAW, CAN_RAW));
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(name.c_str()));
  ASSERT_EQ(::bind(sender.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  for (std::uint32_t id = 0; id < 0x800; ++id) {
    std::array<std::uint8_t, kMostCanSocketBytes> datagram{};
    const std::size_t size = encode_can_frame(frame_of(id), datagram);
    ASSERT_EQ(::write(sender.get(), datagram.data(), size), static_cast<ssize_t>(size));
  }
  std::array<CanReception, 8> received{};
  pollfd ready{.fd = link.descriptor(), .events = POLLIN, .revents = 0};
  ASSERT_EQ(::poll(&ready, 1, 2000), 1);
  ASSERT_EQ(link.receive(received).count, 1U);
  EXPECT_EQ(received[0].frame, frame_of(0x181));
  EXPECT_LT(DeviceClock::now() - received[0].at, 5s);
  EXPECT_TRUE(link.is_present());
  EXPECT_EQ(std::system(("ip link set " + name + " down").c_str()), 0);
  EXPECT_TRUE(link.receive(received).is_down);
  EXPECT_EQ(std::system(("ip link del " + name).c_str()), 0);
  EXPECT_TRUE(link.receive(received).error);
  EXPECT_FALSE(link.is_present());
}

}  // namespace
}  // namespace azimuth
