// Leases on shared frames: a client holds one while others connect, disconnect or die.

#include <gmock/gmock.h>
#include <random>
#include <sys/wait.h>
#include <thread>

#include "drivers/camera/shared_camera.hpp"
#include "tests/drivers/camera/link_fixture.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::CameraLink;
using test::open_descriptors;
using test::readable;
using test::send_filled;
using test::serve;
using test::set_of;
using ::testing::Each;

TEST_F(CameraLink, LeasedPixelsStayWhileOthersPass) {
  CameraServer server = serve(path());
  SharedCamera camera(path());
  settle(server, camera);
  ASSERT_TRUE(send_filled(server, 1));
  settle(server, camera);
  Frame held;
  ASSERT_TRUE(camera.take(held));
  for (std::uint8_t i = 2; i < 60; ++i) {
    ASSERT_TRUE(send_filled(server, i));
    settle(server, camera);
    Frame passing;
    ASSERT_TRUE(camera.take(passing));
  }
  EXPECT_THAT(held.bytes(), Each(std::byte{1}));
}

TEST_F(CameraLink, LeasesSurviveBothEnds) {
  const std::size_t descriptors = open_descriptors();
  Frame pending, held;
  {
    CameraServer server = serve(path());
    SharedCamera camera(path());
    settle(server, camera);
    ASSERT_TRUE(send_filled(server, 7));
    ASSERT_TRUE(send_filled(server, 8));
    settle(server, camera);
    ASSERT_TRUE(camera.take(held));
    ASSERT_TRUE(camera.take(pending));
  }
  EXPECT_THAT(held.bytes(), Each(std::byte{7}));
  EXPECT_THAT(pending.bytes(), Each(std::byte{8}));
  held = Frame{};
  pending = Frame{};
  EXPECT_EQ(open_descriptors(), descriptors);
}

TEST_F(CameraLink, OldLeaseDoesNotFreeANewSlot) {
  SharedCamera camera(path());
  Frame old;
  {
    CameraServer server = serve(path());
    settle(server, camera);
    ASSERT_TRUE(send_filled(server, 1));
    settle(server, camera);
    ASSERT_TRUE(camera.take(old));
  }
  camera.turn(now());
  pass(1s);
  CameraServer server = serve(path());
  settle(server, camera);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(send_filled(server, 2));
  old = Frame{};
  std::vector<Frame> held(2);
  camera.turn(now());
  for (Frame& frame : held) ASSERT_TRUE(camera.take(frame));
  settle(server, camera);
  EXPECT_EQ(server.counts().malformed, 0U);
  ASSERT_TRUE(send_filled(server, 3)) << "replaced unread ones came back";
  EXPECT_THAT(held[0].bytes(), Each(std::byte{2}));
  EXPECT_THAT(held[1].bytes(), Each(std::byte{2}));
}

TEST_F(CameraLink, LeaseFromAnotherThreadWakesTheOwner) {
  CameraServer server = serve(path(), {test::kSmallGray, 1, 0});
  SharedCamera camera(path());
  settle(server, camera);
  ASSERT_TRUE(send_filled(server, 1));
  settle(server, camera);
  Frame frame;
  ASSERT_TRUE(camera.take(frame));
  EXPECT_FALSE(readable(camera.descriptor()));
  EXPECT_FALSE(send_filled(server, 2));
  std::jthread([frame = std::move(frame)]() mutable { frame = Frame{}; }).join();
  EXPECT_TRUE(readable(camera.descriptor()));
  settle(server, camera);
  EXPECT_FALSE(readable(camera.descriptor()));
  EXPECT_TRUE(send_filled(server, 3));
}

/// Either end dies and returns at random moments, with samples in flight or leased. Nothing may crash or leak, received
/// samples must equal the sent ones, and the ends must communicate again afterwards.
TEST_F(CameraLink, EitherEndMayDieAtAnyMoment) {
  std::mt19937_64 random(7);  // NOLINT(cert-msc51-cpp): the same every time
  const std::size_t descriptors = open_descriptors();
  {
    std::optional<CameraServer> server;
    std::unique_ptr<SharedCamera> camera;
    std::array<Frame, 3> held;
    std::uint64_t received = 0;
    for (int i = 0; i < 20'000; ++i) {
      const std::uint64_t choice = random() % 100;
      if (choice == 0) {
        server.reset();
      } else if (choice == 1) {
        camera.reset();
      } else if (choice < 4) {
        if (!server) server.emplace(serve(path()));
      } else if (choice < 6) {
        if (!camera) camera = std::make_unique<SharedCamera>(path());
      } else if (choice < 25 && server) {
        server->turn();
      } else if (choice < 45 && camera) {
        camera->turn(now());
      } else if (choice < 65 && server) {
        server->send(set_of(static_cast<std::uint64_t>(i), random() % 40));
      } else if (choice < 80 && server) {
        if (const auto room = server->next_frame(); !room.empty()) {
          std::ranges::fill(room, static_cast<std::byte>(i));
          server->send_frame(stamp_from_us(i));
        }
      } else if (choice < 90 && camera) {
        Frame& frame = held[random() % held.size()];
        if (camera->take(frame)) {
          ++received;
          // The pixels of a closed connection are undefined, but they can still be read.
          if (camera->state().connected) {
            ASSERT_THAT(frame.bytes(), Each(static_cast<std::byte>(to_us(frame.stamp))));
          }
        }
      } else if (choice < 95) {
        held[random() % held.size()] = Frame{};
      } else {
        pass(60ms);
      }
    }
    EXPECT_GT(received, 300U);
    if (!server) server.emplace(serve(path()));
    if (!camera) camera = std::make_unique<SharedCamera>(path());
    held = {};
    camera->turn(now());
    pass(1s);
    settle(*server, *camera);
    EXPECT_TRUE(camera->state().connected);
    EXPECT_EQ(camera->state().malformed, 0U);
    EXPECT_EQ(server->counts().malformed, 0U);
  }
  EXPECT_EQ(open_descriptors(), descriptors);
}

}  // namespace
}  // namespace azimuth
