#include <gtest/gtest.h>
#include <optional>

#include "drivers/storage/event_log.hpp"
#include "drivers/storage/recorded_outputs.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/export/estimated.hpp"

namespace azimuth::test {
namespace {

/// Writes the messages of a daemon to a log and reads them back.
class RecordedOutputsTest : public testing::Test {
 protected:
  template <class Message>
  void send(std::string_view channel, const Message& message) {
    if (!log_) log_.emplace(*EventLogWriter::create(file_));
    encode(message, data_);
    EXPECT_FALSE(log_->write(message.utime, prefix_ + std::string(channel), data_));
  }
  void send_pose(std::int64_t utime, double x_m, Health health = Health::tracking, bool predicted = false) {
    pose_cov_t pose{};
    pose.utime = utime;
    pose.x_m = x_m;
    pose.covariance[1] = 0.5;
    pose.odom_y_m = 3.0;
    pose.health = static_cast<std::int8_t>(health);
    pose.predicted = predicted ? 1 : 0;
    send(channel::kPose, pose);
  }
  void send_status(std::int64_t utime, Health health, const std::string& reason) {
    status_t status{};
    status.utime = utime;
    status.health = static_cast<std::int8_t>(health);
    status.reason = reason;
    send(channel::kStatus, status);
  }
  void send_map(std::int64_t seq, std::int32_t chunk, std::int32_t chunks, std::int64_t id) {
    map_chunk_t piece{};
    piece.seq = seq;
    piece.chunk = chunk;
    piece.chunks = chunks;
    piece.n = 1;
    piece.landmarks.resize(1);
    piece.landmarks[0].id = id;
    piece.landmarks[0].covariance[1] = 0.25;
    send(channel::kMapChunk, piece);
  }
  Estimated read() {
    EXPECT_FALSE(log_->flush());
    const auto outputs = read_recorded_outputs(file_, {.channel_prefix = prefix_});
    EXPECT_TRUE(outputs);
    outputs_ = outputs.value_or(RecordedOutputs{});
    return estimated_of(outputs_, "run");
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "a.lcm";
  std::optional<EventLogWriter> log_;
  std::vector<std::byte> data_;
  std::string prefix_;
  RecordedOutputs outputs_;
};

TEST_F(RecordedOutputsTest, AreThePosesOfSteps) {
  send_pose(100, 1.0);
  send_pose(150, 1.5, Health::tracking, true);
  send_pose(200, 2.0, Health::lost);
  const Estimated estimated = read();
  ASSERT_EQ(estimated.poses.size(), 2u);
  EXPECT_EQ(estimated.poses[1].stamp, stamp_from_us(200));
  EXPECT_EQ(estimated.poses[1].T_map_body.x_m, 2.0);
  EXPECT_EQ(estimated.poses[1].covariance(0, 1), 0.5);
  EXPECT_EQ(estimated.poses[1].T_odom_body->y_m, 3.0);
  EXPECT_EQ(estimated.poses[1].health, Health::lost);
}

TEST_F(RecordedOutputsTest, HaveTheReasonThatTheStatusTells) {
  send_pose(100, 1.0, Health::degraded);
  send_status(110, Health::degraded, "dark");
  send_pose(200, 2.0, Health::degraded);
  send_pose(300, 2.0, Health::tracking);
  const Estimated estimated = read();
  EXPECT_EQ(estimated.poses[0].reason, "dark") << "the status is of the time before it";
  EXPECT_EQ(estimated.poses[1].reason, "dark");
  EXPECT_EQ(estimated.poses[2].reason, "") << "that was another health";
}

TEST_F(RecordedOutputsTest, HaveTheNewestMapThatIsWhole) {
  send_map(1, 0, 1, 7);
  send_map(2, 1, 2, 9);  // the pieces may come in any order
  send_map(2, 0, 2, 8);
  send_map(3, 0, 2, 10);  // this map lacks its second piece
  send_pose(1, 0.0);
  const Estimated estimated = read();
  ASSERT_EQ(estimated.landmarks.size(), 2u);
  EXPECT_EQ(estimated.landmarks[0].id, 8);
  EXPECT_EQ(estimated.landmarks[1].id, 9);
  EXPECT_EQ(estimated.landmarks[1].covariance_m2(1, 0), 0.25);
}

TEST_F(RecordedOutputsTest, HaveThePathOfHindsight) {
  for (std::int32_t chunk = 0; chunk < 2; ++chunk) {
    path_t piece{};
    piece.seq = 4;
    piece.chunk = chunk;
    piece.chunks = 2;
    piece.n = 1;
    piece.poses.resize(1);
    piece.poses[0].utime = 10 + chunk;
    piece.poses[0].x_m = chunk;
    send(channel::kPath, piece);
  }
  send_pose(1, 0.0);
  const Estimated estimated = read();
  ASSERT_EQ(estimated.path.size(), 2u);
  EXPECT_EQ(estimated.path[1].stamp, stamp_from_us(11));
  EXPECT_EQ(estimated.path[1].T_map_body.x_m, 1.0);
}

TEST_F(RecordedOutputsTest, CountWhatIsLeftOut) {
  send_pose(100, 1.0);
  send_pose(100, 2.0);
  send_pose(50, 2.0);
  send_pose(200, 1e300);
  EXPECT_EQ(read().poses.size(), 1u);
  EXPECT_EQ(outputs_.poses_not_in_order, 2u);
  EXPECT_EQ(outputs_.malformed, 1u);
}

TEST_F(RecordedOutputsTest, MayHaveAPrefix) {
  send_pose(100, 1.0);
  prefix_ = "R1_";
  send_pose(200, 2.0);
  const Estimated estimated = read();
  ASSERT_EQ(estimated.poses.size(), 1u);
  EXPECT_EQ(estimated.poses[0].T_map_body.x_m, 2.0);
}

}  // namespace
}  // namespace azimuth::test
