#include <Eigen/Cholesky>
#include <algorithm>
#include <gmock/gmock.h>
#include <map>
#include <numbers>
#include <random>

#include "slam/hypotheses/conditioned_association.hpp"
#include "tests/hypotheses/known_but_for_heading.hpp"

namespace azimuth {
namespace {

using testing::ElementsAre;

constexpr double kSigmaBearing_rad = 0.02;

/// Landmarks are known exactly; the heading has the standard deviation `sigma_heading_rad`.
PoseAndLandmarks known_exactly(const std::vector<double>& azimuths, double sigma_heading_rad) {
  return known_but_for_heading(azimuths, sigma_heading_rad, 1e-12);
}

std::vector<NamelessSighting> seen_at(const std::vector<double>& azimuths) {
  std::vector<NamelessSighting> sightings;
  for (const double azimuth : azimuths) sightings.push_back({azimuth, kSigmaBearing_rad});
  return sightings;
}

ConditionedAssociationSettings wide_gate() {
  ConditionedAssociationSettings settings;
  settings.gate_chi2 = 100.0;
  return settings;
}

std::vector<int> jointly(const std::vector<double>& landmarks, double sigma_heading_rad,
                         const std::vector<double>& bearings, const ConditionedAssociationSettings& settings) {
  const std::vector<NamelessSighting> sightings = seen_at(bearings);
  return associate_jointly(ImageReading(known_exactly(landmarks, sigma_heading_rad), sightings, settings), settings);
}

TEST(JointAssociation, TwoBearingsThatAgreeOutweighOneThatIsNearer) {
  // The robot has turned by 0.13 rad more than odometry says, and a third landmark lies 0.16 rad beside the first one.
  const std::vector<double> landmarks{0.0, 1.0, -0.16}, bearings{-0.13, 0.87};
  EXPECT_THAT(jointly(landmarks, 0.05, bearings, wide_gate()), ElementsAre(0, 1));
  EXPECT_THAT(jointly(landmarks, 0.05, {-0.13}, wide_gate()), ElementsAre(2)) << "nothing agrees with the first one";
  const std::vector<NamelessSighting> sightings = seen_at(bearings);
  EXPECT_THAT(associate_conditioned(known_exactly(landmarks, 0.05), sightings, wide_gate()), ElementsAre(0, 1));
}

TEST(JointAssociation, ALandmarkThatShouldBeSeenSpeaksForABearing) {
  // The bearing is 3 standard deviations off: it counts as clutter, unless missing the landmark would be unlikely.
  ConditionedAssociationSettings settings = wide_gate();
  settings.new_landmark_bonus = 0.0;
  settings.min_margin = 1.0;
  const double off_rad = 3.0 * kSigmaBearing_rad;
  settings.scene.detection_probability = 0.99;
  EXPECT_THAT(jointly({0.0}, 1e-6, {off_rad}, settings), ElementsAre(0));
  settings.scene.range_m = 4.0;  // the landmark lies at the edge of the range, so missing it is no evidence
  EXPECT_THAT(jointly({0.0}, 1e-6, {off_rad}, settings), ElementsAre(-1));
}

TEST(JointAssociation, WhatIsOutOfViewIsNotMissed) {
  ConditionedAssociationSettings settings = wide_gate();
  settings.new_landmark_bonus = 0.0;
  settings.min_margin = 1.0;
  settings.scene.detection_probability = 0.99;
  settings.scene.field_of_view_rad = 2.0;
  const double off_rad = 3.0 * kSigmaBearing_rad;
  EXPECT_THAT(jointly({0.5}, 1e-6, {0.5 + off_rad}, settings), ElementsAre(0));
  EXPECT_THAT(jointly({1.1}, 1e-6, {1.1 + off_rad}, settings), ElementsAre(-1));
}

TEST(JointAssociation, TwoWaysThatAreAsLikelyAreNone) {
  // A turn to the left and one to the right explain both bearings equally well.
  EXPECT_THAT(jointly({0.1, 1.1, -0.1, 0.9}, 0.15, {0.0, 1.0}, wide_gate()), ElementsAre(-1, -1));
  // A third bearing decides.
  EXPECT_THAT(jointly({0.1, 1.1, -0.1, 0.9, 2.1}, 0.15, {0.0, 1.0, 2.0}, wide_gate()), ElementsAre(0, 1, 4));
}

TEST(JointAssociation, NothingSeenAndNothingMappedAreAnswered) {
  EXPECT_THAT(jointly({0.0}, 0.1, {}, wide_gate()), ElementsAre());
  EXPECT_THAT(jointly({}, 0.1, {0.0, 1.0}, wide_gate()), ElementsAre(-1, -1));
}

/// The odds of each pair, by summing over all readings of an image with the joint density of all its bearings.
class AllReadings {
 public:
  AllReadings(std::vector<double> landmarks, double sigma_heading_rad, std::vector<double> bearings,
              const ConditionedAssociationSettings& settings)
      : landmarks_(std::move(landmarks)),
        bearings_(std::move(bearings)),
        sigma_heading_rad_(sigma_heading_rad),
        settings_(settings),
        landmark_of_(bearings_.size(), -1) {
    enumerate(0);
  }

  double log_odds(std::size_t bearing, int landmark) const {
    const auto found = weight_of_pair_.find({bearing, landmark});
    const double weight = found == weight_of_pair_.end() ? 0.0 : found->second;
    return std::log(weight / std::max(sum_ - weight, 1e-300));
  }

 private:
  void enumerate(std::size_t bearing) {
    if (bearing == bearings_.size()) {
      weigh();
      return;
    }
    for (int j = -1; j < static_cast<int>(landmarks_.size()); ++j) {
      if (j >= 0 && std::find(landmark_of_.begin(), landmark_of_.end(), j) != landmark_of_.end()) continue;
      landmark_of_[bearing] = j;
      enumerate(bearing + 1);
    }
    landmark_of_[bearing] = -1;
  }

  void weigh() {
    std::vector<double> off;
    for (std::size_t i = 0; i < bearings_.size(); ++i)
      if (landmark_of_[i] >= 0)
        off.push_back(wrap(bearings_[i] - landmarks_[static_cast<std::size_t>(landmark_of_[i])]));
    const auto n = static_cast<Eigen::Index>(off.size());
    const double p_D = settings_.scene.detection_probability;
    double log_weight = static_cast<double>(bearings_.size() - off.size()) * settings_.log_nothing() +
                        static_cast<double>(landmarks_.size() - off.size()) * std::log(1.0 - p_D) +
                        static_cast<double>(off.size()) * std::log(p_D);
    if (n > 0) {
      const Eigen::Map<const Eigen::VectorXd> nu(off.data(), n);
      Eigen::MatrixXd S = Eigen::MatrixXd::Constant(n, n, sigma_heading_rad_ * sigma_heading_rad_);
      S.diagonal().array() += kSigmaBearing_rad * kSigmaBearing_rad;
      log_weight -= 0.5 * (nu.dot(S.llt().solve(nu)) + std::log((2.0 * std::numbers::pi * S).determinant()));
    }
    const double weight = std::exp(log_weight);
    sum_ += weight;
    for (std::size_t i = 0; i < bearings_.size(); ++i) weight_of_pair_[{i, landmark_of_[i]}] += weight;
  }

  std::vector<double> landmarks_, bearings_;
  double sigma_heading_rad_;
  ConditionedAssociationSettings settings_;
  std::vector<int> landmark_of_;
  std::map<std::pair<std::size_t, int>, double> weight_of_pair_;
  double sum_ = 0.0;
};

/// 300 images of five random landmarks, with missed detections and clutter.
TEST(JointAssociation, TakesThePairsThatAllReadingsTogetherCallClear) {
  const ConditionedAssociationSettings settings = wide_gate();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> anywhere(-std::numbers::pi, std::numbers::pi), share(0.0, 1.0);
  std::normal_distribution<double> gaussian;
  constexpr double kSigmaHeading_rad = 0.12;
  int clear = 0, unclear = 0;
  for (int image = 0; image < 300; ++image) {
    std::vector<double> landmarks, bearings;
    for (int j = 0; j < 5; ++j) landmarks.push_back(anywhere(random));
    const double turned_rad = kSigmaHeading_rad * gaussian(random);
    for (const double azimuth : landmarks)
      if (share(random) < 0.75) bearings.push_back(wrap(azimuth - turned_rad + kSigmaBearing_rad * gaussian(random)));
    if (share(random) < 0.5) bearings.push_back(anywhere(random));
    const AllReadings all(landmarks, kSigmaHeading_rad, bearings, settings);
    const std::vector<int> landmark_of = jointly(landmarks, kSigmaHeading_rad, bearings, settings);
    for (std::size_t i = 0; i < bearings.size(); ++i)
      for (int j = 0; j < 5; ++j) {
        const double surplus = all.log_odds(i, j) - settings.min_margin;
        // the search drops unlikely readings, whose weight may be as large as this
        if (std::abs(surplus) < 0.05) continue;
        ++(surplus > 0.0 ? clear : unclear);
        EXPECT_EQ(landmark_of[i] == j, surplus > 0.0) << "image " << image << ", ahead by " << surplus;
      }
  }
  EXPECT_GT(clear, 500);
  EXPECT_GT(unclear, 2000);
}

}  // namespace
}  // namespace azimuth
