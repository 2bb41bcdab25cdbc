#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "slam/ekf/rig_told.hpp"
#include "slam/ekf/saved_state.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/estimator/recognition_history.hpp"
#include "slam/estimator/restartable_estimator.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/estimator/rig_noise.hpp"
#include "slam/estimator/start_from_map.hpp"
#include "slam/geometry/index.hpp"
#include "slam/lost/lost_robot.hpp"

namespace azimuth {

/// Base of an estimator with one joint filter and a list of landmarks: start on a saved map, motion, search for a lost
/// robot, output of pose and health, and saving of the map. The derived class uses the images.
///
/// Thread contract: thread-bound.
template <class Filter, class Map>
class EkfOnMap : public RestartableEstimator {
 public:
  bool odometry_begins(bool goes_on) final {
    return start_decision_.odometry_begins(goes_on, [this](const StartPose& pose) { begin_at(pose); });
  }
  void predict(const Motion& motion) final {
    const Motion noisy = with_floors(motion, rig_.odometry);
    hear_of_rig();
    ekf_.predict(noisy);
    lost_.predict(noisy);
    recognition_.path_m += motion.path_m;
    velocity_ = motion.velocity_at_end;
  }
  RigFinding rig_finding() const final {
    RigFinding errors;
    const auto tell = [&](int which, std::optional<RigFinding::Value>& value) {
      if (told_.is_doubted(which)) value = {told_.mean(which), told_.sigma(which)};
    };
    tell(considered::yaw, errors.yaw_offset_rad);
    tell(considered::scale_turn, errors.scale_turn);
    tell(considered::drift, errors.drift_rad_per_m);
    tell(considered::lag, errors.lag_s);
    tell(considered::camera, errors.camera_ahead_m);
    tell(considered::camera + 1, errors.camera_left_m);
    if (const auto camera = ekf_.camera_errors(); is_tilted(camera, health_)) {
      errors.roll_rad = {camera->mean(2), std::sqrt(camera->covariance(2, 2))};
      errors.pitch_rad = {camera->mean(3), std::sqrt(camera->covariance(3, 3))};
    }
    return by_keys(rig_, errors, told_.mean(considered::scale_turn));
  }
  void look_ahead(const Motion& motion, Estimate& out) const final {
    write(moved(belief(), motion), recognition_.path_m + motion.path_m, out);
  }
  bool save_map(MapSnapshot& out) const override {
    out.clear();
    if (judged(ekf_.state().pose_covariance(), recognition_.path_m).health == Health::lost) return false;
    saver_.clear();
    list_saved(saver_);
    if (saver_.empty()) return false;
    saver_.write(ekf_.state(), ekf_.camera_entries(), out);
    out.T_map_body = belief().body();
    out.names = names_of(rig_);
    out.next_id = next_id();
    return true;
  }

  const Filter& filter() const { return ekf_; }
  std::optional<CameraErrors> camera_errors() const final { return ekf_.camera_errors(); }
  bool searching() const final { return lost_.is_searched_for(); }
  AssociationCounts counts() const final {
    AssociationCounts counts = counts_;
    counts.created = map_.created();
    counts.deleted = map_.deleted();
    return counts;
  }
  std::int64_t next_id() const final { return map_.next_id(); }

 protected:
  EkfOnMap(const Rig& rig, Filter filter, Map map, const HealthSettings& health,
           const RelocalisationSettings& relocalisation)
      : rig_(rig),
        health_(health),
        ekf_(std::move(filter)),
        map_(std::move(map)),
        lost_(relocalisation),
        told_(told_of_rig(ekf_.state())) {
    sightings_.reserve(kTypicalLandmarks);
  }

  /// Takes over the saved map.
  void begin_on(const MapStart& start) {
    map_.restore(*start.map, ekf_.restore(*start.map));
    if (start.mode == MapMode::localise) ekf_.hold_map();
    start_decision_.begin(start, [this](const StartPose& pose) { begin_at(pose); });
  }

  PoseBelief belief() const { return belief_of(ekf_.state(), told_, velocity_); }
  /// Writes everything into an estimate except the landmarks.
  void write_robot(Estimate& out) const {
    write(belief(), recognition_.path_m, out);
    out.accepted.assign(sightings_.begin(), sightings_.end());
  }

  Rig rig_;
  HealthSettings health_;
  Filter ekf_;
  Map map_;
  LostRobot lost_;
  MapStartDecision start_decision_;
  RecognitionHistory recognition_;
  AssociationCounts counts_;                 ///< Without created and deleted landmarks
  std::vector<AcceptedSighting> sightings_;  ///< Bearings that corrected the state

 private:
  /// Updates the findings about the rig from all innovations so far, and corrects the filter for them. On a held map
  /// the filter is not corrected, since that would move only the pose.
  void hear_of_rig() {
    const Considered& pull = ekf_.state().told_of_considered().pull;
    if (pull == heard_pull_) return;
    heard_pull_ = pull;
    told_ = told_of_rig(ekf_.state());
    lag_ = lag_found(ekf_.state(), told_);
    if (ekf_.state().holds()) return;
    const Considered change = told_.believable() - ekf_.state().believed();
    if ((change.array().abs() > kWorthBelieving_sigmas * told_.sigma.array()).any()) ekf_.believe(told_.believable());
  }
  /// Sets the start pose on the map, when odometry does not continue from the saved pose.
  virtual void begin_at(const StartPose& pose) = 0;
  /// Judges the evidence from bearings together with the state of the map.
  virtual Judgement judged_with_map(Evidence heard) const = 0;
  /// Lists the landmarks to be saved: only points that have passed probation, since the others were seen from too few
  /// places.
  virtual void list_saved(StateSaver& saver) const = 0;

  void write(const PoseBelief& belief, double path_m, Estimate& out) const {
    write_belief(belief, counts(), judged(belief.covariance, path_m), out);
  }
  Judgement judged(const Eigen::Matrix3d& covariance, double path_m) const {
    if (const auto judgement = lost_.judgement()) return *judgement;
    Evidence heard = recognition_.evidence(covariance, path_m);
    heard.camera = ekf_.camera_errors();
    heard.rig_contradicted = told_.doubts_any();
    heard.lag = lag_;
    return judged_with_map(std::move(heard));
  }

  static constexpr double kWorthBelieving_sigmas = 0.2;
  RigTold told_;
  Considered heard_pull_ = Considered::Zero();  ///< The value of `pull` from which told_ was computed
  std::optional<LagFound> lag_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  ///< Velocity of the body, (m/s, m/s, rad/s)
  mutable StateSaver saver_;                            ///< Workspace of save_map()
};

}  // namespace azimuth
