#pragma once
// A simulated drive among identical landmarks, with odometry and bearings.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/hypotheses/hypothesis.hpp"

namespace azimuth {

inline constexpr double kSigma_rad = 0.02;

/// Landmarks on both sides of a circular path of 8 m in diameter, see on_circle().
inline std::vector<Eigen::Vector2d> ring_of_landmarks() {
  return {{2.0, 2.2},  {-2.1, 1.4},  {0.3, -2.3},  {6.1, 0.5}, {3.2, 5.4},
          {-3.0, 5.0}, {-6.0, -1.0}, {-2.5, -5.6}, {3.9, -4.6}};
}

inline Pose2 on_circle(int image, double radius_m = 4.0, double step_rad = 0.2) {
  const double at = step_rad * image;
  return {radius_m * std::cos(at), radius_m * std::sin(at), wrap(at + 1.5707963267948966)};
}

/// Odometry and bearings with errors. The same seed gives the same numbers.
class NamelessWorld {
 public:
  explicit NamelessWorld(std::vector<Eigen::Vector2d> landmarks, unsigned seed = 1, double sigma_motion_rad = 0.01)
      : landmarks_(std::move(landmarks)), numbers_(seed), sigma_motion_rad_(sigma_motion_rad) {}

  static double sigma_motion_m() { return 0.02; }
  double sigma_motion_rad() const { return sigma_motion_rad_; }

  Motion motion(const Pose2& from, const Pose2& to) {
    Motion motion;
    motion.T_start_end = inverse(from) * to;
    motion.T_start_end.x_m += sigma_motion_m() * normal();
    motion.T_start_end.y_m += sigma_motion_m() * normal();
    motion.T_start_end.heading_rad = wrap(motion.T_start_end.heading_rad + sigma_motion_rad() * normal());
    motion.covariance.diagonal() << sigma_motion_m() * sigma_motion_m(), sigma_motion_m() * sigma_motion_m(),
        sigma_motion_rad() * sigma_motion_rad();
    motion.path_m = 0.8;
    return motion;
  }

  /// The bearings of all landmarks within the range, in the order of their azimuths. `names`, if given, receives the
  /// indices of the landmarks.
  std::vector<NamelessSighting> sightings(const Pose2& T, double range_m, std::vector<int>* names = nullptr) {
    std::vector<std::pair<double, int>> seen;
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      const Eigen::Vector2d away = landmarks_[i] - T.position();
      if (away.norm() > range_m) continue;
      const double azimuth = std::atan2(away.y(), away.x()) - T.heading_rad + kSigma_rad * normal();
      seen.emplace_back(wrap(azimuth), static_cast<int>(i));
    }
    std::sort(seen.begin(), seen.end());
    std::vector<NamelessSighting> result;
    for (const auto& [azimuth, name] : seen) {
      result.push_back({azimuth, kSigma_rad});
      if (names != nullptr) names->push_back(name);
    }
    return result;
  }

  double uniform() { return std::uniform_real_distribution<double>(-3.14159, 3.14159)(numbers_); }

 private:
  double normal() { return std::normal_distribution<double>()(numbers_); }
  std::vector<Eigen::Vector2d> landmarks_;
  std::mt19937_64 numbers_;
  double sigma_motion_rad_;
};

inline HypothesisSettings world_settings() {
  Scene scene;
  scene.sigma_bearing_rad = kSigma_rad;
  scene.range_m = 6.0;
  scene.detection_probability = 0.9;
  HypothesisSettings settings;
  settings.scene = scene;
  settings.costs = hypothesis_costs(scene, settings.smoother);
  return settings;
}

/// A hypothesis after `images` images on the circle.
inline Hypothesis driven(NamelessWorld& world, int images, std::vector<int>* names = nullptr,
                         const MemberSettings& member = {}) {
  Hypothesis hypothesis(world_settings(), member);
  hypothesis.begin(world.sightings(on_circle(0), 6.0, names));
  for (int i = 1; i < images; ++i)
    hypothesis.add_image(world.motion(on_circle(i - 1), on_circle(i)), world.sightings(on_circle(i), 6.0, names));
  return hypothesis;
}

}  // namespace azimuth
