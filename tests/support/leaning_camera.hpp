#pragma once
// Drives with a tilted camera.

#include <algorithm>
#include <cmath>
#include <map>

#include "slam/camera/make_camera.hpp"
#include "slam/geometry/random.hpp"
#include "tests/support/drive_of.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth::test {

inline const CameraModel kUpright({{320.0, 240.0}, 1.0, -1, -kPi / 2.0}, ParabolicMirror{140.0});

inline Rig rig_of_images(const Run& run) {
  Rig rig = rig_of_run(run);
  rig.front_end = FrontEnd::colour;
  rig.camera.model = ParabolicMirrorRig{.horizon_radius_px = 140.0};
  rig.camera.image.centre_px = {320.0, 240.0};
  rig.camera.image.azimuth_offset_rad = -kPi / 2.0;
  return rig;
}

/// The run seen through a tilted camera, with landmarks up to `highest_m` above or below it. The bearings are computed
/// without knowledge of the tilt.
inline Run seen_leaning(Run run, const CameraTilt& tilt, double highest_m) {
  const CameraModel camera(kUpright.axes(), kUpright.profile(), tilt);
  RandomNumbers<Xoshiro> random{Xoshiro(7)};
  std::map<Identity, double> height_m;
  for (const TrueLandmark& landmark : run.landmarks)
    height_m[landmark.identity] = highest_m * (2.0 * random.uniform() - 1.0);
  for (BearingSet& set : run.bearings) {
    const auto at = std::ranges::lower_bound(run.truth, set.stamp, {}, &TruthPose::stamp);
    const Pose2& T_world_body = (at == run.truth.end() ? run.truth.back() : *at).T_world_body;
    for (Bearing& bearing : set.bearings) {
      const auto landmark = std::ranges::find(run.landmarks, bearing.identity, &TrueLandmark::identity);
      if (landmark == run.landmarks.end()) continue;
      const double distance_m = (Eigen::Vector2d(landmark->x_m, landmark->y_m) - T_world_body.position()).norm();
      const auto pixel =
          camera.pixel(Direction{bearing.azimuth_rad, std::atan2(height_m[landmark->identity], distance_m)});
      const PolarPixel seen = kUpright.axes().polar(*pixel);
      bearing.azimuth_rad = seen.azimuth_rad;
      bearing.radius_px = seen.radius_px;
    }
  }
  return run;
}

/// A lab run with bearings as precise as those from images.
inline Run driven_with_good_images(std::uint64_t seed) {
  Scenario scenario = lab(seed, 2);
  scenario.sensor.sigma_bearing_rad = 0.005;
  return simulated_run(scenario);
}

}  // namespace azimuth::test
