#include "tools/export/ros_recording.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "tests/tools/export/sample.hpp"

namespace azimuth::test {
namespace {

struct Recorded {
  std::vector<Stamp> stamps;
  std::map<std::size_t, std::vector<RecordedMessage>> messages;  // keyed by the index of the topic
};

Recorded record(const Estimated& estimated) {
  Recorded recorded;
  record_for_ros(estimated, [&](Stamp stamp, const RecordedMessage& message) {
    recorded.stamps.push_back(stamp);
    recorded.messages[message.index()].push_back(message);
  });
  return recorded;
}

TEST(RosRecording, IsInTheOrderOfTime) {
  const Recorded recorded = record(sample());
  EXPECT_TRUE(std::ranges::is_sorted(recorded.stamps));
  EXPECT_EQ(recorded.messages.at(0).size(), 80u);
  EXPECT_EQ(recorded.messages.at(1).size(), 80u);
  EXPECT_EQ(recorded.messages.at(2).size(), 80u);
  EXPECT_EQ(recorded.messages.at(3).size(), 1u);
  EXPECT_EQ(recorded.messages.at(4).size(), 1u);
}

TEST(RosRecording, PlacesOfTopicsAreThoseOfTheirMessages) {
  EXPECT_EQ(kRecordedTopics.size(), std::variant_size_v<RecordedMessage>);
  EXPECT_EQ(RecordedMessage(ros::Odometry{}).index(), 1u);
  EXPECT_EQ(kRecordedTopics[1].type, ros::Type::odometry);
  EXPECT_EQ(RecordedMessage(ros::MarkerArray{}).index(), 4u);
  EXPECT_EQ(kRecordedTopics[4].type, ros::Type::markers);
  EXPECT_EQ(RecordedMessage(ros::DiagnosticArray{}).index(), 5u);
  EXPECT_EQ(kRecordedTopics[5].type, ros::Type::diagnostics);
}

TEST(RosRecording, SaysHealthEachSecondAndWhereItChanges) {
  const Recorded recorded = record(sample());
  std::vector<std::int64_t> at_ms;
  for (const RecordedMessage& message : recorded.messages.at(5))
    at_ms.push_back((to_us(std::get<ros::DiagnosticArray>(message).header.stamp) - kSampleBegin_us) / 1000);
  EXPECT_EQ(at_ms, (std::vector<std::int64_t>{0, 1000, 2000, 3000, 4000, 5000, 5500, 6500, 7500}));
  const auto& last = std::get<ros::DiagnosticArray>(recorded.messages.at(5).back());
  EXPECT_EQ(last.status.at(0).message, "degraded: few, if any, landmarks");
}

TEST(RosRecording, LeavesOutWhatNobodyKnows) {
  Estimated estimated = sample();
  for (EstimatedPose& pose : estimated.poses) {
    pose.T_odom_body.reset();
    pose.health.reset();
  }
  const Recorded recorded = record(estimated);
  EXPECT_EQ(recorded.messages.count(1) + recorded.messages.count(2) + recorded.messages.count(5), 0u);
  EXPECT_EQ(recorded.messages.at(0).size(), 80u);
}

TEST(RosRecording, SpansAllThatItSays) {
  Estimated estimated = sample();
  estimated.path = {{stamp_from_us(5), {}}, {stamp_from_us(kSampleBegin_us + 1), {}}};
  EXPECT_EQ(recorded_span(estimated).first, stamp_from_us(5));
  EXPECT_EQ(recorded_span(estimated).last, estimated.poses.back().stamp);
}

}  // namespace
}  // namespace azimuth::test
