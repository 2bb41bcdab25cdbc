#include "slam/planar/relocation.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

PoseBelief belief(double sigma_m, double sigma_rad) {
  const Eigen::Vector3d sigma(sigma_m, sigma_m, sigma_rad);
  return {{1.0, 2.0, 3.0}, sigma.array().square().matrix().asDiagonal()};
}

Resection found(const Pose2& T_map_body, double chi2) {
  Resection found;
  found.T_map_body = T_map_body;
  found.covariance = Eigen::Vector3d(0.05, 0.05, 0.01).array().square().matrix().asDiagonal();
  found.chi2 = chi2;
  return found;
}

TEST(Relocation, IsThoughtOfWhenThePoseIsVagueOrMostBearingsContradictIt) {
  const RelocationSettings settings;
  EXPECT_FALSE(is_in_doubt(belief(0.1, 0.05), 0, 10, settings));
  EXPECT_TRUE(is_in_doubt(belief(1.01 * settings.beyond_m, 0.05), 0, 10, settings));
  EXPECT_TRUE(is_in_doubt(belief(0.1, 1.01 * settings.beyond_rad), 0, 10, settings));
  EXPECT_FALSE(is_in_doubt(belief(0.1, 0.05), 5, 10, settings)) << "half is not most";
  EXPECT_TRUE(is_in_doubt(belief(0.1, 0.05), 6, 10, settings));
  EXPECT_FALSE(is_in_doubt(belief(0.1, 0.05), 2, 2, settings)) << "two landmarks may have been moved";
}

TEST(Relocation, ReplacesAVagueBeliefAndAContradictedOne) {
  const RelocationSettings settings;
  const PoseBelief vague = belief(2.0, 1.0), sure = belief(0.1, 0.05);
  EXPECT_TRUE(replaces(found(vague.T_map_body, 1.0), 6, vague, settings));
  EXPECT_FALSE(replaces(found(sure.T_map_body, 1.0), 6, sure, settings)) << "nothing is gained";
  EXPECT_TRUE(replaces(found({4.0, 2.0, 3.0}, 1.0), 6, sure, settings));
  EXPECT_TRUE(replaces(found({1.0, 2.0, -2.0}, 1.0), 6, sure, settings)) << "headings differ by the short way";
  EXPECT_FALSE(replaces(found({1.0, 2.0, 3.0 - 2.0 * kPi}, 1.0), 6, sure, settings)) << "the same heading";
}

TEST(Relocation, MustExplainTheImageAlone) {
  const RelocationSettings settings;
  const PoseBelief vague = belief(2.0, 1.0);
  EXPECT_FALSE(replaces(found(vague.T_map_body, 11.5), 6, vague, settings)) << "99 % of 3 degrees of freedom are 11.3";
  Resection ambiguous = found(vague.T_map_body, 1.0);
  ambiguous.rival_chi2 = 5.0;
  EXPECT_FALSE(replaces(ambiguous, 6, vague, settings));
  ambiguous.rival_chi2 = 100.0;
  EXPECT_TRUE(replaces(ambiguous, 6, vague, settings));
}

}  // namespace
}  // namespace azimuth
