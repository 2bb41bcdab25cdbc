#include "tools/view/lcm_intake.hpp"

#include <gmock/gmock.h>
#include <limits>
#include <span>

#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/tools/view/shown.hpp"

namespace azimuth::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

constexpr LcmPeer kDaemon = 1, kOther = 2;

class LcmIntakeTest : public ShownTest {
 protected:
  template <class Message>
  void send(std::string_view channel, const Message& message, LcmPeer sender = kDaemon) {
    encode(message, bytes_);
    send_bytes(channel, bytes_, sender);
  }
  void send_bytes(std::string_view channel, Bytes bytes, LcmPeer sender = kDaemon) {
    const LcmPacket packet{.sequence = ++sequence_,
                           .channel = channel,
                           .payload = bytes,
                           .size = static_cast<std::uint32_t>(bytes.size())};
    intake_.accept(packet, sender, receipt_);
  }

  LcmIntake intake_{view_, ""};
  LcmReceipt receipt_{stamp_from_us(kWall_us), Duration{}};
  std::vector<std::byte> bytes_;
  std::uint32_t sequence_ = 0;
};

TEST_F(LcmIntakeTest, ShowsTheDaemonsMessages) {
  send(channel::kPose, a_pose(0));
  send(channel::kMapChunk, a_map_piece(0, 1, 1));
  send(channel::kStatus, status_t{});
  send(channel::kBearings, to_message(a_set(0, {0.1})));
  send(channel::kSightings, sightings(0, 1, {{7, 0.1}}));
  send(channel::kExpected, expectations(0, {{7, 0.1}}));
  send(channel::kKept, kept_t{});
  EXPECT_EQ(intake_.counts().messages, 7U);
  EXPECT_THAT(intake_.counts().malformed, IsEmpty());
  EXPECT_EQ(of_kind(EventKind::pose).size(), 1U);
  EXPECT_EQ(of_kind(EventKind::map).size(), 1U);
  EXPECT_EQ(of_kind(EventKind::bearings)[0]["bearings"][0][4], "used");
}

TEST_F(LcmIntakeTest, WrongTypesAreCountedOnEveryChannel) {
  for (const std::string_view channel :
       {channel::kPose, channel::kOdometry, channel::kBearings, channel::kFeatures, channel::kSightings,
        channel::kExpected, channel::kKept, channel::kMapChunk, channel::kPath, channel::kStatus, channel::kDocument,
        channel::kPicture, channel::kTruth}) {
    if (channel == channel::kPose)
      send(channel, status_t{});
    else
      send(channel, a_pose(0));
    send_bytes(channel, std::as_bytes(std::span("rubbish")));
    send_bytes(channel, {});
  }
  EXPECT_EQ(intake_.counts().messages, 0U);
  EXPECT_EQ(intake_.counts().malformed.size(), 13U);
  for (const auto& [channel, count] : intake_.counts().malformed) EXPECT_EQ(count, 3U) << channel;
}

TEST_F(LcmIntakeTest, APoseThatCannotBeIsNone) {
  pose_cov_t pose = a_pose(0);
  pose.x_m = std::numeric_limits<double>::quiet_NaN();
  send(channel::kPose, pose);
  pose = a_pose(0);
  pose.covariance[4] = std::numeric_limits<double>::infinity();
  send(channel::kPose, pose);
  pose = a_pose(0);
  pose.health = 9;
  send(channel::kPose, pose);
  EXPECT_THAT(intake_.counts().malformed, ElementsAre(Pair("AZIMUTH_POSE", 3U)));
}

TEST_F(LcmIntakeTest, OtherChannelsAreNobodysBusiness) {
  send_bytes("CAMERA", std::as_bytes(std::span("a large image")));
  send_bytes("", {});
  EXPECT_EQ(intake_.counts().messages, 0U);
  EXPECT_THAT(intake_.counts().malformed, IsEmpty());
}

TEST_F(LcmIntakeTest, OnlyOneDaemonIsShown) {
  send(channel::kPose, a_pose(0));
  send(channel::kPose, a_pose(10), kOther);
  EXPECT_EQ(intake_.counts().other_senders, 1U);
  EXPECT_EQ(view_.restarts(), 0U);
}

TEST_F(LcmIntakeTest, ADaemonThatFollowsAnotherIsANewOne) {
  send(channel::kPose, a_pose(0));
  receipt_.stamp += std::chrono::seconds(2);
  send(channel::kPose, a_pose(10), kOther);
  EXPECT_EQ(intake_.counts().other_senders, 0U);
  EXPECT_EQ(view_.restarts(), 1U);
}

TEST_F(LcmIntakeTest, TruthComesFromWhomever) {
  send(channel::kPose, a_pose(0));
  send(channel::kTruth, to_message(TruthPose{stamp_from_us(kStart_us), {}}, 1), kOther);
  EXPECT_EQ(of_kind(EventKind::truth).size(), 1U);
}

TEST_F(LcmIntakeTest, TheRigComesAsADocument) {
  send(channel::kDocument, to_message("rig.toml", kRig, stamp_from_us(kStart_us)));
  EXPECT_EQ(data(view_.hello())["rig"]["camera_model"], "bearings");
}

TEST_F(LcmIntakeTest, APrefixIsTakenOff) {
  LcmIntake intake(view_, "robot/");
  encode(a_pose(0), bytes_);
  const auto accept = [&](std::string_view channel) {
    intake.accept(
        {.sequence = 1, .channel = channel, .payload = bytes_, .size = static_cast<std::uint32_t>(bytes_.size())},
        kDaemon, receipt_);
  };
  accept("AZIMUTH_POSE");
  EXPECT_EQ(intake.counts().messages, 0U);
  accept("robot/AZIMUTH_POSE");
  EXPECT_EQ(intake.counts().messages, 1U);
}

}  // namespace
}  // namespace azimuth::test
