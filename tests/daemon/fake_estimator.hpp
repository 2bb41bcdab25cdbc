#pragma once
// A fast, predictable and deterministic estimator: the pose is the odometry, and a landmark lies at a fixed distance
// along the last bearing to it.

#include <atomic>
#include <cmath>
#include <functional>

#include "slam/estimator/estimator.hpp"

namespace azimuth::test {

class FakeEstimator final : public Estimator {
 public:
  /// Called at the start of every update, on the estimator's thread.
  using OnUpdate = std::function<void(const BearingSet&)>;

  explicit FakeEstimator(OnUpdate on_update = {}) : on_update_(std::move(on_update)) {}

  void predict(const Motion& motion) override {
    pose_ = pose_ * motion.T_start_end;
    covariance_ += motion.covariance;
  }

  void update(const BearingSet& observations) override {
    if (on_update_) on_update_(observations);
    for (const Bearing& bearing : observations.bearings) see(bearing);
    covariance_ *= 0.9;
  }

  void estimate(Estimate& out) const override {
    write_pose(pose_, out);
    out.landmarks = landmarks_;
  }

  void look_ahead(const Motion& motion, Estimate& out) const override { write_pose(pose_ * motion.T_start_end, out); }

 private:
  static constexpr double kDistance_m = 4.0;

  void see(const Bearing& bearing) {
    ++accepted_;
    const double direction_rad = pose_.heading_rad + bearing.azimuth_rad;
    const Eigen::Vector2d p_map_m =
        pose_.position() + kDistance_m * Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad));
    for (LandmarkEstimate& landmark : landmarks_) {
      if (landmark.identity != bearing.identity) continue;
      landmark.p_map_landmark_m = p_map_m;
      return;
    }
    LandmarkEstimate landmark;
    landmark.id = static_cast<std::int64_t>(landmarks_.size());
    landmark.identity = bearing.identity;
    landmark.p_map_landmark_m = p_map_m;
    landmark.covariance_m2 = 0.04 * Eigen::Matrix2d::Identity();
    landmarks_.push_back(landmark);
  }

  void write_pose(const Pose2& T_map_body, Estimate& out) const {
    out.T_map_body = T_map_body;
    out.pose_covariance = covariance_;
    out.health = landmarks_.empty() ? Health::starting : Health::tracking;
    out.reason = landmarks_.empty() ? "no landmark yet" : "";
    out.association.accepted = accepted_;
    out.association.created = landmarks_.size();
  }

  OnUpdate on_update_;
  Pose2 pose_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  std::vector<LandmarkEstimate> landmarks_;
  std::uint64_t accepted_ = 0;
};

}  // namespace azimuth::test
