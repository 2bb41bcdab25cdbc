#pragma once
// A generated run, a circle among landmarks with known identities, and its replay without threads.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "daemon/pipeline/played_source.hpp"
#include "slam/estimator/estimate_digest.hpp"
#include "slam/estimator/estimator_stage.hpp"

namespace azimuth::test {

inline constexpr char kSmallRig[] = "front_end = \"bearings\"\n[camera]\nsigma_bearing_rad = 0.02\nidentities = true\n";

/// 10 odometry readings and 4 bearing sets per second, with 6 bearings each.
inline Recording small_recording(double duration_s) {
  constexpr double kSpeed_m_per_s = 0.5, kRadius_m = 3.0, kLandmarks = 6;
  const auto pose_at = [](double t_s) {
    const double angle_rad = kSpeed_m_per_s * t_s / kRadius_m;
    return Pose2{kRadius_m * std::sin(angle_rad), kRadius_m * (1.0 - std::cos(angle_rad)), wrap(angle_rad)};
  };
  Recording recording;
  for (int i = 0; 0.1 * i <= duration_s; ++i) {
    OdometryReading reading;
    reading.stamp = stamp_from_us(100'000 * std::int64_t{i});
    reading.sequence = static_cast<std::uint64_t>(i);
    reading.T_odom_body = pose_at(0.1 * i);
    recording.odometry.push_back(reading);
  }
  for (int i = 0; 0.25 * i + 0.03 <= duration_s; ++i) {
    const double t_s = 0.25 * i + 0.03;
    const Pose2 T_body_world = inverse(pose_at(t_s));
    BearingSet set;
    set.stamp = stamp_from_us(250'000 * std::int64_t{i} + 30'000);
    set.sequence = static_cast<std::uint64_t>(i);
    for (int landmark = 0; landmark < kLandmarks; ++landmark) {
      const double angle_rad = 2.0 * kPi * landmark / kLandmarks;
      const Eigen::Vector2d p_body =
          T_body_world * Eigen::Vector2d(6.0 * std::cos(angle_rad), 3.0 + 6.0 * std::sin(angle_rad));
      Bearing bearing;
      bearing.azimuth_rad = std::atan2(p_body.y(), p_body.x());
      bearing.identity = landmark;
      set.bearings.push_back(bearing);
    }
    recording.bearings.push_back(std::move(set));
  }
  return recording;
}

/// The only source of a pipeline, which plays `recording`.
inline std::vector<std::unique_ptr<Source>> played(Recording recording, double speed) {
  std::vector<std::unique_ptr<Source>> sources;
  sources.push_back(std::make_unique<PlayedSource>(std::move(recording), speed));
  return sources;
}

/// The result of a run without threads.
struct Replayed {
  std::vector<Estimate> estimates;
  EstimateDigest digest;
};

inline Replayed replay(Recording recording, std::unique_ptr<Estimator> estimator, const Rig& rig = {}) {
  Replayed replayed;
  RunPlayer player(std::move(recording), 0.0);
  EstimatorStage stage(std::move(estimator), rig, {});
  Estimate estimate;
  const auto advance = [&] {
    while (stage.advance(estimate)) {
      replayed.digest.add(estimate);
      replayed.estimates.push_back(estimate);
    }
  };
  for (; !player.over(); player.advance()) {
    const RunPlayer::Sample sample = player.peek();
    if (sample.odometry) stage.add(*sample.odometry);
    if (sample.bearings) stage.add(*sample.bearings);
    advance();
  }
  stage.finish();
  advance();
  return replayed;
}

}  // namespace azimuth::test
