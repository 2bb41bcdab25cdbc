// The receiver with liblcm as sender, in a network namespace of its own (tests/daemon/in_namespace.sh).

#include <azimuth/image_t.hpp>
#include <functional>
#include <gmock/gmock.h>
#include <lcm/lcm.h>
#include <memory>
#include <netinet/in.h>
#include <poll.h>
#include <random>
#include <sys/socket.h>

#include "base/clocks.hpp"
#include "drivers/lcm/lcm_frames.hpp"
#include "drivers/lcm/lcm_odometry.hpp"
#include "drivers/lcm/lcm_receiver.hpp"
#include "drivers/wire/image_message.hpp"
#include "drivers/wire/messages.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = LcmReceiver::Clock;

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

std::int64_t wall_us() {
  return std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// A sender that uses liblcm.
class Sender {
 public:
  Sender() : lcm_(lcm_create(kUrl), lcm_destroy) {}
  template <class Message>
  void send(const char* channel, const Message& message) {
    encode(message, encoded_);
    ASSERT_EQ(lcm_publish(lcm_.get(), channel, encoded_.data(), static_cast<unsigned>(encoded_.size())), 0);
  }

 private:
  std::unique_ptr<lcm_t, decltype(&lcm_destroy)> lcm_;
  std::vector<std::byte> encoded_;
};

class LcmNetworkTest : public ::testing::Test {
 protected:
  bool receive_until(LcmSink& sink, const std::function<bool()>& done) {
    for (const auto limit = Clock::now() + 20s; Clock::now() < limit;) {
      receiver_.turn(Clock::now(), sink);
      if (done()) return true;
      pollfd ready{.fd = receiver_.descriptor(), .events = POLLIN, .revents = 0};
      ::poll(&ready, 1, 10);
    }
    return false;
  }
  std::string said() const {
    const LcmOdometryCounts& counts = odometry_.counts();
    const LcmStampCounts& stamps = odometry_.stamp_counts();
    return std::to_string(receiver_.state().datagrams) + " datagrams, " + std::to_string(counts.readings) +
           " readings, " + std::to_string(counts.malformed) + " malformed, " + std::to_string(counts.other_senders) +
           " of others, " + std::to_string(stamps.too_old) + " too old, " + std::to_string(stamps.in_future) +
           " in the future, " + std::to_string(stamps.out_of_order) + " out of order";
  }
  static odometry_t reading(std::int64_t sequence) {
    odometry_t message{};
    message.utime = wall_us();
    message.seq = sequence;
    message.x_m = 1.0 + 0.01 * static_cast<double>(sequence);
    return message;
  }

  LcmSourceSettings settings_;
  LcmReceiver receiver_{*parse_lcm_url(kUrl), epoch_minus_monotonic()};
  LcmOdometry odometry_{settings_};
  LcmFrames frames_{settings_};
};

TEST_F(LcmNetworkTest, HearsOdometryFromOneSenderAndThenFromItsSuccessor) {
  OdometryReading got;
  auto sender = std::make_unique<Sender>();
  ASSERT_TRUE(receive_until(odometry_, [&] { return receiver_.state().open; })) << receiver_.state().trouble;
  for (std::int64_t i = 0; i < 100; ++i) {
    const Stamp sent = stamp_from_us(wall_us());
    sender->send("ODOMETRY", reading(i));
    ASSERT_TRUE(receive_until(odometry_, [&] { return odometry_.take(got); })) << said();
    EXPECT_EQ(got.T_odom_body.x_m, 1.0 + 0.01 * static_cast<double>(i));
    EXPECT_LT(std::chrono::abs(got.stamp - sent), 1s);
  }
  EXPECT_EQ(odometry_.counts().readings, 100U);
  EXPECT_EQ(odometry_.counts().origins, 1U);
  sender = std::make_unique<Sender>();
  ASSERT_TRUE(receive_until(odometry_, [&] {
    sender->send("ODOMETRY", reading(0));
    return odometry_.take(got);
  }));
  EXPECT_EQ(odometry_.counts().origins, 2U);
}

TEST_F(LcmNetworkTest, PutsLargeImagesTogether) {
  constexpr int kWidth_px = 640, kHeight_px = 480, kImages = 30;
  std::mt19937 random(1);
  std::vector<std::byte> pixels(std::size_t{kWidth_px} * kHeight_px);
  Sender sender;
  ASSERT_TRUE(receive_until(frames_, [&] { return receiver_.state().open; })) << receiver_.state().trouble;
  Frame frame;
  for (int i = 0; i < kImages; ++i) {
    std::ranges::generate(pixels, [&] { return static_cast<std::byte>(random()); });
    image_t message{};
    fill_message({packed_format(PixelFormat::gray8, kWidth_px, kHeight_px), pixels}, stamp_from_us(wall_us()), message);
    sender.send("CAMERA", message);
    ASSERT_TRUE(receive_until(frames_, [&] { return frames_.take(frame); })) << i;
    EXPECT_EQ(frame.stamp.time_since_epoch().count() / 1'000'000'000, message.utime / 1'000'000'000);
    ASSERT_TRUE(std::ranges::equal(frame.bytes(), pixels)) << i;
  }
  EXPECT_EQ(frames_.counts().incomplete, 0U);
  EXPECT_EQ(receiver_.state().kernel_dropped, 0U);
}

TEST_F(LcmNetworkTest, AFloodIsTakenInBoundedTurnsAndItsLossesAreCounted) {
  Sender sender;
  receiver_.turn(Clock::now(), odometry_);
  ASSERT_TRUE(receiver_.state().open);
  image_t big{};
  big.data.resize(50'000);
  big.size = 50'000;
  for (int i = 0; i < 2000; ++i) sender.send("NOISE", big);
  for (int i = 0; i < 300; ++i) sender.send("NOISE", reading(i));
  const std::uint64_t before = receiver_.state().datagrams;
  receiver_.turn(Clock::now(), odometry_);
  EXPECT_LE(receiver_.state().datagrams - before, std::uint64_t{LcmReceiver::kMaxDatagramsPerTurn});
  OdometryReading got;
  std::int64_t sequence = 0;
  ASSERT_TRUE(receive_until(odometry_, [&] {
    sender.send("ODOMETRY", reading(sequence++));
    return odometry_.take(got);
  }));
  // The kernel reports losses with the next datagram that it can store.
  EXPECT_GT(receiver_.state().kernel_dropped, 0U);
}

TEST_F(LcmNetworkTest, BytesOfNoMeaningAreCounted) {
  receiver_.turn(Clock::now(), odometry_);
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ASSERT_GE(fd, 0);
  const UniqueFd owner(fd);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(7667);
  to.sin_addr.s_addr = htonl(0xEFFF4C43);
  for (const std::size_t size : {0U, 1U, 7U, 8U, 20U, 1000U}) {
    const std::vector<std::byte> bytes(size, std::byte{'L'});
    ASSERT_EQ(::sendto(fd, bytes.data(), size, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to),
              static_cast<ssize_t>(size));
  }
  EXPECT_TRUE(receive_until(odometry_, [&] { return receiver_.state().malformed == 6; }));
  EXPECT_EQ(receiver_.state().datagrams, 6U);
}

TEST_F(LcmNetworkTest, SaysWhyItCannotListen) {
  // 224.0.0.0/4 has a route in this namespace, but a non-group address does not even accept the socket option.
  LcmReceiver receiver({.group = {127, 0, 0, 1}, .port = 7667}, Duration{});
  receiver.turn(Clock::now(), odometry_);
  EXPECT_FALSE(receiver.state().open);
  EXPECT_EQ(receiver.descriptor(), -1);
  EXPECT_THAT(receiver.state().trouble, testing::HasSubstr("udpm://127.0.0.1:7667: join the group"));
  EXPECT_GT(receiver.next_turn(), Clock::now());
}

}  // namespace
}  // namespace azimuth
