#pragma once
#include <memory>
#include <vector>

#include "slam/estimator/estimator.hpp"

namespace azimuth {

/// Wraps an estimator and measures the time of update().
class TimedEstimator final : public Estimator {
 public:
  /// `update_us` receives the duration of each update() and must outlive this object.
  TimedEstimator(std::unique_ptr<Estimator> estimator, std::vector<double>& update_us);

  bool odometry_begins(bool goes_on) override { return estimator_->odometry_begins(goes_on); }
  void predict(const Motion& motion) override { estimator_->predict(motion); }
  void update(const BearingSet& observations) override;
  void estimate(Estimate& out) const override { estimator_->estimate(out); }
  void look_ahead(const Motion& motion, Estimate& out) const override { estimator_->look_ahead(motion, out); }
  void expect(std::vector<ExpectedBearing>& out) const override { estimator_->expect(out); }
  std::optional<CameraErrors> camera_errors() const override { return estimator_->camera_errors(); }
  RigFinding rig_finding() const override { return estimator_->rig_finding(); }
  bool save_map(MapSnapshot& out) const override { return estimator_->save_map(out); }
  bool write_past(std::vector<PastPose>& out) const override { return estimator_->write_past(out); }
  bool write_path(std::vector<PathPose>& out) const override { return estimator_->write_path(out); }
  void conclude() override { estimator_->conclude(); }

 private:
  std::unique_ptr<Estimator> estimator_;
  std::vector<double>& update_us_;
};

}  // namespace azimuth
