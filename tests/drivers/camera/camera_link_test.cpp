#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include "drivers/camera/shared_camera.hpp"
#include "tests/drivers/camera/link_fixture.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::CameraLink;
using test::readable;
using test::send_filled;
using test::serve;
using test::set_of;
using ::testing::Each;
using ::testing::HasSubstr;

TEST_F(CameraLink, FramesArriveAsTheyWereSent) {
  CameraServer server = serve(path());
  SharedCamera camera(path());
  settle(server, camera);
  ASSERT_TRUE(camera.state().connected);
  EXPECT_EQ(camera.state().format, test::kSmallGray);

  for (std::uint8_t i = 1; i <= 100; ++i) {
    ASSERT_TRUE(send_filled(server, i, stamp_from_us(1000 * i)));
    ASSERT_TRUE(readable(camera.descriptor()));
    settle(server, camera);
    Frame frame;
    ASSERT_TRUE(camera.take(frame));
    EXPECT_EQ(frame.sequence, i);
    EXPECT_EQ(to_us(frame.stamp), 1000 * i);
    EXPECT_EQ(frame.format(), test::kSmallGray);
    EXPECT_EQ(frame.bytes().size(), test::kSmallGray.bytes());
    EXPECT_THAT(frame.bytes(), Each(std::byte{i}));
    EXPECT_FALSE(camera.take(frame));
    EXPECT_TRUE(frame) << "a take that found nothing changes nothing";
  }
  EXPECT_EQ(camera.state().frames, 100U);
  EXPECT_EQ(camera.state().frames_missing, 0U);
  EXPECT_EQ(server.counts().frames, 100U);
}

TEST_F(CameraLink, BearingsAloneNeedNoMemory) {
  FileResult<CameraServer> server = CameraServer::listen_for_bearings(path());
  ASSERT_TRUE(server) << text(server.error());
  SharedCamera camera(path());
  settle(*server, camera);
  ASSERT_TRUE(camera.state().connected);
  EXPECT_EQ(camera.state().format.width_px, 0);
  EXPECT_TRUE(server->next_frame().empty());

  ASSERT_TRUE(server->send(set_of(1, 3)));
  ASSERT_TRUE(server->send(set_of(2, 0)));
  ASSERT_TRUE(server->send(set_of(5, camera_link::kMaxBearings)));
  EXPECT_FALSE(server->send(set_of(6, camera_link::kMaxBearings + 1)));
  camera.turn(now());
  BearingSet set;
  for (const auto& [sequence, count] : {std::pair{1, 3}, {2, 0}, {5, 1024}}) {
    ASSERT_TRUE(camera.take(set));
    EXPECT_EQ(set.sequence, static_cast<std::uint64_t>(sequence));
    EXPECT_EQ(set.bearings.size(), static_cast<std::size_t>(count));
  }
  EXPECT_FALSE(camera.take(set));
  EXPECT_EQ(camera.state().sets, 3U);
  EXPECT_EQ(camera.state().sets_missing, 2U);
  EXPECT_EQ(server->counts().sets_skipped, 1U);
}

TEST_F(CameraLink, JpegFramesHaveLengthsOfTheirOwn) {
  CameraServer server = serve(path(), {packed_format(PixelFormat::mjpeg, 640, 480), 2, 5000});
  SharedCamera camera(path());
  settle(server, camera);
  const std::span<std::byte> room = server.next_frame();
  ASSERT_GE(room.size(), 5000U);
  room[1233] = std::byte{42};
  ASSERT_TRUE(server.send_jpeg({}, 1234));
  camera.turn(now());
  Frame frame;
  ASSERT_TRUE(camera.take(frame));
  EXPECT_EQ(frame.bytes().size(), 1234U);
  EXPECT_EQ(frame.bytes().back(), std::byte{42});
}

TEST_F(CameraLink, FramesThatNoSlotHoldsAreSkipped) {
  CameraServer server = serve(path(), {packed_format(PixelFormat::mjpeg, 640, 480), 2, 5000});
  SharedCamera camera(path());
  settle(server, camera);
  EXPECT_FALSE(server.send_jpeg({}, 100)) << "no slot was given";
  for (const std::size_t bytes : {std::size_t{0}, server.next_frame().size() + 1}) {
    ASSERT_FALSE(server.next_frame().empty());
    EXPECT_FALSE(server.send_jpeg({}, bytes)) << bytes;
  }
  EXPECT_EQ(server.counts().frames, 0U);
  EXPECT_EQ(server.counts().frames_skipped, 3U);
}

TEST_F(CameraLink, SlowClientLosesFramesAndSeesTheGap) {
  CameraServer server = serve(path());
  SharedCamera camera(path());
  settle(server, camera);
  int sent = 0;
  for (int i = 0; i < 20; ++i) sent += send_filled(server, 1) ? 1 : 0;
  EXPECT_EQ(sent, 4) << "as many as there are slots";
  EXPECT_EQ(server.counts().frames_skipped, 16U);

  settle(server, camera);
  settle(server, camera);
  EXPECT_EQ(camera.state().frames_replaced, 4U - SharedCamera::kMaxFrames);
  Frame frame;
  ASSERT_TRUE(camera.take(frame));
  EXPECT_EQ(frame.sequence, 3U) << "the oldest went first";
  ASSERT_TRUE(send_filled(server, 2));
  settle(server, camera);
  EXPECT_EQ(camera.state().frames_missing, 16U);
}

TEST_F(CameraLink, FramesSkippedWhileOneIsMade) {
  CameraServer server = serve(path());
  SharedCamera camera(path());
  settle(server, camera);
  ASSERT_TRUE(send_filled(server, 1));
  const std::span<std::byte> room = server.next_frame();
  server.skip_frame();
  server.skip_frame();
  std::ranges::fill(room, std::byte{2});
  ASSERT_TRUE(server.send_frame({}));
  EXPECT_EQ(server.counts().frames_skipped, 2U);
  settle(server, camera);
  Frame frame;
  ASSERT_TRUE(camera.take(frame));
  ASSERT_TRUE(camera.take(frame));
  EXPECT_EQ(frame.sequence, 2U);
  EXPECT_THAT(frame.bytes(), Each(std::byte{2}));
  ASSERT_TRUE(send_filled(server, 3));
  settle(server, camera);
  ASSERT_TRUE(camera.take(frame));
  EXPECT_EQ(frame.sequence, 5U);
  EXPECT_EQ(camera.state().frames_missing, 2U);
}

TEST_F(CameraLink, ClientThatNeverReadsCostsNobodyElse) {
  CameraServer server = serve(path());
  {
    SharedCamera camera(path());
    settle(server, camera);
    for (std::uint64_t i = 0; i < 20'000; ++i) server.send(set_of(i, 100));
    EXPECT_GT(server.counts().sets, 0U);
    EXPECT_GT(server.counts().sets_skipped, 10'000U);
    EXPECT_TRUE(server.has_client());
  }
  server.turn();
  EXPECT_FALSE(server.has_client());
  SharedCamera next(path());
  settle(server, next);
  EXPECT_TRUE(next.state().connected);
  EXPECT_TRUE(send_filled(server, 1)) << "the slots of the one before are free again";
}

TEST_F(CameraLink, SecondClientWaitsForTheFirstToGo) {
  CameraServer server = serve(path());
  auto first = std::make_unique<SharedCamera>(path());
  SharedCamera second(path());
  settle(server, *first);
  settle(server, second);
  EXPECT_TRUE(first->state().connected);
  EXPECT_FALSE(second.state().connected);
  EXPECT_FALSE(second.state().error.empty());
  EXPECT_FALSE(readable(server.descriptor())) << "one who waits must not keep the event loop awake";
  first.reset();
  EXPECT_TRUE(readable(server.descriptor()));
  server.turn();
  settle(server, second);
  EXPECT_TRUE(second.state().connected);
}

TEST_F(CameraLink, IsTriedEverMoreSeldomAndThenAtOnceAgain) {
  SharedCamera camera(path());
  std::vector<SharedCamera::Clock::duration> waits;
  for (const auto begin = now(); now() - begin < 30s;
       pass(std::chrono::ceil<std::chrono::milliseconds>(waits.back()))) {
    camera.turn(now());
    EXPECT_THAT(camera.state().error, HasSubstr("No such file"));
    waits.push_back(camera.next_turn() - now());
  }
  EXPECT_EQ(waits.front(), 50ms);
  EXPECT_TRUE(std::ranges::is_sorted(waits));
  EXPECT_EQ(waits.back(), 1s);

  auto server = std::make_unique<CameraServer>(serve(path()));
  settle(*server, camera);
  ASSERT_TRUE(camera.state().connected);
  EXPECT_TRUE(camera.state().error.empty());
  EXPECT_EQ(camera.next_turn(), SharedCamera::Clock::time_point::max());
  server.reset();
  EXPECT_TRUE(readable(camera.descriptor()));
  camera.turn(now());
  EXPECT_FALSE(camera.state().connected);
  EXPECT_FALSE(camera.state().error.empty());
  EXPECT_EQ(camera.next_turn() - now(), 50ms);
}

TEST_F(CameraLink, StaleSocketIsReplacedALiveOneAndAFileAreNot) {
  const pid_t child = ::fork();
  if (child == 0) {
    const CameraServer server = serve(path());
    ::_exit(0);  // ends without clean-up, as if killed
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(std::filesystem::is_socket(path()));

  const CameraServer server = serve(path());
  const FileResult<CameraServer> second = CameraServer::listen(path(), {test::kSmallGray, 1, 0});
  ASSERT_FALSE(second);
  EXPECT_THAT(text(second.error()), HasSubstr("in use"));

  const std::filesystem::path file = folder() / "file";
  { const UniqueFd made(::open(file.c_str(), O_CREAT | O_WRONLY, 0600)); }
  EXPECT_FALSE(CameraServer::listen_for_bearings(file));
  EXPECT_TRUE(std::filesystem::exists(file));
  EXPECT_FALSE(CameraServer::listen_for_bearings(folder() / std::string(200, 'x'))) << "longer than addresses are";
}

TEST_F(CameraLink, SocketFileGoesWithTheServer) {
  { const CameraServer server = serve(path()); }
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(CameraLink, OffersThatCannotBeServed) {
  EXPECT_FALSE(CameraServer::listen(path(), {test::kSmallGray, 0, 0}));
  EXPECT_FALSE(CameraServer::listen(path(), {test::kSmallGray, FramePool::kMaxSlots + 1, 0}));
  EXPECT_FALSE(CameraServer::listen(path(), {packed_format(PixelFormat::rgb8, 16384, 16384), 2, 0}));
  EXPECT_FALSE(CameraServer::listen(path(), {packed_format(PixelFormat::mjpeg, 640, 480), 2, 0}));
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(CameraLink, SteadyStateAllocatesNothing) {
  CameraServer server = serve(path());
  SharedCamera camera(path());
  BearingSet set, sent = set_of(1, kTypicalBearings);
  Frame frame;
  const auto round = [&] {
    ++sent.sequence;
    server.turn();
    bool good = send_filled(server, 1) && server.send(sent);
    camera.turn(now());
    good = camera.take(frame) && camera.take(set) && good;
    frame = Frame{};
    camera.turn(now());
    return good;
  };
  settle(server, camera);
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(round());
  const std::size_t before = allocations();
  bool good = true;
  for (int i = 0; i < 1000; ++i) good = round() && good;
  EXPECT_EQ(allocations() - before, 0U);
  EXPECT_TRUE(good);
}

}  // namespace
}  // namespace azimuth
