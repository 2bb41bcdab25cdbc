// Association of directions with lamps that all look alike: the conditioning of a hypothesis on its first pairs, the
// choice of pairs, and the directions that stay unpaired.

#include "slam/association/direction_matching.hpp"

#include <Eigen/LU>
#include <cstdio>
#include <gtest/gtest.h>

#include "slam/geometry/pose2.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

constexpr double kHeight_m = 4.7, kSigma_rad = 0.008, kMapSigma_m = 0.05;
constexpr int kClutter = -1;

TangentDirection direction_at(const Eigen::Vector2d& m, RandomDraws* draws = nullptr) {
  const double zenith_rad = std::atan(m.norm()), sigma_azimuth_rad = kSigma_rad / std::max(0.02, std::sin(zenith_rad));
  const double azimuth_noise = draws != nullptr ? draws->normal(sigma_azimuth_rad) : 0.0;
  const double zenith_noise = draws != nullptr ? draws->normal(kSigma_rad) : 0.0;
  return {std::atan2(m.y(), m.x()) + azimuth_noise,
          zenith_rad + zenith_noise,
          {sigma_azimuth_rad * sigma_azimuth_rad, kSigma_rad * kSigma_rad}};
}

/// A grid of lamps, measured from the true pose and predicted from the believed pose.
struct Scene {
  std::vector<Eigen::Vector2d> lamps, predicted;
  Eigen::MatrixXd covariance;
  std::vector<MeasuredDirection> measured;
  std::vector<int> lamp_of;

  PredictedOffsets offsets() const { return {predicted, covariance}; }
};

Eigen::Vector2d offset_from(const Pose2& pose, const Eigen::Vector2d& lamp) {
  return (inverse(pose) * lamp) / kHeight_m;
}

Scene scene_at(const Pose2& truth, double sigma_m, double sigma_rad, RandomDraws& draws) {
  Scene scene;
  for (const double x : {-13.5, -4.5, 4.5, 13.5})
    for (const double y : {-6.75, -2.25, 2.25, 6.75}) scene.lamps.emplace_back(x, y);
  const Pose2 believed{truth.x_m + draws.normal(sigma_m), truth.y_m + draws.normal(sigma_m),
                       wrap(truth.heading_rad + draws.normal(sigma_rad))};
  const auto n = static_cast<Eigen::Index>(scene.lamps.size());
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * n, 3);
  const double c = std::cos(believed.heading_rad), s = std::sin(believed.heading_rad);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector2d& lamp = scene.lamps[static_cast<std::size_t>(i)];
    const Eigen::Vector2d m = offset_from(believed, lamp);
    scene.predicted.push_back(m);
    J.block<2, 2>(2 * i, 0) << -c / kHeight_m, -s / kHeight_m, s / kHeight_m, -c / kHeight_m;
    J.block<2, 1>(2 * i, 2) << m.y(), -m.x();
    const Eigen::Vector2d seen_at =
        offset_from(truth, lamp + Eigen::Vector2d{draws.normal(kMapSigma_m), draws.normal(kMapSigma_m)});
    if (seen_at.norm() > 2.7 || !draws.chance(0.85)) continue;
    scene.measured.push_back({direction_at(seen_at, &draws)});
    scene.lamp_of.push_back(static_cast<int>(i));
  }
  const Eigen::Vector3d variances(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad);
  scene.covariance = J * variances.asDiagonal() * J.transpose();
  scene.covariance.diagonal().array() += std::pow(kMapSigma_m / kHeight_m, 2);
  if (draws.chance(0.4)) {
    scene.measured.push_back({direction_at(draws.point(2.0))});
    scene.lamp_of.push_back(kClutter);
  }
  return scene;
}

TEST(DirectionHypothesis, SaysOfTheRestWhatTheDenseConditionalDoes) {
  RandomDraws draws(81);
  for (int trial = 0; trial < 30; ++trial) {
    const Scene scene = scene_at({1.0, 2.0, 0.5}, 0.3, 0.05, draws);
    if (scene.lamp_of.size() < 4) continue;
    std::vector<DirectionPair> pairs;
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(8, scene.covariance.rows());
    Eigen::VectorXd nu(8), R(8);
    for (int k = 0; k < 4; ++k) {
      const TangentDirection& seen = scene.measured[static_cast<std::size_t>(k)].seen;
      const int lamp = scene.lamp_of[static_cast<std::size_t>(k)];
      const auto residual = *seen.against(scene.predicted[static_cast<std::size_t>(lamp)]);
      D.block<2, 2>(2 * k, 2 * lamp) = residual.by_offset;
      nu.segment<2>(2 * k) = residual.innovation;
      R.segment<2>(2 * k) = seen.variance();
      pairs.push_back(
          {.seen = k, .landmark = lamp, .innovation = residual.innovation, .by_offset = residual.by_offset});
    }
    const Eigen::MatrixXd S = D * scene.covariance * D.transpose() + Eigen::MatrixXd(R.asDiagonal());
    DirectionHypothesis hypothesis;
    const PredictedOffsets predicted = scene.offsets();
    hypothesis.start(predicted, 4);
    for (int k = 0; k < 4; ++k) {
      DirectionPair& pair = pairs[static_cast<std::size_t>(k)];
      pair.S = S.block<2, 2>(2 * k, 2 * k);
      pair.judge();
    }
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(hypothesis.believe(pairs[static_cast<std::size_t>(k)]));
    const Eigen::MatrixXd gain = S.block<2, 6>(6, 0) * S.topLeftCorner<6, 6>().inverse();
    const DirectionPair given = hypothesis.given(pairs[3]);
    EXPECT_LT((given.innovation - (nu.tail<2>() - gain * nu.head<6>())).norm(), 1e-9);
    EXPECT_LT((given.S - (S.block<2, 2>(6, 6) - gain * S.block<6, 2>(0, 6))).norm(), 1e-12);
    EXPECT_TRUE(hypothesis.believe(pairs[3]));
    EXPECT_NEAR(hypothesis.distance2(), nu.dot(S.inverse() * nu), 1e-6);
    EXPECT_NEAR(hypothesis.log_likelihood(),
                -0.5 * (nu.dot(S.inverse() * nu) + std::log(S.determinant()) + 8.0 * std::log(2.0 * kPi)), 1e-6);
  }
}

struct Tally {
  int images = 0, all_right = 0, wrong = 0, paired = 0, possible = 0;
};
Tally tally(double sigma_m, double sigma_rad, unsigned seed, const DirectionGates& gates = {}, int images = 200) {
  RandomDraws draws(seed);
  DirectionMatching matching;
  std::vector<DirectionMatch> matches;
  Tally result;
  for (int trial = 0; trial < images; ++trial) {
    const Scene scene = scene_at({draws.uniform(-8.0, 8.0), draws.uniform(-6.0, 6.0), draws.uniform(-kPi, kPi)},
                                 sigma_m, sigma_rad, draws);
    matching.match(scene.measured, scene.offsets(), gates, matches);
    int wrong = 0;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const bool paired = matches[i].fate == DirectionFate::paired;
      wrong += paired && matches[i].landmark != scene.lamp_of[i] ? 1 : 0;
      result.paired += paired ? 1 : 0;
      result.possible += scene.lamp_of[i] != kClutter ? 1 : 0;
    }
    ++result.images;
    result.wrong += wrong;
    result.all_right += wrong == 0 ? 1 : 0;
  }
  std::printf("pose off by %.2f m, %.1f deg: %d of %d images without a wrong pairing; %d of %d lamps paired\n", sigma_m,
              rad_to_degrees(sigma_rad), result.all_right, result.images, result.paired, result.possible);
  return result;
}

TEST(DirectionMatching, PairsWhatAnUncertainPoseLeavesPossible) {
  const Tally sure = tally(0.1, 0.01, 1, {}, 500), unsure = tally(1.0, degrees_to_rad(6.0), 2, {}, 500);
  EXPECT_GE(sure.all_right, 0.99 * sure.images);
  EXPECT_GE(sure.paired, 0.95 * sure.possible);
  EXPECT_GE(unsure.all_right, 0.97 * unsure.images) << "nearest neighbours: 0.48 (mathematics part IV)";
  EXPECT_GE(unsure.paired, 0.80 * unsure.possible) << "six degrees are beyond what is linear: some are left alone";
}

TEST(DirectionMatching, KeepsToTheFirstAssignmentWhenItMayWorkNoLonger) {
  DirectionGates first_only, no_longer;
  first_only.max_hypotheses = 0;
  no_longer.max_operations = 0;
  const double sigma_rad = degrees_to_rad(6.0);
  const Tally first = tally(1.0, sigma_rad, 2, first_only), bounded = tally(1.0, sigma_rad, 2, no_longer);
  EXPECT_EQ(bounded.all_right, first.all_right);
  EXPECT_EQ(bounded.paired, first.paired);
  EXPECT_LT(bounded.all_right, tally(1.0, sigma_rad, 2).all_right);
}

TEST(DirectionMatching, StartsNothingBesideALampThatIsSeen) {
  const std::vector<Eigen::Vector2d> predicted{{0.5, 0.0}};
  const Eigen::MatrixXd covariance = 1e-6 * Eigen::MatrixXd::Identity(2, 2);
  const std::vector<MeasuredDirection> measured{
      {direction_at({0.51, 0.0})}, {direction_at({0.5, 0.0})}, {direction_at({-0.9, 0.3})}};
  std::vector<DirectionMatch> matches;
  DirectionMatching matching;
  DirectionGates gates;
  gates.rival_log_ratio = 0.0;
  matching.match(measured, {predicted, covariance}, gates, matches);
  EXPECT_EQ(matches[0].fate, DirectionFate::refused);
  EXPECT_EQ(matches[1].fate, DirectionFate::paired);
  EXPECT_EQ(matches[1].landmark, 0);
  EXPECT_EQ(matches[2].fate, DirectionFate::fresh);
}

TEST(DirectionMatching, LeavesAloneWhatTwoLampsExplainEquallyWell) {
  const std::vector<Eigen::Vector2d> predicted{{0.05, 0.0}, {-0.05, 0.0}};
  const Eigen::MatrixXd covariance = 4e-3 * Eigen::MatrixXd::Identity(4, 4);
  std::vector<DirectionMatch> matches;
  DirectionMatching().match(std::vector<MeasuredDirection>{{direction_at({0.0, 0.0})}}, {predicted, covariance}, {},
                            matches);
  EXPECT_EQ(matches[0].fate, DirectionFate::ambiguous);
  DirectionGates gates;
  gates.rival_log_ratio = 0.0;
  DirectionMatching().match(std::vector<MeasuredDirection>{{direction_at({0.01, 0.0})}}, {predicted, covariance}, gates,
                            matches);
  EXPECT_EQ(matches[0].fate, DirectionFate::paired);
  EXPECT_EQ(matches[0].landmark, 0);
}

TEST(DirectionMatching, NamesForbidAndNothingElse) {
  const std::vector<Eigen::Vector2d> predicted{{0.5, 0.0}, {0.52, 0.0}};
  const std::vector<Identity> names{7, 9};
  const Eigen::MatrixXd covariance = 1e-3 * Eigen::MatrixXd::Identity(4, 4);
  std::vector<DirectionMatch> matches;
  const std::vector<MeasuredDirection> measured{{direction_at({0.5, 0.0}), 9}, {direction_at({0.5, 0.0}), 3}};
  DirectionMatching().match(measured, {predicted, covariance, names}, {}, matches);
  EXPECT_EQ(matches[0].landmark, 1);
  EXPECT_EQ(matches[1].fate, DirectionFate::fresh);
}

TEST(DirectionMatching, OfNothingIsNothing) {
  std::vector<DirectionMatch> matches(3);
  DirectionMatching().match({}, {{}, Eigen::MatrixXd(0, 0)}, {}, matches);
  EXPECT_TRUE(matches.empty());
  DirectionMatching().match(std::vector<MeasuredDirection>{{direction_at({0.5, 0.0})}}, {{}, Eigen::MatrixXd(0, 0)}, {},
                            matches);
  EXPECT_EQ(matches[0].fate, DirectionFate::fresh);
}

TEST(DirectionMatching, DoesNotAllocateAfterTheLargestImage) {
  RandomDraws draws(85);
  DirectionMatching matching;
  std::vector<DirectionMatch> matches;
  std::vector<Scene> scenes;
  for (int i = 0; i < 20; ++i) scenes.push_back(scene_at({0.0, 0.0, 0.3 * i}, 0.5, 0.05, draws));
  for (const Scene& scene : scenes) matching.match(scene.measured, scene.offsets(), {}, matches);
  const std::size_t before = allocations();
  for (const Scene& scene : scenes) matching.match(scene.measured, scene.offsets(), {}, matches);
  EXPECT_EQ(allocations(), before);
}

TEST(JointTestOfPairs, LeavesOutTheBlockThatFitsLeast) {
  RandomDraws draws(86);
  JointTest test;
  std::vector<std::uint8_t> accepted;
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXd S = draws.covariance(10, 1.0);
    const Eigen::MatrixXd L = S.llt().matrixL();
    Eigen::VectorXd nu = 0.5 * L * draws.normals(10);
    const int wrong = draws.integer(0, 4);
    nu.segment<2>(2 * wrong) += Eigen::Vector2d(12.0, -9.0);
    test.prune({nu.data(), 10}, 2, S, 0.99, accepted);
    ASSERT_EQ(accepted.size(), 5u);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(accepted[static_cast<std::size_t>(i)], i == wrong ? 0 : 1) << i;
  }
}

}  // namespace
}  // namespace azimuth
