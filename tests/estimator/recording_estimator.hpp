#pragma once
// An estimator that only records the calls it receives, for tests of the stage around it.

#include <vector>

#include "slam/estimator/estimator.hpp"

namespace azimuth {

class RecordingEstimator final : public Estimator {
 public:
  struct Step {
    Motion motion;
    BearingSet set;
  };

  /// `steps` must outlive this object.
  explicit RecordingEstimator(std::vector<Step>& steps) : steps_(steps) {}

  void predict(const Motion& motion) override {
    T_map_body_ = T_map_body_ * motion.T_start_end;
    steps_.push_back({motion, {}});
  }
  void update(const BearingSet& observations) override { steps_.back().set = observations; }
  void estimate(Estimate& out) const override {
    out.T_map_body = T_map_body_;
    out.association = {};
    out.landmarks.emplace_back();
  }
  void look_ahead(const Motion& motion, Estimate& out) const override {
    out.T_map_body = T_map_body_ * motion.T_start_end;
  }

 private:
  std::vector<Step>& steps_;
  Pose2 T_map_body_;
};

}  // namespace azimuth
