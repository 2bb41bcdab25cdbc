#pragma once
// A robot on the x axis that sees landmarks which are not mapped yet.

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "slam/planar/candidates.hpp"

namespace azimuth::test::candidate {

inline constexpr double kSigma_rad = 0.01;

inline Motion straight_on(double distance_m) {
  Motion motion;
  motion.T_start_end.x_m = distance_m;
  motion.covariance.diagonal() << 4e-4, 1e-4, 1e-4;
  motion.covariance *= distance_m;
  motion.path_m = distance_m;
  return motion;
}

inline EkfSettings settings_with(const std::function<void(EkfSettings&)>& change) {
  EkfSettings settings;
  settings.delayed.min_clone_baseline_m = 0.0;
  change(settings);
  return settings;
}

inline CameraRig camera() {
  CameraRig rig;
  rig.sigma_bearing_rad = kSigma_rad;
  return rig;
}

using Landmarks = std::vector<Eigen::Vector2d>;  // the index is the identity

/// A filter whose robot drives along the x axis and sees landmarks without error.
struct Drive {
  explicit Drive(const EkfSettings& settings) : candidates(settings, camera()) {}

  void go(double distance_m) { ekf.predict(straight_on(distance_m)); }

  /// Observes an image that contains these landmarks, all unmapped.
  void look(const Landmarks& landmarks, const std::vector<Identity>& seen) {
    std::vector<Bearing> bearings;
    for (const Identity identity : seen) bearings.push_back(bearing_of(landmarks, identity));
    candidates.observe(ekf, bearings);
  }
  Bearing bearing_of(const Landmarks& landmarks, Identity identity) const {
    const Eigen::Vector2d from_robot = landmarks[static_cast<std::size_t>(identity)] - ekf.state().position(0);
    Bearing bearing;
    bearing.azimuth_rad = wrap(std::atan2(from_robot.y(), from_robot.x()) - ekf.state().pose().heading_rad);
    bearing.identity = identity;
    return bearing;
  }

  std::size_t clones() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(candidates.clones(), [](const Candidates::Clone& clone) { return clone.block != 0; }));
  }
  std::size_t sightings(Identity identity) const {
    for (const Candidate& candidate : candidates.candidates())
      if (candidate.identity == identity) return candidate.count;
    return 0;
  }

  BearingEkf ekf{BearingEkfSettings{}};
  Candidates candidates;
};

/// The clones' counts of users must match the candidates' bearings after any sequence of operations.
inline void expect_consistent(const Drive& drive) {
  std::vector<int> users(drive.candidates.clones().size(), 0);
  std::set<Identity> identities;
  for (const Candidate& candidate : drive.candidates.candidates()) {
    EXPECT_TRUE(identities.insert(candidate.identity).second) << "identity " << candidate.identity << " twice";
    EXPECT_GT(candidate.count, 0u);
    for (const Candidate::Bearing& bearing : candidate.seen()) {
      ASSERT_GE(bearing.clone, 0) << "a bearing was not cloned";
      ++users.at(static_cast<std::size_t>(bearing.clone));
    }
  }
  for (std::size_t slot = 0; slot < users.size(); ++slot) {
    const Candidates::Clone& clone = drive.candidates.clones()[slot];
    EXPECT_EQ(clone.users, users[slot]);
    EXPECT_EQ(clone.block != 0, users[slot] > 0);
  }
}

inline const Landmarks kOne{{3.0, 2.0}};

}  // namespace azimuth::test::candidate
