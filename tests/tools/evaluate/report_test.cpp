#include "tools/evaluate/report.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/stamps.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::json;

/// Five seconds along a straight line. The estimate is 0.1 m off to alternate sides; odometry has a scale error.
ReplayRecord made_record() {
  ReplayRecord record;
  record.run = "made";
  record.estimator = "ekf";
  record.front_end = "bearings";
  record.seed = 7;
  for (int i = 0; i <= 10; ++i) {
    const double t_s = 0.5 * i, x_m = 2.0 * t_s, side_m = i % 2 == 0 ? 0.1 : -0.1;
    record.truth.push_back({at_s(t_s), {x_m, 0.0, 0.0}});
    record.raw_odometry.push_back({at_s(t_s), {1.5 * x_m, 0.0, 0.0}});
    EstimateRecord estimate{at_s(t_s), {x_m, side_m, 0.0}, Eigen::Matrix3d::Zero(), {1.2 * x_m, 0.0, 0.0}};
    estimate.covariance.diagonal() << 0.01, 0.04, 0.0025;
    record.estimates.push_back(estimate);
  }
  record.map = {{4, {3.0, 1.0}}};
  record.true_landmarks = {{4, {3.0, 1.2}}, {5, {50.0, 0.0}}};
  record.association = {90, 5, 1, {}};
  record.times.step_us = {10.0, 20.0, 30.0};
  record.peak_memory_mb = 12.5;
  return record;
}

std::set<std::string> keys(const Json& object) {
  std::set<std::string> names;
  for (const auto& [name, value] : object.items()) names.insert(name);
  return names;
}

void expect_keys(const Json& object, const std::set<std::string>& wanted) {
  const std::set<std::string> present = keys(object);
  for (const std::string& name : wanted) EXPECT_TRUE(present.contains(name)) << name;
}

TEST(Report, MapsOfNaturalFeaturesAreNotComparedWithTheTrueLandmarks) {
  ReplayRecord record = made_record();
  record.natural_features = true;
  const Json map = Json::parse(to_json(evaluate(record)))["map"];
  EXPECT_EQ(map["landmarks"], 1);
  EXPECT_EQ(map["true_landmarks"], 2);
  EXPECT_TRUE(map["matched"].is_null() && map["duplicates"].is_null() && map["rmse_m"].is_null());
  EXPECT_TRUE(map["by_identity"]["matched"].is_null());
  EXPECT_TRUE(map["settled"].is_null());
  record.settled_landmarks = 1;
  EXPECT_EQ(Json::parse(to_json(evaluate(record)))["map"]["settled"], 1);
}

TEST(Report, JudgesAHandMadeRun) {
  const Report report = evaluate(made_record());
  EXPECT_EQ(report.steps, 11u);
  EXPECT_EQ(report.position_m.count, 11u);
  EXPECT_NEAR(report.position_m.rmse, 0.1, 0.002);  // eleven alternating errors have a mean slightly off 0
  EXPECT_NEAR(report.heading_rad.max, 0.0, 1e-3);
  EXPECT_NEAR(report.odometry_m.max, 0.2 * 5.0, 1e-9);  // the path is 20 % too long and aligned at its middle
  EXPECT_NEAR(report.odometry_raw_m.max, 0.5 * 5.0, 1e-9);
  EXPECT_TRUE(report.two_sigma_final.isApprox(Eigen::Vector3d(0.2, 0.4, 0.1)));
  EXPECT_EQ(report.map.matched, 1u);
  EXPECT_NEAR(report.map.position_m.max, 0.2, 0.02);
  EXPECT_EQ(report.named_map.named, 1u);
  EXPECT_NEAR(report.named_map.position_m.max, report.map.position_m.max, 1e-12);
  EXPECT_DOUBLE_EQ(report.step.median_us, 20.0);
}

TEST(Report, CountsEstimatesWithoutTruth) {
  ReplayRecord record = made_record();
  record.truth.erase(record.truth.begin() + 3, record.truth.begin() + 7);  // a gap of 2.5 s
  const Report report = evaluate(record);
  EXPECT_EQ(report.position_m.count, 7u);
  EXPECT_EQ(Json::parse(to_json(report))["pose"]["without_truth"], 4);
}

TEST(Report, JsonHasEveryKeyOfTheDesign) {
  const Json json = Json::parse(to_json(evaluate(made_record())));
  expect_keys(json, {"run", "estimator", "front_end", "seed", "steps", "pose", "odometry_only", "map", "association",
                     "time_us", "peak_memory_mb"});
  expect_keys(json, {"health_over_time", "input_trouble", "incomplete"});
  EXPECT_TRUE(json["health_over_time"].is_null()) << "the record says nothing of it";
  expect_keys(json["pose"], {"rmse_m", "mean_m", "max_m", "final_m", "heading_rmse_rad", "heading_max_rad",
                             "two_sigma_final", "anees"});
  expect_keys(json["odometry_only"], {"rmse_m", "mean_m", "max_m", "final_m"});
  expect_keys(json["map"], {"landmarks", "matched", "mean_m", "rmse_m", "max_m", "duplicates"});
  expect_keys(json["association"], {"accepted", "rejected", "new", "wrong", "judged"});
  expect_keys(json["time_us"], {"detect", "update", "step"});
  for (const char* stage : {"detect", "update", "step"}) expect_keys(json["time_us"][stage], {"median", "p99", "max"});
  EXPECT_EQ(json["pose"]["two_sigma_final"].size(), 3u);
  EXPECT_EQ(json["seed"], 7);
  EXPECT_EQ(json["association"]["new"], 1);
}

TEST(Report, MapsWithHeightsAreJudgedInSpace) {
  ReplayRecord record = made_record();
  record.map[0].z_m = 6.5;
  record.true_landmarks[0].z_m = 6.0;
  const Json json = Json::parse(to_json(evaluate(record)));
  EXPECT_EQ(json["map"]["in_space"]["matched"], 1);
  EXPECT_NEAR(json["map"]["in_space"]["mean_m"], std::hypot(0.2, 0.5), 0.02);
  EXPECT_DOUBLE_EQ(json["map"]["in_space"]["height_mean_m"], 0.5);
  EXPECT_TRUE(Json::parse(to_json(evaluate(made_record())))["map"]["in_space"]["matched"].is_null());
}

TEST(Report, WhatWasNotMeasuredIsNull) {
  ReplayRecord record;
  record.run = "nothing";
  const std::string text = to_json(evaluate(record));
  EXPECT_EQ(text.find("nan"), std::string::npos);
  const Json json = Json::parse(text);
  EXPECT_TRUE(json["pose"]["rmse_m"].is_null());
  EXPECT_TRUE(json["pose"]["two_sigma_final"][0].is_null());
  EXPECT_TRUE(json["odometry_only"]["final_m"].is_null());
  EXPECT_TRUE(json["map"]["rmse_m"].is_null());
  EXPECT_TRUE(json["map"]["by_identity"]["matched"].is_null());
  EXPECT_TRUE(json["association"]["wrong"].is_null());
  EXPECT_TRUE(json["time_us"]["detect"]["median"].is_null());
  EXPECT_TRUE(json["peak_memory_mb"].is_null());
}

TEST(Report, SurvivesADivergedEstimate) {
  ReplayRecord record = made_record();
  record.estimates[4].T_map_body.x_m = INFINITY;
  record.estimates[4].covariance.setConstant(kNotMeasured);
  EXPECT_TRUE(Json::accept(to_json(evaluate(record))));
}

TEST(Report, SurvivesARunNameThatIsNotText) {
  ReplayRecord record = made_record();
  record.run = "caf\xe9";
  EXPECT_TRUE(Json::accept(to_json(evaluate(record))));
}

}  // namespace
}  // namespace azimuth
