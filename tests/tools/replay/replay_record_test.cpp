#include "tools/replay/replay_record.hpp"

#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "slam/estimator/make_estimator.hpp"
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
  EXPECT_LT((picture.truth[0].back() - picture.estimate.back()).norm(), 0.5);
  EXPECT_EQ(picture.odometry.front(), picture.estimate.front());
  EXPECT_EQ(picture.true_landmarks.size(), 24u);
  EXPECT_EQ(picture.landmarks.size(), outcome.result.last.landmarks.size());
  EXPECT_FALSE(picture.poses.empty());
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
  for (const char* topic : {"run", "estimator", "position", "odometry", "consistency", "by nearest", "by identity",
                            "bearings", "step time", "digest"})
    EXPECT_NE(text.find(topic), std::string::npos) << topic;
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("not used"), std::string::npos);
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
