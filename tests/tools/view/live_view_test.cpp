#include "tools/view/live_view.hpp"

#include <gmock/gmock.h>

#include "tests/tools/view/shown.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::Not;

using LiveViewTest = ShownTest;

TEST_F(LiveViewTest, APoseIsShownAsItWasSent) {
  view_.take_pose(a_pose(0), now());
  const auto pose = of_kind(EventKind::pose);
  ASSERT_EQ(pose.size(), 1U);
  EXPECT_EQ(pose[0]["x"], 1.0 / 3.0) << "to the last bit";
  EXPECT_EQ(pose[0]["health"], 1);
  EXPECT_EQ(pose[0]["covariance"], nlohmann::json({0.25, 0.0, 0.0, 0.5, 0.0, 0.125}));
  EXPECT_EQ(pose[0]["t"], 0.0);
  EXPECT_EQ(pose[0]["sent_us"], kWall_us);
}

TEST_F(LiveViewTest, PosesArePacedAndTheNewestWins) {
  for (int i = 0; i < 100; ++i) {
    view_.take_pose(a_pose(10 * i), now());
    view_.turn(now(), "");
    pass(10ms);
  }
  pass(40ms);
  view_.turn(now(), "");
  const auto poses = of_kind(EventKind::pose);
  EXPECT_GE(poses.size(), 25U);
  EXPECT_LE(poses.size(), 32U) << "30 a second";
  EXPECT_EQ(poses.back()["seq"], 990) << "the last one comes, though none follows";
}

TEST_F(LiveViewTest, PosesThatComeAtThatPaceAreAllSentThoughNotQuiteEvenly) {
  for (int i = 0; i < 60; ++i) {
    view_.take_pose(a_pose(34 * i), now());
    pass(i % 2 == 0 ? 30ms : 38ms);
  }
  EXPECT_GE(of_kind(EventKind::pose).size(), 59U);
}

TEST_F(LiveViewTest, TimesAreThoseOfTheMessagesFromTheFirstOneOn) {
  view_.take_pose(a_pose(5000), now());
  pass(1s);
  view_.take_pose(a_pose(6500), now());
  EXPECT_EQ(of_kind(EventKind::pose).back()["t"], 1.5);
  EXPECT_EQ(data(view_.hello())["epoch_us"], kStart_us + 5'000'000);
}

TEST_F(LiveViewTest, AMapIsShownWhenItIsWholeAndWhenItChanged) {
  map_chunk_t piece = a_map_piece(0, 2, 1);
  view_.take_map(piece, now());
  EXPECT_TRUE(of_kind(EventKind::map).empty());
  view_.take_map(a_map_piece(1, 2, 1), now());
  ASSERT_EQ(of_kind(EventKind::map).size(), 1U);
  EXPECT_EQ(of_kind(EventKind::map)[0]["landmarks"].size(), 2U);
  view_.take_map(a_map_piece(0, 2, 2), now());
  view_.take_map(a_map_piece(1, 2, 2), now());
  EXPECT_EQ(of_kind(EventKind::map).size(), 1U) << "the same again";
}

TEST_F(LiveViewTest, WhatClaimsTooManyPiecesIsNotRemembered) {
  for (int i = 0; i < 1000; ++i) view_.take_map(a_map_piece(i, 1'000'000, 1), now());
  view_.take_map(a_map_piece(0, 1, 2), now());
  EXPECT_EQ(of_kind(EventKind::map).size(), 1U);
}

TEST_F(LiveViewTest, BearingsWaitForWhatBecameOfThem) {
  view_.take_bearings(a_set(0, {0.1, 0.2}), now());
  EXPECT_TRUE(of_kind(EventKind::bearings).empty());
  view_.take_sightings(sightings(0, 1, {{7, 0.2}}), now());
  const auto bearings = of_kind(EventKind::bearings);
  ASSERT_EQ(bearings.size(), 1U);
  EXPECT_EQ(bearings[0]["bearings"][0][4], "unknown");
  EXPECT_EQ(bearings[0]["bearings"][1][4], "used");
  EXPECT_EQ(bearings[0]["bearings"][1][5], 7);
}

TEST_F(LiveViewTest, WhatIsKeptIsToldWithTheStatus) {
  view_.take_status(status_t{}, now());
  kept_t kept{};
  kept.log_size = 5'000;
  kept.disk_free = -1;
  kept.map_utime = kWall_us - 12'000'000;
  view_.take_kept(kept, now());
  view_.take_status(status_t{}, now());
  const auto shown = of_kind(EventKind::status);
  EXPECT_FALSE(shown[0].contains("kept"));
  EXPECT_EQ(shown[1]["kept"]["log_bytes"], 5'000);
  EXPECT_TRUE(shown[1]["kept"]["log_quota_bytes"].is_null());
  EXPECT_TRUE(shown[1]["kept"]["disk_free_bytes"].is_null());
  EXPECT_EQ(shown[1]["kept"]["map_age_s"], 12.0);
}

/// A page that receives nothing for a second concludes that the server is gone.
TEST_F(LiveViewTest, SomethingComesAtLeastTwiceASecond) {
  for (int i = 0; i < 100; ++i) {
    view_.turn(now(), "");
    pass(50ms);
  }
  EXPECT_GE(of_kind(EventKind::beat).size() + of_kind(EventKind::silence).size(), 9U);
  EXPECT_LE(of_kind(EventKind::beat).size(), 10U);
  for (const ViewEvent& event : view_.newest()) EXPECT_NE(event.kind, EventKind::beat);
}

TEST_F(LiveViewTest, BearingsOfWhichNothingIsSaidAreShownAllTheSame) {
  for (int i = 0; i < 10; ++i) {
    view_.take_bearings(a_set(50 * i, {0.1}), now());
    view_.turn(now(), "");
    pass(50ms);
  }
  const auto bearings = of_kind(EventKind::bearings);
  ASSERT_FALSE(bearings.empty());
  EXPECT_EQ(bearings[0]["bearings"][0][4], "unknown");
}

TEST_F(LiveViewTest, BearingsAreInTheRobotsFrameOnceTheRigIsKnown) {
  view_.take_rig(kRig, now());
  EXPECT_EQ(data(view_.hello())["rig"]["front_end"], "bearings");
  view_.take_bearings(a_set(0, {0.1}), now());
  pass(200ms);
  view_.turn(now(), "");
  EXPECT_NEAR(of_kind(EventKind::bearings)[0]["bearings"][0][0], -0.1 + 0.5, 1e-12) << "clockwise, turned by 0.5";
}

TEST_F(LiveViewTest, ARigThatCannotBeReadIsNone) {
  view_.take_rig("front_end = 7 [", now());
  EXPECT_TRUE(data(view_.hello())["rig"].is_null());
  constexpr std::size_t kLevels = 32000;  // as many as fit into one datagram
  view_.take_rig("camera = " + std::string(kLevels, '[') + std::string(kLevels, ']'), now());
  EXPECT_TRUE(data(view_.hello())["rig"].is_null());
}

TEST_F(LiveViewTest, SilenceIsToldAndEnds) {
  view_.take_pose(a_pose(0), now());
  for (int i = 0; i < 40; ++i) {
    pass(100ms);
    view_.turn(now(), "no network");
  }
  const auto silence = of_kind(EventKind::silence);
  EXPECT_EQ(silence.size(), 3U) << "after 1.4 s, once a second";
  EXPECT_EQ(silence.back()["trouble"], "no network");
  view_.take_pose(a_pose(4000), now());
  for (const ViewEvent& event : view_.newest()) EXPECT_NE(event.kind, EventKind::silence);
}

/// A daemon without its devices has no estimate, so its status has no time.
TEST_F(LiveViewTest, AStatusBeforeAnyEstimateIsOfNoTime) {
  view_.take_status(status_t{}, now());
  EXPECT_TRUE(of_kind(EventKind::status)[0]["t"].is_null());
  view_.take_pose(a_pose(0), now());
  EXPECT_EQ(of_kind(EventKind::pose)[0]["t"], 0.0) << "which is where time begins";
  status_t status{};
  status.seq = status.estimates = 1;
  status.utime = kStart_us + 500'000;
  view_.take_status(status, now());
  EXPECT_EQ(of_kind(EventKind::status)[1]["t"], 0.5);
}

TEST_F(LiveViewTest, StatusHasTheDaemonsOwnNamesAndRates) {
  view_.take_pose(a_pose(0), now());
  for (int i = 0; i < 20; ++i) view_.take_odometry();
  pass(1s);
  status_t status{};
  status.seq = 1;
  status.utime = kStart_us;
  status.accepted = 12;
  status.odometer = std::string(10'000, 'x');
  status.battery_v = std::numeric_limits<double>::quiet_NaN();
  view_.take_status(status, now());
  const auto shown = of_kind(EventKind::status);
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_EQ(shown[0]["accepted"], 12);
  EXPECT_TRUE(shown[0]["battery_v"].is_null());
  EXPECT_LT(shown[0]["odometer"].get<std::string>().size(), 600U);
  EXPECT_EQ(shown[0]["rates"]["odometry_hz"], 20.0);
  EXPECT_EQ(shown[0]["rates"]["pose_hz"], 1.0);
}

TEST_F(LiveViewTest, LatencyIsThatOfTheClockThatStampsOrNone) {
  view_.take_pose(a_pose(0), now());
  status_t status{};
  view_.take_status(status, now());
  EXPECT_TRUE(of_kind(EventKind::status)[0]["latency_s"].is_null()) << "stamps of a recording";
  pose_cov_t live = a_pose(0);
  live.utime = kWall_us - 20'000;
  view_.take_pose(live, now());
  view_.take_status(status, now());
  EXPECT_NEAR(of_kind(EventKind::status)[1]["latency_s"], 0.02, 1e-9);
}

TEST_F(LiveViewTest, ADaemonThatCountsAnewIsAnotherOne) {
  view_.take_pose(a_pose(1000), now());
  const std::uint64_t restarts = view_.restarts(), generation = view_.generation();
  pose_cov_t first = a_pose(1400);
  first.seq = 1;  // the sequence number is smaller although the pose is newer
  view_.take_pose(first, now());
  EXPECT_EQ(view_.restarts(), restarts + 1);
  EXPECT_GT(view_.generation(), generation);
  EXPECT_EQ(data(view_.hello())["epoch_us"], first.utime);
  double told_until_t_s = -1.0;
  const auto trail = view_.trail_after(told_until_t_s);
  ASSERT_TRUE(trail);
  EXPECT_EQ(data(*trail)["t"].size(), 1U) << "the way of the one before is gone";
}

/// A pose with a sequence number. Odd numbers are steps; even numbers are predictions, whose stamps are 60 ms later.
pose_cov_t numbered(std::int64_t number, std::int64_t ms) {
  pose_cov_t pose = a_pose(number % 2 == 0 ? ms + 60 : ms);
  pose.seq = number;
  pose.predicted = number % 2 == 0 ? 1 : 0;
  return pose;
}

TEST_F(LiveViewTest, ADatagramThatWasOvertakenIsNoOtherDaemon) {
  // GIVEN a drive whose late datagrams are overtaken by up to four others
  constexpr std::int64_t kPoses = 200;
  for (std::int64_t behind = 1; behind <= 4; ++behind) {
    LiveView view("azimuth test", "", lookers_, now_);
    for (std::int64_t i = 2; i < kPoses; ++i) {
      const bool is_late = i % 5 == 0;
      if (!is_late) view.take_pose(numbered(i, 50 * (i / 2)), now());
      if (const std::int64_t late = i - behind; late % 5 == 0 && late > 0)
        view.take_pose(numbered(late, 50 * (late / 2)), now());
    }
    EXPECT_EQ(view.restarts(), 0U) << behind;
    double told_until_t_s = -1.0;
    const auto trail = view.trail_after(told_until_t_s);
    ASSERT_TRUE(trail);
    EXPECT_GT(data(*trail)["t"].size(), 50U) << "the way is not forgotten";
  }
}

TEST_F(LiveViewTest, WhatTheDaemonBeforeLeftIsNotTheNewOnes) {
  view_.take_pose(a_pose(1000), now());
  pose_cov_t first = a_pose(1400);
  first.seq = 1;
  view_.take_pose(first, now());
  view_.take_pose(a_pose(1020), now());
  EXPECT_EQ(view_.restarts(), 1U);
  EXPECT_EQ(of_kind(EventKind::pose).size(), 2U);
}

TEST_F(LiveViewTest, AStatusThatWasOvertakenIsLeftOut) {
  status_t status{};
  for (const std::int64_t number : {1, 3, 2, 4}) {
    status.seq = number;
    status.utime_mono = kStart_us + 200'000 * number;
    view_.take_status(status, now());
  }
  EXPECT_EQ(view_.restarts(), 0U);
  EXPECT_EQ(of_kind(EventKind::status).size(), 3U);
  status.seq = 1;
  status.utime_mono += 200'000;
  view_.take_status(status, now());
  EXPECT_EQ(view_.restarts(), 1U) << "the number of another session, which is newer";
}

TEST_F(LiveViewTest, StampsThatGoBackAreAnotherRecording) {
  view_.take_pose(a_pose(60'000), now());
  pose_cov_t pose = a_pose(0);
  pose.seq = 60'001;
  view_.take_pose(pose, now());
  EXPECT_EQ(view_.restarts(), 1U);
}

TEST_F(LiveViewTest, ALateStepIsNone) {
  pose_cov_t prediction = a_pose(1000);
  prediction.predicted = 1;
  view_.take_pose(prediction, now());
  pose_cov_t step = a_pose(950);
  step.seq = 1001;
  view_.take_pose(step, now());
  EXPECT_EQ(view_.restarts(), 0U);
}

TEST_F(LiveViewTest, APictureIsKeptAndTold) {
  const std::string jpeg = "not looked into";
  view_.take_picture(stamp_from_us(kStart_us), std::as_bytes(std::span(jpeg)), 640, 480, now());
  EXPECT_EQ(of_kind(EventKind::picture)[0]["seq"], 1);
  EXPECT_EQ(*view_.picture().jpeg, jpeg);
  const std::string giant(ViewLimits{}.picture_bytes + 1, 'x');
  view_.take_picture(stamp_from_us(kStart_us), std::as_bytes(std::span(giant)), 640, 480, now());
  EXPECT_EQ(*view_.picture().jpeg, jpeg) << "larger than anything that is shown";
}

TEST_F(LiveViewTest, ALongPathIsThinned) {
  path_t piece{};
  piece.chunks = 1;
  piece.poses.resize(50'000);
  piece.n = 50'000;
  view_.take_path(piece, now());
  EXPECT_LE(of_kind(EventKind::path)[0]["points"].size(), ViewLimits{}.path_points);
  EXPECT_GT(of_kind(EventKind::path)[0]["points"].size(), ViewLimits{}.path_points / 2);
}

TEST_F(LiveViewTest, TextOfAnyBytesBreaksNoStream) {
  status_t status{};
  status.reason = "\n\nevent: pose\ndata: {}\n\n\xff\xfe</script>\xe2\x80\xa8";
  view_.take_status(status, now());
  collect();
  const auto names = names_of(take_events(seen_));
  EXPECT_THAT(names, Not(Contains("pose")));
  EXPECT_THAT(names, Contains("status"));
}

TEST_F(LiveViewTest, TruthIsAWayOfItsOwn) {
  for (int i = 0; i < 5; ++i) {
    view_.take_truth({stamp_from_us(kStart_us + 100'000 * i), {0.1 * i, 0.0, 0.0}}, now());
    pass(100ms);
  }
  EXPECT_EQ(of_kind(EventKind::truth).size(), 5U);
  double told_until_t_s = -1.0;
  EXPECT_EQ(data(*view_.truth_trail_after(told_until_t_s))["t"].size(), 5U);
  EXPECT_FALSE(view_.truth_trail_after(told_until_t_s));
}

TEST_F(LiveViewTest, TheLastTruthIsShownThoughNoneFollows) {
  for (int i = 0; i < 5; ++i) view_.take_truth({stamp_from_us(kStart_us + 1000 * i), {0.1 * i, 0.0, 0.0}}, now());
  pass(40ms);
  EXPECT_LE(view_.next_turn(), now().at);
  view_.turn(now(), "");
  const auto truth = of_kind(EventKind::truth);
  EXPECT_LT(truth.size(), 5U) << "they are paced";
  EXPECT_EQ(truth.back()["x"], 0.4);
}

TEST_F(LiveViewTest, WhoComesLaterIsToldTheNewestOfEverything) {
  view_.take_pose(a_pose(0), now());
  view_.take_map(a_map_piece(0, 1, 1), now());
  view_.take_status(status_t{}, now());
  std::vector<EventKind> kinds;
  for (const ViewEvent& event : view_.newest()) kinds.push_back(event.kind);
  EXPECT_THAT(kinds, ElementsAre(EventKind::journal, EventKind::pose, EventKind::map, EventKind::status));
}

}  // namespace
}  // namespace azimuth::test
