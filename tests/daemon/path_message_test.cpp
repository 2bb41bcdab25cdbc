// The path on its way to LCM: when it is published, and in which pieces.

#include <gtest/gtest.h>
#include <vector>

#include "daemon/publish/messages.hpp"
#include "daemon/publish/publisher.hpp"
#include "drivers/wire/channels.hpp"
#include "tests/daemon/quiet.hpp"

namespace azimuth {
namespace {

std::vector<PathPose> straight(int poses, double y_m = 0.0) {
  std::vector<PathPose> path;
  for (int i = 0; i < poses; ++i) path.push_back({stamp_from_us(500'000 * std::int64_t{i}), {0.1 * i, y_m, 0.0}});
  return path;
}

TEST(PathWatch, TellsTheFirstPathAndThenOnlyWhatHasMoved) {
  PathWatch watch;
  EXPECT_FALSE(watch.look({})) << "nothing has happened";
  ASSERT_TRUE(watch.look(straight(10)));
  watch.sent(straight(10));
  EXPECT_FALSE(watch.look(straight(10)));
  EXPECT_FALSE(watch.look(straight(20))) << "what was driven since is no past that has moved";
  EXPECT_FALSE(watch.look(straight(20, 0.9 * PathWatch::kMoved_m)));
  EXPECT_TRUE(watch.look(straight(20, 1.1 * PathWatch::kMoved_m)));
}

TEST(PathWatch, SmallStepsAddUp) {
  PathWatch watch;
  watch.look(straight(10));
  watch.sent(straight(10));
  EXPECT_FALSE(watch.look(straight(10, 0.04)));
  EXPECT_TRUE(watch.look(straight(10, 0.08)));
  watch.sent(straight(10, 0.08));
  EXPECT_FALSE(watch.look(straight(10, 0.04))) << "that is where it is said to be";
}

TEST(PathWatch, SeesTheNewEndOfThePathMove) {
  PathWatch watch;
  watch.look(straight(10));
  watch.sent(straight(10));
  watch.look(straight(12));
  std::vector<PathPose> path = straight(14);
  EXPECT_FALSE(watch.look(path));
  path[11].T_map_body.heading_rad = 2.0 * PathWatch::kTurned_rad;
  EXPECT_TRUE(watch.look(path));
}

TEST(PathWatch, MissesAnEndThatIsTakenBackAndNoPoseBetweenOthers) {
  PathWatch watch;
  watch.look(straight(10));
  watch.sent(straight(10));
  EXPECT_TRUE(watch.look(straight(9))) << "the robot was carried off before it";
  std::vector<PathPose> path = straight(10);
  path.erase(path.begin() + 4);
  EXPECT_FALSE(watch.look(path)) << "a long drive's path is thinned out";
  watch.sent(path);
  EXPECT_FALSE(watch.look(path));
  EXPECT_FALSE(watch.look(straight(10))) << "between two that are known";
}

TEST(PathMessages, ThePiecesMakeUpThePathAndFitADatagram) {
  const std::vector<PathPose> path = straight(4000, 0.25);
  ASSERT_EQ(path_chunks(path.size()), 3);
  std::size_t at = 0;
  for (std::int32_t i = 0; i < 3; ++i) {
    path_t message;
    fill_path_chunk(path, 7, i, message);
    EXPECT_LT(message.getEncodedSize(), 60'000);
    EXPECT_EQ(message.chunk, i);
    EXPECT_EQ(message.chunks, 3);
    EXPECT_EQ(message.seq, 7);
    EXPECT_EQ(message.utime, to_us(path.back().stamp));
    ASSERT_EQ(static_cast<std::size_t>(message.n), message.poses.size());
    for (const path_pose_t& pose : message.poses) {
      ASSERT_LT(at, path.size());
      EXPECT_EQ(pose.utime, to_us(path[at].stamp));
      EXPECT_EQ(pose.x_m, path[at].T_map_body.x_m);
      EXPECT_EQ(pose.y_m, 0.25);
      ++at;
    }
  }
  EXPECT_EQ(at, path.size());
}

struct Sent {
  std::vector<path_t> paths;
  Publisher publisher{quiet()};

  Sent() {
    publisher.listen([this](std::string_view name, std::span<const std::byte> data, Stamp /*utime*/) {
      if (name != channel::kPath) return;
      path_t& path = paths.emplace_back();
      EXPECT_EQ(path.decode(data.data(), 0, static_cast<int>(data.size())), static_cast<int>(data.size()));
    });
  }
};

TEST(Publisher, SendsAPathOnceAndAgainWhenItHasMoved) {
  Sent sent;
  sent.publisher.path(straight(2000));
  ASSERT_EQ(sent.paths.size(), 2U);
  EXPECT_EQ(sent.paths[1].poses.back().x_m, straight(2000).back().T_map_body.x_m);
  sent.publisher.path(straight(2010));
  EXPECT_EQ(sent.paths.size(), 2U);
  sent.publisher.path(straight(2010, 1.0));
  ASSERT_EQ(sent.paths.size(), 4U);
  EXPECT_EQ(sent.paths[2].seq, sent.paths[1].seq + 1);
  EXPECT_EQ(sent.paths[3].n, 210);
}

TEST(Publisher, SendsTheLastPathWhetherItHasMovedOrNot) {
  Sent sent;
  sent.publisher.path(straight(10));
  sent.publisher.last_path(straight(12));
  ASSERT_EQ(sent.paths.size(), 2U);
  EXPECT_EQ(sent.paths[1].n, 12);
  Sent nothing;
  nothing.publisher.last_path({});
  EXPECT_TRUE(nothing.paths.empty()) << "of a filter";
}

TEST(Publisher, AsksForThePathEveryFewSecondsAndTheLessTheLongerItIs) {
  Sent sent;
  using namespace std::chrono_literals;
  const Publisher::Clock::time_point start{};
  EXPECT_FALSE(sent.publisher.wants_path(start));
  EXPECT_FALSE(sent.publisher.wants_path(start + 2s));
  EXPECT_TRUE(sent.publisher.wants_path(start + 3s));
  EXPECT_FALSE(sent.publisher.wants_path(start + 5s));
  sent.publisher.path(straight(12'000));
  EXPECT_TRUE(sent.publisher.wants_path(start + 6s));
  EXPECT_FALSE(sent.publisher.wants_path(start + 25s));
  EXPECT_TRUE(sent.publisher.wants_path(start + 26s));
}

}  // namespace
}  // namespace azimuth
