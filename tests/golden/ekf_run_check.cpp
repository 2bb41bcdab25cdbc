// Runs whole steps of mathematics I.2 through the estimator, with the state in the golden file's order: robot, clones
// from the newest to the oldest, landmarks by identity.

#include <algorithm>
#include <gtest/gtest.h>

#include "slam/planar/ekf_estimator.hpp"
#include "tests/golden/checks.hpp"
#include "tests/golden/state_building.hpp"

namespace azimuth::golden {
namespace {

/// The plain filter of mathematics part I: identities are known, and there are no gates, noise floors or safeguards.
EkfSettings plain_settings(double kl_threshold) {
  EkfSettings settings;
  settings.initialisation = Initialisation::delayed;
  settings.update.invariant = false;
  settings.update.charge_curvature = false;
  settings.update.consider_scales = false;
  settings.update.max_iterations = 1;
  settings.gates.chi2 = 0.0;
  settings.gates.joint_probability = 0.0;
  settings.delayed.gate_remaining = false;
  settings.recover_after_rejections = 0;
  settings.thinning_s = 0.0;
  settings.delayed.expire_after_clones = 0;
  settings.delayed.min_clone_baseline_m = 0.0;
  settings.delayed.min_observations = 2;
  settings.delayed.best_pair = true;
  settings.delayed.kl_threshold = kl_threshold;
  settings.delayed.kl_samples = 1000;
  return settings;
}

Rig rig_of(const nlohmann::json& input) {
  Rig rig;
  rig.camera.identities = true;
  rig.camera.sigma_bearing_rad = degrees_to_rad(input.at("sigma_deg").get<double>());
  rig.odometry.floor_distance_m = 0.0;
  rig.odometry.floor_rotation_rad = 0.0;
  return rig;
}

Motion motion_of(const nlohmann::json& u, const nlohmann::json& input) {
  MotionNoise noise;
  noise.lambda_distance_m = input.at("lambda_d");
  noise.lambda_rotation_rad = input.at("lambda_a");
  const Control control{u.at(0), u.at(1), u.at(2)};
  Motion motion;
  append(motion, control, control, noise);
  return motion;
}

BearingSet bearings_of(const nlohmann::json& step) {
  BearingSet set;
  set.sequence = step.at("k");
  set.stamp = stamp_from_us(1'000'000 * step.at("k").get<std::int64_t>());
  for (const auto& z : step.at("Z")) {
    Bearing& bearing = set.bearings.emplace_back();
    bearing.identity = z.at(0);
    bearing.azimuth_rad = z.at(1);
  }
  return set;
}

/// The blocks of the state with the golden file's names, in its order.
struct NamedEntries {
  std::vector<std::string> names{"v"};
  std::vector<Index> entries{0, 1, 2};

  void add(const std::string& name, Index block, Index size) {
    names.push_back(name);
    for (Index i = 0; i < size; ++i) entries.push_back(block + i);
  }
};

NamedEntries named_entries(const EkfEstimator& estimator) {
  std::vector<Candidates::Clone> clones(estimator.candidates().clones().begin(), estimator.candidates().clones().end());
  std::erase_if(clones, [](const auto& clone) { return clone.users == 0; });
  std::ranges::sort(clones, std::greater{}, &Candidates::Clone::image);
  std::vector<EkfEstimator::Landmark> landmarks(estimator.landmarks().begin(), estimator.landmarks().end());
  std::ranges::sort(landmarks, std::less{}, &EkfEstimator::Landmark::identity);

  NamedEntries named;
  for (const auto& clone : clones) named.add("clone@" + std::to_string(clone.image), clone.block, 3);
  for (const auto& landmark : landmarks) named.add("lm" + std::to_string(landmark.identity), landmark.block, 2);
  return named;
}

void check_created(const EkfEstimator& estimator, const nlohmann::json& expected, double tolerance) {
  std::vector<Candidates::Created> created(estimator.candidates().created().begin(),
                                           estimator.candidates().created().end());
  std::ranges::sort(created, std::less{}, &Candidates::Created::identity);
  ASSERT_EQ(created.size(), expected.size());
  for (std::size_t i = 0; i < created.size(); ++i) {
    EXPECT_EQ(created[i].identity, expected.at(i).at("id").get<Identity>());
    EXPECT_EQ(created[i].sightings, expected.at(i).at("nobs").get<std::uint64_t>());
    expect_near(created[i].relative_entropy, expected.at(i).at("kl"), tolerance, "relative entropy");
  }
}

void check_step(const EkfEstimator& estimator, const nlohmann::json& expected, double tolerance) {
  SCOPED_TRACE("step " + expected.at("k").dump());
  const NamedEntries named = named_entries(estimator);
  ASSERT_EQ(named.names, expected.at("order").get<std::vector<std::string>>());
  const JointState& state = estimator.filter().state();
  expect_near(mean_of(state, named.entries), to_vector(expected.at("x")), tolerance, "x");
  expect_near(covariance_of(state, named.entries), to_matrix(expected.at("P")), tolerance, "P");
  check_created(estimator, expected.at("inits"), tolerance);
}

}  // namespace

void check_ekf_run(const GoldenCase& golden) {
  const auto& input = golden.input;
  EkfEstimator estimator(rig_of(input), plain_settings(input.at("kl_thr")));
  // The estimator starts at the origin without uncertainty, so an exact motion brings it to x0.
  ASSERT_TRUE(to_matrix(input.at("P0")).isZero());
  Motion to_start;
  to_start.T_start_end = to_pose(input.at("x0"));
  estimator.predict(to_start);

  ASSERT_EQ(input.at("steps").size(), golden.expected.size());
  for (std::size_t k = 0; k < golden.expected.size(); ++k) {
    const auto& step = input.at("steps").at(k);
    if (!step.at("u").is_null()) estimator.predict(motion_of(step.at("u"), input));
    estimator.update(bearings_of(step));
    check_step(estimator, golden.expected.at(k), golden.tolerance);
    if (testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace azimuth::golden
