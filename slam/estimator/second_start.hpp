#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "slam/estimator/begins_twice.hpp"
#include "slam/estimator/centre_settings.hpp"

namespace azimuth {

/// An EKF of a camera whose image's centre is not known yet: it begins twice.
///
/// While the centre may be off by many pixels, bearings and the first landmarks are linearised about the wrong one.
/// That error is a function of the azimuth, the same in every image and at every landmark, so it does not average
/// out; charging it as noise (curvature.hpp) makes the filter too careful in most drives and not careful enough in
/// some. The first metres tell the centre well, however. Once they have, a second filter begins where the first one
/// did, with the centre where it was found, and is given the same motions and bearings; from then on it is the only
/// one. Its prior of the centre is kBeginWider times wider than what was found, so that what the same images told
/// counts a ninth more at most; that of the tilt, which looks much like the centre, is the first filter's, and "the
/// centre" here is where it is if the tilt is as found. Below lamps that hang elsewhere than was guessed, their usual
/// height is linearised about as well, and believed to no more than a seventh of it: of dozens of lamps, that tells
/// less of the scale than odometers do. Where that moves the centre again, by as much as it was to be known, it begins
/// once more from there: below lamps a first filter may be wrong by ten times what it claims.
///
/// Samples are kept until then, those of a robot that stands still left out; when they become too many, or the robot
/// is lost, the first filter stays. So it does when the second one needs more landmarks to explain the same bearings.
///
/// Thread contract: thread-bound. No call allocates once the second filter runs, or samples are no longer kept, and the
/// map has stopped growing.
class SecondStart final : public Estimator {
 public:
  static constexpr double kBeginWider = 3.0;
  static constexpr std::size_t kMostSamples = 512;

  /// Whether there is anything to gain: a centre less certain at first than a second filter would begin with.
  static bool is_of_use(const CentreSettings& centre) {
    return centre.second_start_px > 0.0 && centre.sigma_px > kBeginWider * centre.second_start_px;
  }

  /// Makes the first filter, of nothing, and the second one.
  using Begin = std::function<std::unique_ptr<BeginsTwice>(const std::optional<SecondBeginning>&)>;

  /// The second filter begins when the centre's standard deviation is below `begin_again_px` along each axis, and views
  /// differ or no more samples can be kept.
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

  const BeginsTwice& running() const { return *running_; }
  /// The second filter runs.
  bool began_again() const { return began_again_; }
  std::size_t samples_kept() const { return samples_.size(); }

 private:
  using Sample = std::variant<Motion, BearingSet>;

  void begin_again(const CameraErrors& camera);
  std::unique_ptr<BeginsTwice> replayed(const SecondBeginning& beginning) const;
  void keep_no_more();

  Begin begin_;
  double begin_again_px_;
  std::unique_ptr<BeginsTwice> running_;
  bool keeps_ = true, began_again_ = false;
  bool moved_ = true;  ///< since the last set that was kept
  std::vector<Sample> samples_;
  AssociationCounts before_;  ///< what the first filter counted and the second did not
};

}  // namespace azimuth
