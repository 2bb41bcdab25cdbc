#include "slam/association/joint_compatibility.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <span>

#include "slam/geometry/angle.hpp"
#include "tests/association/all_hypotheses.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

/// Landmarks crowded into a part of the view, seen by a robot with an uncertain heading, so that gates overlap.
struct Problem {
  std::vector<double> predicted_rad;
  Eigen::MatrixXd covariance;
  std::vector<MeasuredAzimuth> measured;
  std::vector<Kind> kinds = {};  // of the landmarks

  PredictedAzimuths predicted() const { return {predicted_rad, covariance, kinds}; }
};

Problem random_problem(RandomDraws& draws, int landmarks, int measurements, double centre_rad = 0.0) {
  const double half_view_rad = draws.uniform(0.1, 2.5);
  const double sigma_rad = draws.uniform(0.003, 0.03), sigma_heading_rad = draws.uniform(0.0, 0.15);
  Problem problem;
  for (int l = 0; l < landmarks; ++l)
    problem.predicted_rad.push_back(wrap(centre_rad + draws.uniform(-half_view_rad, half_view_rad)));
  const int sorts = draws.integer(1, 3);  // kAnyKind included: the kind of some is unknown
  for (int l = 0; l < landmarks; ++l) problem.kinds.push_back(draws.integer(kAnyKind, sorts));
  // A heading error moves all predicted azimuths by the same angle.
  problem.covariance = draws.covariance(landmarks, draws.uniform(0.002, 0.03));
  problem.covariance.array() += sigma_heading_rad * sigma_heading_rad;
  const double heading_error_rad = draws.normal(sigma_heading_rad);
  for (int m = 0; m < measurements; ++m) {
    const bool clutter = landmarks == 0 || draws.chance(0.25);
    const double true_rad =
        clutter ? centre_rad + draws.uniform(-half_view_rad, half_view_rad)
                : problem.predicted_rad[static_cast<std::size_t>(draws.integer(0, landmarks - 1))] + heading_error_rad;
    problem.measured.push_back(
        {wrap(true_rad + draws.normal(sigma_rad)), sigma_rad * sigma_rad, draws.integer(kAnyKind, sorts)});
  }
  return problem;
}

std::vector<Pairing> associate(const Problem& problem, const JointGates& gates) {
  JointCompatibility association;
  std::vector<Pairing> pairings;
  association.associate(problem.measured, problem.predicted(), gates, pairings);
  return pairings;
}

/// The pairing of each measurement by the likeliest hypotheses: ambiguous if a rival within the likelihood ratio
/// disagrees with the best hypothesis.
std::vector<Pairing> believed(std::span<const JointHypothesis> hypotheses, double rival_log_ratio) {
  hypotheses = hypotheses.first(std::min(hypotheses.size(), JointCompatibility::kMostHypotheses));
  const JointHypothesis& best = hypotheses.front();
  std::vector<Pairing> pairings;
  for (std::size_t m = 0; m < best.landmark.size(); ++m) {
    Pairing& pairing = pairings.emplace_back();
    for (const JointHypothesis& rival : hypotheses)
      if (rival.log_likelihood > best.log_likelihood - rival_log_ratio && rival.landmark[m] != best.landmark[m])
        pairing.ambiguous = true;
    if (!pairing.ambiguous) pairing.landmark = best.landmark[m];
  }
  return pairings;
}

void expect_same(const std::vector<Pairing>& pairings, const std::vector<Pairing>& expected) {
  ASSERT_EQ(pairings.size(), expected.size());
  for (std::size_t m = 0; m < pairings.size(); ++m) {
    EXPECT_EQ(pairings[m].landmark, expected[m].landmark) << "bearing " << m;
    EXPECT_EQ(pairings[m].ambiguous, expected[m].ambiguous) << "bearing " << m;
  }
}

class AgainstAllHypotheses : public testing::TestWithParam<double> {};

TEST_P(AgainstAllHypotheses, FindsTheLikeliestAndItsRivals) {
  RandomDraws draws(21);
  JointGates gates;
  gates.rival_log_ratio = GetParam();
  gates.max_nodes = 1000000;
  std::size_t hypotheses_tried = 0, ambiguous = 0, paired = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE(trial);
    gates.new_density_per_rad = draws.uniform(0.05, 5.0);
    const double centre_rad = trial % 2 == 0 ? 0.0 : kPi;  // every other problem straddles the wrap at pi
    const int landmarks = draws.integer(0, 4), measurements = draws.integer(0, 4);
    const Problem problem = random_problem(draws, landmarks, measurements, centre_rad);
    const auto hypotheses = all_hypotheses(problem.measured, problem.predicted(), gates);
    const std::vector<Pairing> expected = believed(hypotheses, gates.rival_log_ratio);
    expect_same(associate(problem, gates), expected);
    hypotheses_tried += hypotheses.size();
    for (const Pairing& pairing : expected) {
      ambiguous += pairing.ambiguous ? 1 : 0;
      paired += pairing.landmark != kNoLandmark ? 1 : 0;
    }
  }
  EXPECT_GT(hypotheses_tried, 3000u);  // the problems are not trivial
  EXPECT_GT(paired, 30u);
  EXPECT_EQ(ambiguous > 0, gates.rival_log_ratio > 0.0);
}

INSTANTIATE_TEST_SUITE_P(RivalLogRatio, AgainstAllHypotheses, testing::Values(0.0, 0.5, 3.0), test::PrintedName());

TEST(JointCompatibility, UsesEachLandmarkAtMostOnce) {
  RandomDraws draws(22);
  for (int trial = 0; trial < 100; ++trial) {
    const int landmarks = draws.integer(1, 8), measurements = draws.integer(4, 12);
    const Problem problem = random_problem(draws, landmarks, measurements);
    std::multiset<int> used;
    for (const Pairing& pairing : associate(problem, {}))
      if (pairing.landmark != kNoLandmark) used.insert(pairing.landmark);
    for (const int landmark : used) EXPECT_EQ(used.count(landmark), 1u);
  }
}

TEST(JointCompatibility, KeepsNothingOfTheCallBefore) {
  RandomDraws draws(23);
  JointCompatibility reused;
  std::vector<Pairing> pairings;
  for (int trial = 0; trial < 100; ++trial) {
    const int landmarks = draws.integer(0, 6), measurements = draws.integer(0, 6);
    const Problem problem = random_problem(draws, landmarks, measurements);
    reused.associate(problem.measured, problem.predicted(), {}, pairings);
    expect_same(pairings, associate(problem, {}));
  }
}

TEST(JointCompatibility, OneBearingInTheWideGateOfALostRobotProvesNothing) {
  Problem problem{{0.3}, Eigen::MatrixXd::Constant(1, 1, 1.0), {{0.4, 4e-4}}};
  JointGates gates;
  gates.new_density_per_rad = 0.5;  // the landmark's own density is at most 0.4
  EXPECT_EQ(associate(problem, gates).front().landmark, kNoLandmark);

  // Three landmarks turned by the same angle confirm each other.
  problem = {{0.3, 1.0, -0.8}, Eigen::MatrixXd::Constant(3, 3, 1.0), {{0.4, 4e-4}, {1.1, 4e-4}, {-0.7, 4e-4}}};
  gates.rival_log_ratio = 0.0;
  const auto pairings = associate(problem, gates);
  for (int m = 0; m < 3; ++m) EXPECT_EQ(pairings[static_cast<std::size_t>(m)].landmark, m);
}

TEST(JointCompatibility, PrefersTheJointExplanationToTheNearestNeighbour) {
  // The heading is off by 0.1 rad, so the left landmark's bearing is nearest to the right landmark's prediction.
  const Problem problem{
      {0.0, 0.1}, Eigen::Matrix2d::Constant(0.01) + 1e-6 * Eigen::Matrix2d::Identity(), {{0.1, 1e-5}, {0.2, 1e-5}}};
  JointGates gates;
  gates.rival_log_ratio = 0.0;
  const auto pairings = associate(problem, gates);
  EXPECT_EQ(pairings[0].landmark, 0);
  EXPECT_EQ(pairings[1].landmark, 1);
}

TEST(JointCompatibility, BearingBetweenTwinsIsAmbiguousAndTheOthersAreNot) {
  const Problem problem{{0.0, 0.02, 1.0}, 1e-4 * Eigen::Matrix3d::Identity(), {{0.0101, 1e-4}, {1.0, 1e-4}}};
  JointGates gates;
  gates.rival_log_ratio = 3.0;
  const auto careful = associate(problem, gates);
  EXPECT_TRUE(careful[0].ambiguous);
  EXPECT_EQ(careful[0].landmark, kNoLandmark);
  EXPECT_FALSE(careful[1].ambiguous);
  EXPECT_EQ(careful[1].landmark, 2);

  gates.rival_log_ratio = 0.0;
  const auto bold = associate(problem, gates);
  EXPECT_FALSE(bold[0].ambiguous);
  EXPECT_EQ(bold[0].landmark, 1);
}

TEST(JointCompatibility, NodeLimitBoundsTheSearchAndLeavesALegalAnswer) {
  // Thirty bearings and thirty landmarks lie in one another's gates: too many hypotheses for an exhaustive search.
  constexpr int kMany = 30;
  RandomDraws draws(24);
  Problem problem;
  problem.covariance = draws.covariance(kMany, 0.02);
  problem.covariance.array() += 0.04;
  for (int i = 0; i < kMany; ++i) {
    problem.predicted_rad.push_back(draws.uniform(-0.05, 0.05));
    problem.measured.push_back({draws.uniform(-0.05, 0.05), 1e-4});
  }
  JointGates gates;
  for (const int max_nodes : {1, 100, 20000}) {
    gates.max_nodes = max_nodes;
    gates.rival_log_ratio = 0.0;
    const auto pairings = associate(problem, gates);  // the search ends
    std::set<int> used;
    for (const Pairing& pairing : pairings)
      if (pairing.landmark != kNoLandmark) {
        EXPECT_TRUE(used.insert(pairing.landmark).second);
      }
    EXPECT_GT(used.size(), 0u);
  }
}

TEST(JointCompatibility, AKindNeverExplainsAnother) {
  const Eigen::MatrixXd certain = 1e-6 * Eigen::MatrixXd::Identity(2, 2);
  const std::vector<double> predicted_rad{0.5, 0.52};
  const std::vector<Kind> kinds{7, 8};
  const std::vector<MeasuredAzimuth> measured{{0.5, 1e-4, 8}, {0.52, 1e-4, 9}};
  JointCompatibility association;
  std::vector<Pairing> pairings;
  association.associate(measured, {predicted_rad, certain, kinds}, {}, pairings);
  EXPECT_EQ(pairings[0].landmark, 1) << "the nearer one is of another kind";
  EXPECT_EQ(pairings[1].landmark, kNoLandmark);
}

TEST(JointCompatibility, MoreNodesNeverGiveAWorseHypothesis) {
  RandomDraws draws(25);
  JointGates gates;
  gates.rival_log_ratio = 0.0;
  for (int trial = 0; trial < 50; ++trial) {
    const Problem problem = random_problem(draws, 4, 4);
    const auto hypotheses = all_hypotheses(problem.measured, problem.predicted(), gates);
    const auto likelihood_of = [&](const std::vector<Pairing>& pairings) {
      for (const JointHypothesis& hypothesis : hypotheses)
        if (std::equal(pairings.begin(), pairings.end(), hypothesis.landmark.begin(),
                       [](const Pairing& pairing, int landmark) { return pairing.landmark == landmark; }))
          return hypothesis.log_likelihood;
      ADD_FAILURE() << "not a legal hypothesis";
      return 0.0;
    };
    double last = -1e300;
    for (const int max_nodes : {1, 4, 16, 64, 256, 4096}) {
      gates.max_nodes = max_nodes;
      const double now = likelihood_of(associate(problem, gates));
      EXPECT_GE(now, last);
      last = now;
    }
    EXPECT_EQ(last, hypotheses.front().log_likelihood);
  }
}

}  // namespace
}  // namespace azimuth
