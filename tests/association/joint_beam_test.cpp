// The beam search on images with so many possible associations that branch and bound reaches its node limit.

#include "slam/association/joint_beam.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "slam/association/joint_compatibility.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

/// Landmarks of one kind with independent position errors, seen by a robot with an uncertain heading.
struct Crowd {
  std::vector<double> predicted_rad;
  Eigen::MatrixXd covariance;
  std::vector<MeasuredAzimuth> measured;

  Crowd(RandomDraws& draws, int landmarks, double sigma_landmark_rad, double sigma_heading_rad) {
    const double heading_error_rad = draws.normal(sigma_heading_rad), sigma_rad = 0.002;
    covariance = Eigen::MatrixXd::Identity(landmarks, landmarks) * sigma_landmark_rad * sigma_landmark_rad;
    covariance.array() += sigma_heading_rad * sigma_heading_rad;
    for (int l = 0; l < landmarks; ++l) {
      predicted_rad.push_back(-1.0 + 2.0 * l / landmarks + draws.uniform(-0.02, 0.02));
      const double seen_rad = predicted_rad.back() + heading_error_rad + draws.normal(sigma_landmark_rad);
      measured.push_back({seen_rad + draws.normal(sigma_rad), sigma_rad * sigma_rad});
    }
  }

  /// The log likelihood of the best hypothesis when the exact search may visit `max_nodes` nodes.
  double best(int max_nodes, std::size_t beam_width = 256) const {
    JointCompatibility association;
    std::vector<Pairing> pairings;
    association.associate(measured, {predicted_rad, covariance},
                          {.rival_log_ratio = 0.0, .max_nodes = max_nodes, .beam_width = beam_width}, pairings);
    return association.log_likelihood(0);
  }
};

TEST(JointBeam, FindsWhatTheExactSearchFinds) {
  RandomDraws draws(5);
  int same = 0;
  constexpr int kProblems = 60, kEnough = 10'000'000;
  for (int i = 0; i < kProblems; ++i) {
    const Crowd crowd(draws, draws.integer(1, 8), draws.uniform(0.02, 0.1), draws.uniform(0.0, 0.1));
    const double exact = crowd.best(kEnough), beam = crowd.best(0);
    EXPECT_LE(beam, exact + 1e-9) << i;
    same += beam > exact - 1e-9 ? 1 : 0;
  }
  EXPECT_GE(same, kProblems * 9 / 10);
}

TEST(JointBeam, ExplainsCrowdsBetterThanASearchThatGivesUp) {
  RandomDraws draws(6);
  int better = 0, worse = 0;
  double gained = 0.0;
  for (int i = 0; i < 20; ++i) {
    const Crowd crowd(draws, 17, 0.06, 0.1);
    const double alone = crowd.best(20000, 1), with_beam = crowd.best(20000);
    better += with_beam > alone + 1e-9 ? 1 : 0;
    worse += with_beam < alone - 1e-9 ? 1 : 0;
    gained += with_beam - alone;
  }
  EXPECT_GE(better, 10);
  EXPECT_EQ(worse, 0);
  EXPECT_GT(gained / 20, 1.0);
}

TEST(JointBeam, KeepsHypothesesInTheirOrderAndWithinTheRatioAskedFor) {
  RandomDraws draws(7);
  const Crowd crowd(draws, 14, 0.06, 0.1);
  JointCompatibility association;
  std::vector<Pairing> pairings;
  association.associate(crowd.measured, {crowd.predicted_rad, crowd.covariance},
                        {.rival_log_ratio = 0.0, .keep_log_ratio = 3.0, .max_nodes = 100}, pairings);
  ASSERT_GT(association.kept(), 1u);
  for (std::size_t i = 0; i < association.kept(); ++i) {
    EXPECT_EQ(association.choices(i).size(), crowd.measured.size());
    if (i > 0) {
      EXPECT_LE(association.log_likelihood(i), association.log_likelihood(i - 1));
      EXPECT_FALSE(std::ranges::equal(association.choices(i), association.choices(i - 1)));
    }
  }
  for (std::size_t m = 0; m < pairings.size(); ++m) EXPECT_EQ(pairings[m].landmark, association.choices(0)[m]);
}

TEST(JointCompatibility, TakesTheConfidenceOfEachCall) {
  // GIVEN one landmark with a bearing 3 standard deviations off, which a test at 99 % refuses
  const std::vector<double> predicted{0.0};
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(1, 1);
  const std::vector<MeasuredAzimuth> measured{{0.03, 1e-4}};
  JointCompatibility association;
  std::vector<Pairing> pairings;
  association.associate(measured, {predicted, covariance}, {.individual_chi2 = 16.0, .joint_probability = 0.99},
                        pairings);
  ASSERT_EQ(pairings.front().landmark, kNoLandmark);
  // WHEN the same workspace is asked for a test that lets it pass THEN it passes
  association.associate(
      measured, {predicted, covariance},
      {.individual_chi2 = 16.0, .joint_probability = 0.9999, .new_density_per_rad = 0.01, .rival_log_ratio = 0.0},
      pairings);
  EXPECT_EQ(pairings.front().landmark, 0);
}

}  // namespace
}  // namespace azimuth
