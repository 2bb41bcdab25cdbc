#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "slam/estimator/centre_settings.hpp"
#include "slam/estimator/restartable_estimator.hpp"

namespace azimuth {

/// An EKF that rebuilds its map once the centre of the camera's image is known.
///
/// While the centre may be off by many pixels, bearings and the first landmarks are linearised about a wrong centre.
/// That error is a function of the azimuth, the same in every image and at every landmark, so it does not average out.
/// Charging it as noise (curvature.hpp) makes the filter too cautious in most drives and overconfident in some. The
/// first metres of a drive determine the centre well, however. A second filter then starts from the first filter's
/// initial state, with the centre found so far, and is given the same motions and bearings; from then on it replaces
/// the first filter.
///
/// The second filter's prior of the centre has kBeginWider times the standard deviation that the first filter had to
/// reach, so that using the same images twice adds at most a ninth to the information. Its prior of the tilt is the
/// first filter's. The effects of tilt and centre are much alike; "the centre" here means the centre given the
/// estimated tilt.
///
/// Below lamps whose heights differ from the initial guess, the second filter also linearises about their usual height.
/// The prior standard deviation of that height is at least 15 % of it, since dozens of lamps must tell less of the
/// scale than the odometer does. When the second filter moves the centre by more than the standard deviation that the
/// first filter had to reach, the filter is restarted once more with the new centre: below lamps a first filter may be
/// wrong by ten times its standard deviation.
///
/// Samples are kept until the second start, except those taken while the robot stands still. The first filter stays
/// when there are too many samples, when the robot is lost, or when the second filter needs more landmarks to explain
/// the same bearings.
///
/// Thread contract: thread-bound. No call allocates once samples are no longer kept and the map has stopped growing.
class SecondStart final : public Estimator {
 public:
  static constexpr double kBeginWider = 3.0;
  static constexpr std::size_t kMostSamples = 512;

  /// Whether a second start can help: the centre's initial standard deviation is larger than that of a second filter.
  static bool is_of_use(const CentreSettings& centre) {
    return centre.second_start_px > 0.0 && centre.sigma_px > kBeginWider * centre.second_start_px;
  }

  /// Makes the first filter (without an argument) or the second one.
  using Begin = std::function<std::unique_ptr<RestartableEstimator>(const std::optional<Restart>&)>;

  /// The second filter starts when the centre's standard deviation is below `begin_again_px` along each axis, and
  /// either the views differ or no more samples can be kept.
  SecondStart(Begin begin, double begin_again_px);

  bool odometry_begins(bool goes_on) override { return running_->odometry_begins(goes_on); }
  void predict(const Motion& motion) override;
  void update(const BearingSet& bearings) override;
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override { running_->expect(out); }
  std::optional<CameraErrors> camera_errors() const override { return running_->camera_errors(); }
  RigFinding rig_finding() const override { return running_->rig_finding(); }
  bool save_map(MapSnapshot& out) const override { return running_->save_map(out); }

  const RestartableEstimator& running() const { return *running_; }
  /// Whether the second filter is running.
  bool began_again() const { return began_again_; }
  std::size_t samples_kept() const { return samples_.size(); }

 private:
  using Sample = std::variant<Motion, BearingSet>;

  void begin_again(const CameraErrors& camera);
  std::unique_ptr<RestartableEstimator> replayed(const Restart& beginning) const;
  void keep_no_more();

  Begin begin_;
  double begin_again_px_;
  std::unique_ptr<RestartableEstimator> running_;
  bool keeps_ = true, began_again_ = false;
  bool moved_ = true;  ///< The robot moved since the last set that was kept
  std::vector<Sample> samples_;
  AssociationCounts before_;  ///< Counts of the first filter that the second filter does not include
};

}  // namespace azimuth
