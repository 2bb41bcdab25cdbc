#include "tools/replay/replay_record.hpp"

#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "tools/replay/replay_picture.hpp"
#include "tools/replay/summary.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

struct Replayed {
  Run run;
  ReplayResult result;
  Report report;
};

Replayed replayed(const Scenario& scenario) {
  Replayed outcome;
  outcome.run = simulated_run(scenario);
  const Rig rig = read_rig(outcome.run.rig_toml, "rig.toml").value();
  outcome.result = replay(outcome.run, rig, make_ekf_estimator(rig, EkfSettings{}), StageSettings{});
  outcome.report = evaluate(replay_record(outcome.run, rig, "ekf", 5, outcome.result));
  return outcome;
}

TEST(ReplayRecord, CarriesEverythingToTheReport) {
  const Replayed outcome = replayed(lab(1, 1));
  const Report& report = outcome.report;
  EXPECT_EQ(report.run, "lab");
  EXPECT_EQ(report.front_end, "bearings");
  EXPECT_EQ(report.seed, 5u);
  EXPECT_EQ(report.steps, outcome.run.bearings.size());
  EXPECT_EQ(report.position_m.count, report.steps);
  EXPECT_EQ(report.map.true_landmarks, 24u);
  EXPECT_EQ(report.association.accepted, outcome.result.last.association.accepted);
  EXPECT_EQ(report.digest.size(), 16u);
  EXPECT_GT(report.peak_memory_mb, 1.0);
  EXPECT_LT(report.position_m.rmse, 0.5);
}

TEST(ReplayPicture, BringsTruthIntoTheMapFrame) {
  const Replayed outcome = replayed(lab(1, 1));
  const MapPicture picture = replay_picture(outcome.run, outcome.result, outcome.report);
  ASSERT_EQ(picture.truth.size(), 1u);
  EXPECT_LT((picture.truth[0].back() - picture.estimate.back().line.back()).norm(), 0.5);
  EXPECT_EQ(picture.odometry.front(), picture.estimate.front().line.front());
  EXPECT_EQ(picture.true_landmarks.size(), 24u);
  EXPECT_EQ(picture.landmarks.size(), outcome.result.last.landmarks.size());
  EXPECT_FALSE(picture.poses.empty());
}

TEST(ReplayPicture, HasThePathInHindsightWhereThereIsOne) {
  Replayed outcome = replayed(lab(1, 1));
  EXPECT_TRUE(replay_picture(outcome.run, outcome.result, outcome.report).smoothed.empty()) << "of a filter";
  outcome.result.past = {{outcome.result.estimates[0].stamp, {1.0, 2.0, 0.0}, {}},
                         {outcome.result.estimates[1].stamp, {3.0, 4.0, 0.0}, {}}};
  const PlotLine smoothed = replay_picture(outcome.run, outcome.result, outcome.report).smoothed;
  ASSERT_EQ(smoothed.size(), 2U);
  EXPECT_EQ(smoothed[1], Eigen::Vector2d(3.0, 4.0));
}

TEST(ReplayPicture, PartsThePathWhereTheRobotWasLost) {
  Replayed outcome = replayed(lab(1, 1));
  auto& healths = outcome.result.healths;
  for (std::size_t i = 100; i < 110; ++i) healths[i].health = Health::lost;
  const auto path = replay_picture(outcome.run, outcome.result, outcome.report).estimate;
  ASSERT_EQ(path.size(), 3U);
  EXPECT_FALSE(path[0].lost || path[2].lost);
  EXPECT_TRUE(path[1].lost);
  EXPECT_EQ(path[0].line.size(), 100U);
  EXPECT_EQ(path[1].line.size(), 11U) << "from where it was last known to be";
  EXPECT_EQ(path[1].line.front(), path[0].line.back());
  EXPECT_EQ(path[2].line.front(), outcome.result.estimates[110].T_map_body.position()) << "found again: no path";
}

TEST(ReplayPicture, TellsKindsAndNamesAndWhatIsHardlyKnown) {
  Replayed outcome = replayed(lab(1, 1));
  ASSERT_TRUE(outcome.result.map);
  auto& saved = outcome.result.map->landmarks;
  for (MapLandmark& landmark : saved) landmark.kind = static_cast<Kind>(landmark.id % 2);
  const std::int64_t unsettled = saved.back().id;
  saved.pop_back();
  outcome.report.front_end = "colour";
  const std::vector<ColourClass> classes{{.name = "red", .hue_from_deg = 340.0, .hue_to_deg = 20.0}};
  const MapPicture picture = replay_picture(outcome.run, outcome.result, outcome.report, classes);
  ASSERT_EQ(picture.kinds.size(), 2U);
  EXPECT_EQ(picture.kinds[0].name, "red");
  EXPECT_EQ(picture.kinds[0].hue_deg, 0.0);
  EXPECT_EQ(picture.kinds[1].name, "kind 1");
  for (std::size_t i = 0; i < picture.landmarks.size(); ++i) {
    const LandmarkEstimate& landmark = outcome.result.last.landmarks[i];
    EXPECT_EQ(picture.landmarks[i].is_known, landmark.id != unsettled);
    EXPECT_EQ(picture.landmarks[i].name, std::to_string(landmark.identity)) << "the sensor's name for it";
    if (landmark.id != unsettled) {
      EXPECT_EQ(picture.landmarks[i].kind, landmark.id % 2);
    }
  }
}

TEST(ReplayPicture, FeaturesAreNotClaimedToBeTheTrueLandmarks) {
  Replayed outcome = replayed(lab(1, 1));
  Rig rig = read_rig(outcome.run.rig_toml, "rig.toml").value();
  rig.front_end = FrontEnd::sift;
  outcome.report = evaluate(replay_record(outcome.run, rig, "ekf", 5, outcome.result));
  EXPECT_TRUE(outcome.report.natural_features);
  EXPECT_EQ(outcome.report.map.matched, 0U);
  EXPECT_EQ(outcome.report.named_map.named, 0U);
  const MapPicture picture = replay_picture(outcome.run, outcome.result, outcome.report);
  EXPECT_EQ(picture.subtitle.find("true landmarks mapped"), std::string::npos) << picture.subtitle;
  EXPECT_NE(picture.subtitle.find("24 features"), std::string::npos) << picture.subtitle;
  EXPECT_EQ(picture.landmark_word, "feature");
  const std::string text = summary(outcome.run, outcome.result, outcome.report);
  EXPECT_EQ(text.find("one to one"), std::string::npos);
  EXPECT_NE(text.find("not compared with the 24 true landmarks"), std::string::npos);
}

TEST(LandmarkCounts, SayWhatTheyCount) {
  Replayed outcome = replayed(lab(1, 1));
  EXPECT_EQ(landmark_counts(outcome.report), "24 landmarks");
  outcome.result.map->landmarks.pop_back();
  const Rig rig = read_rig(outcome.run.rig_toml, "rig.toml").value();
  outcome.report = evaluate(replay_record(outcome.run, rig, "ekf", 5, outcome.result));
  EXPECT_EQ(landmark_counts(outcome.report), "24 landmarks, 23 of them settled");
}

TEST(ReplayPicture, BreaksTruthWhereItIsMissing) {
  Replayed outcome = replayed(lab(1, 1));
  auto& truth = outcome.run.truth;
  truth.erase(truth.begin() + 50, truth.begin() + 60);
  EXPECT_EQ(replay_picture(outcome.run, outcome.result, outcome.report).truth.size(), 2u);
}

TEST(ReplayPicture, DoesWithoutTruth) {
  Replayed outcome = replayed(coloured_lab(1));
  outcome.run.truth.clear();
  outcome.report.T_world_map.reset();
  outcome.report.position_m = {};
  const MapPicture picture = replay_picture(outcome.run, outcome.result, outcome.report);
  EXPECT_TRUE(picture.truth.empty() && picture.true_landmarks.empty());
  EXPECT_NE(picture.subtitle.find("no truth"), std::string::npos);
}

TEST(Summary, NamesWhatWasMeasured) {
  const Replayed outcome = replayed(lab(1, 1));
  const std::string text = summary(outcome.run, outcome.result, outcome.report);
  for (const char* topic : {"run", "estimator", "position", "odometry", "consistency", "one to one", "by identity",
                            "bearings", "step time", "digest"})
    EXPECT_NE(text.find(topic), std::string::npos) << topic;
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("not used"), std::string::npos);
}

TEST(Summary, SaysWhatToAskWhereLittleWasTracked) {
  Replayed outcome = replayed(lab(1, 1));
  EXPECT_EQ(summary(outcome.run, outcome.result, outcome.report).find("azimuth check"), std::string::npos);
  HealthReport& health = outcome.report.health_over_time;
  health.times[static_cast<std::size_t>(Health::tracking)].share = 0.2;
  EXPECT_NE(summary(outcome.run, outcome.result, outcome.report).find("azimuth check"), std::string::npos);
  outcome.report.input_trouble = "stamps look like milliseconds";  // this hint has priority
  EXPECT_EQ(summary(outcome.run, outcome.result, outcome.report).find("azimuth check"), std::string::npos);
}

TEST(Summary, EndsWithWhatToAskWhereErrorsAreLargerThanSaid) {
  Replayed outcome = replayed(lab(1, 1));
  ASSERT_GE(outcome.report.tracking_consistency.evaluated, 20u);
  outcome.report.tracking_consistency.anees = 9.0;
  const std::string text = summary(outcome.run, outcome.result, outcome.report, "runs/mine");
  EXPECT_NE(text.find("(ANEES 9.0 while tracking, 3 is ideal)\nnext        `azimuth check runs/mine` says"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.rfind("\nnext"), text.rfind('\n', text.size() - 2)) << "not the last line: " << text;
}

TEST(Summary, IsSilentOnWhatWasNot) {
  Replayed outcome = replayed(coloured_lab(1));
  outcome.run.truth.clear();
  outcome.run.landmarks.clear();
  const Rig rig = read_rig(outcome.run.rig_toml, "rig.toml").value();
  outcome.report = evaluate(replay_record(outcome.run, rig, "ekf", 1, outcome.result));
  const std::string text = summary(outcome.run, outcome.result, outcome.report);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_NE(text.find("no truth"), std::string::npos);
}

}  // namespace
}  // namespace azimuth
