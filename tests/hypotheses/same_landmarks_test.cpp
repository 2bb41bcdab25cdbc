#include "slam/hypotheses/same_landmarks.hpp"

#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

constexpr double kAlphaSigma_rad = 0.02, kRhoSigma_per_m = 0.005;

SmoothedLandmark at(double x_m, double y_m, const Eigen::Vector2d& chart = Eigen::Vector2d::Zero()) {
  const Eigen::Vector2d away = Eigen::Vector2d(x_m, y_m) - chart;
  return {chart, std::atan2(away.y(), away.x()), 1.0 / away.norm()};
}

/// Landmarks with independent errors.
LandmarkBeliefs beliefs(std::vector<SmoothedLandmark> landmarks) {
  LandmarkBeliefs result{std::move(landmarks), {}};
  const auto rows = static_cast<Eigen::Index>(2 * result.landmarks.size());
  result.covariance = Eigen::MatrixXd::Zero(rows, rows);
  for (Eigen::Index i = 0; i < rows; i += 2) {
    result.covariance(i, i) = kAlphaSigma_rad * kAlphaSigma_rad;
    result.covariance(i + 1, i + 1) = kRhoSigma_per_m * kRhoSigma_per_m;
  }
  return result;
}

SameLandmarksSettings same_settings() {
  SameLandmarksSettings settings;
  settings.log_detection = std::log(0.8);
  settings.log_new = std::log(0.4);
  return settings;
}

using Pairs = std::vector<LandmarkPair>;

TEST(SameLandmarks, OnePlaceSeenFromTwoChartsIsOne) {
  const Pairs possible{{0, 1}};
  EXPECT_EQ(same_landmarks(beliefs({at(3, 1), at(3.02, 1.01, {4, -1})}), possible, same_settings()), possible);
}

TEST(SameLandmarks, PlacesApartAreTwo) {
  const Pairs possible{{0, 1}};
  EXPECT_TRUE(same_landmarks(beliefs({at(3, 1), at(3, 2)}), possible, same_settings()).empty());
}

TEST(SameLandmarks, WhatMayBeAnywhereIsNotClear) {
  const Pairs possible{{0, 1}};
  LandmarkBeliefs vague = beliefs({at(3, 1), at(3, 1.01)});
  vague.covariance.bottomRightCorner<2, 2>() *= 2500.0;
  EXPECT_TRUE(same_landmarks(vague, possible, same_settings()).empty());
}

TEST(SameLandmarks, TwoRivalsLeaveItOpenUnlessTheyCouldBeOne) {
  const LandmarkBeliefs three = beliefs({at(3, 1), at(3.05, 1.05), at(3.02, 1.02)});
  EXPECT_TRUE(same_landmarks(three, Pairs{{0, 2}, {1, 2}}, same_settings()).empty());
  // All three may be the same landmark.
  EXPECT_EQ(same_landmarks(three, Pairs{{0, 1}, {0, 2}, {1, 2}}, same_settings()).size(), 2U);
}

TEST(SameLandmarks, APairThatIsClearMakesOthersClear) {
  // Two new landmarks share an error of 0.25 m. The unambiguous pair determines this error, and the other pair follows.
  LandmarkBeliefs shifted = beliefs({at(3, 0), at(0, 3), at(0.5, 3.5), at(3.25, 0.25), at(0.25, 3.25)});
  const Pairs possible{{0, 3}, {1, 4}, {2, 4}};
  const auto shift = [&](std::size_t i) -> Eigen::Matrix2d { return shifted.landmarks[i].p_by_chart().inverse(); };
  Eigen::MatrixXd by_shift = Eigen::MatrixXd::Zero(10, 2);
  by_shift.block<2, 2>(6, 0) = shift(3);
  by_shift.block<2, 2>(8, 0) = shift(4);
  shifted.covariance += 0.0625 * by_shift * by_shift.transpose();
  const Pairs same = same_landmarks(shifted, possible, same_settings());
  ASSERT_EQ(same.size(), 2U);
  EXPECT_EQ(same[0], (LandmarkPair{0, 3}));
  EXPECT_EQ(same[1], (LandmarkPair{1, 4}));
}

}  // namespace
}  // namespace azimuth
