// Neither end of the socket may trust the messages of its peer.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <random>
#include <sys/mman.h>
#include <sys/socket.h>

#include "drivers/camera/link_socket.hpp"
#include "tests/drivers/camera/link_fixture.hpp"

namespace azimuth {
namespace {

using camera_link::Hello;
using test::CameraLink;
using test::open_descriptors;
using test::send_filled;
using test::serve;
using test::set_of;

const Hello kHello{test::kSmallGray, 4096, 4};

template <class Message>
std::vector<std::byte> encoded_message(const Message& message) {
  std::vector<std::byte> out;
  camera_link::encode(message, out);
  return out;
}

UniqueFd memory(std::size_t bytes, int seals) {
  UniqueFd fd(::memfd_create("test", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (::ftruncate(fd.get(), static_cast<off_t>(bytes)) != 0 || ::fcntl(fd.get(), F_ADD_SEALS, seals) != 0) return {};
  return fd;
}
constexpr int kFixedSize = F_SEAL_SHRINK | F_SEAL_GROW;

/// A server that sends any message that a test requires.
class HostileServer : public CameraLink {
 protected:
  HostileServer() : listener_(camera_link::listen_at(path(), error_)), camera_(path()) { connect(); }

  void connect() {
    pass(std::chrono::seconds(1));
    camera_.turn(now());
    client_ = UniqueFd(::accept(listener_.get(), nullptr, nullptr));
    ASSERT_TRUE(client_);
  }
  void say(Bytes message, int descriptor = -1) {
    ASSERT_EQ(camera_link::send_packet(client_.get(), message, descriptor), 0);
    camera_.turn(now());
  }
  bool greet(Bytes message, int descriptor = -1) {
    say(message, descriptor);
    const bool connected = camera_.state().connected;
    if (!connected) {
      EXPECT_FALSE(camera_.state().error.empty());
      connect();
    }
    return connected;
  }
  void greet_well() {
    const UniqueFd frames = memory(kHello.memory_bytes(), kFixedSize);
    ASSERT_TRUE(greet(encoded_message(kHello), frames.get()));
  }

  int error_ = 0;
  UniqueFd listener_, client_;
  SharedCamera camera_;
};

TEST_F(HostileServer, MemoryMustBeWhatTheHelloSays) {
  const auto accepts = [this](const UniqueFd& fd) { return greet(encoded_message(kHello), fd.get()); };
  EXPECT_FALSE(greet(encoded_message(kHello))) << "none";
  EXPECT_FALSE(accepts(memory(kHello.memory_bytes() - 1, kFixedSize))) << "too small";
  EXPECT_FALSE(accepts(memory(kHello.memory_bytes(), F_SEAL_GROW))) << "may shrink, and take the reader down";
  EXPECT_FALSE(accepts(UniqueFd(::open("/dev/zero", O_RDONLY)))) << "no memory";
  EXPECT_FALSE(accepts(UniqueFd(::open(folder().c_str(), O_RDONLY | O_DIRECTORY)))) << "a folder";
  EXPECT_EQ(camera_.state().malformed, 5U);
  EXPECT_TRUE(accepts(memory(kHello.memory_bytes(), kFixedSize)));
}

TEST_F(HostileServer, FirstMessageMustBeAHello) {
  EXPECT_FALSE(greet(encoded_message(set_of(1, 2))));
  EXPECT_FALSE(greet(std::vector<std::byte>(camera_link::kMaxMessageBytes + 5000)));
  EXPECT_FALSE(greet(std::vector<std::byte>(1)));
  EXPECT_TRUE(greet(encoded_message(Hello{})));
}

TEST_F(HostileServer, DescriptorsNobodyAskedForAreClosed) {
  greet_well();
  const std::size_t descriptors = open_descriptors();
  const UniqueFd extra(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  for (std::uint64_t i = 0; i < 100; ++i) say(encoded_message(set_of(i, 1)), extra.get());
  EXPECT_EQ(open_descriptors(), descriptors + 1);
}

TEST_F(HostileServer, SlotMustNotBeHandedOverTwice) {
  greet_well();
  const camera_link::FrameMessage frame{1, 1, {}, 64 * 48};
  say(encoded_message(frame));
  Frame held;
  ASSERT_TRUE(camera_.take(held));
  say(encoded_message(frame));
  EXPECT_FALSE(camera_.take(held));
  EXPECT_EQ(camera_.state().malformed, 1U);
  held = Frame{};
  camera_.turn(now());
  say(encoded_message(frame));
  EXPECT_TRUE(camera_.take(held));
  EXPECT_TRUE(camera_.state().connected) << "an odd message costs itself only";
}

TEST_F(HostileServer, MutatedMessagesAreCountedAndNothingElse) {
  std::mt19937_64 random(3);  // NOLINT(cert-msc51-cpp): the same every time
  greet_well();
  const std::size_t descriptors = open_descriptors();
  BearingSet set;
  Frame frame;
  std::uint64_t said = 0;
  for (std::uint64_t i = 1; i <= 30'000; ++i) {
    std::vector<std::byte> message =
        i % 3 == 0 ? encoded_message(camera_link::FrameMessage{static_cast<std::uint32_t>(i % 4), i, {}, 64 * 48})
                   : encoded_message(set_of(i, i % 5));
    for (std::uint64_t changes = random() % 3; changes > 0; --changes) {
      message[random() % message.size()] ^= static_cast<std::byte>(1U << (random() % 8));
    }
    if (random() % 20 == 0) message.resize(1 + random() % message.size());
    say(message);
    ++said;
    while (camera_.take(set)) {
    }
    while (camera_.take(frame)) EXPECT_EQ(frame.bytes().size(), 64U * 48);
    frame = Frame{};
    camera_.turn(now());
    std::array<std::byte, 64> release{};
    while (camera_link::receive_packet(client_.get(), release).outcome == camera_link::Packet::Outcome::packet) {
    }
  }
  const SharedCameraState& state = camera_.state();
  EXPECT_TRUE(state.connected);
  EXPECT_EQ(state.malformed + state.sets + state.frames, said) << "every message is accounted for";
  EXPECT_GT(state.malformed, 1000U);
  EXPECT_GT(state.frames, 1000U);
  EXPECT_EQ(open_descriptors(), descriptors);
}

TEST_F(HostileServer, FloodEndsATurnAllTheSame) {
  greet_well();
  std::uint64_t sent = 0;
  while (camera_link::send_packet(client_.get(), encoded_message(set_of(sent, 0))) == 0) ++sent;
  ASSERT_GT(sent, 100U);
  camera_.turn(now());
  EXPECT_LT(camera_.state().sets, sent);
  for (std::uint64_t i = 0; i < sent; ++i) camera_.turn(now());
  EXPECT_EQ(camera_.state().sets, sent);
  EXPECT_EQ(camera_.state().sets_replaced, sent - SharedCamera::kMaxSets);
}

class HostileClient : public CameraLink {
 protected:
  HostileClient() : server_(serve(path())) { connect(); }
  void connect() {
    server_.turn();
    client_ = camera_link::connect_to(path(), error_);
    server_.turn();
    ASSERT_TRUE(server_.has_client());
  }
  void say(Bytes message, int descriptor = -1) {
    ASSERT_EQ(camera_link::send_packet(client_.get(), message, descriptor), 0);
    server_.turn();
  }

  int error_ = 0;
  CameraServer server_;
  UniqueFd client_;
};

TEST_F(HostileClient, CannotWriteTheFrames) {
  std::vector<std::byte> room(camera_link::kMaxMessageBytes);
  const camera_link::Packet hello = camera_link::receive_packet(client_.get(), room);
  ASSERT_TRUE(hello.descriptor);
  EXPECT_EQ(::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, hello.descriptor.get(), 0), MAP_FAILED);
  EXPECT_NE(::ftruncate(hello.descriptor.get(), 0), 0);
  const char byte = 1;
  EXPECT_EQ(::pwrite(hello.descriptor.get(), &byte, 1, 0), -1);
}

TEST_F(HostileClient, WrongReleasesEndTheConnection) {
  ASSERT_TRUE(send_filled(server_, 1));
  say(encoded_message(camera_link::Release{0, 1}));
  ASSERT_TRUE(server_.has_client());
  for (const camera_link::Release wrong : {camera_link::Release{0, 1}, {3, 9}, {31, 1}}) {
    say(encoded_message(wrong));
    connect();
  }
  EXPECT_EQ(server_.counts().malformed, 3U);
  ASSERT_TRUE(send_filled(server_, 1)) << "and the next client is served";
}

TEST_F(HostileClient, AnyBytesAreSafe) {
  std::mt19937_64 random(5);  // NOLINT(cert-msc51-cpp): the same every time
  const UniqueFd extra(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  const std::size_t descriptors = open_descriptors();
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::byte> message(1 + random() % 200);
    for (std::byte& byte : message) byte = static_cast<std::byte>(random());
    say(message, i % 2 == 0 ? extra.get() : -1);
    EXPECT_FALSE(server_.has_client());
    connect();
  }
  EXPECT_EQ(server_.counts().malformed, 3000U);
  EXPECT_EQ(open_descriptors(), descriptors);
}

}  // namespace
}  // namespace azimuth
