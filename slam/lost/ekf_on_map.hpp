#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "slam/ekf/rig_told.hpp"
#include "slam/ekf/saved_state.hpp"
#include "slam/estimator/begins_twice.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/hearing.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/estimator/map_beginning.hpp"
#include "slam/estimator/map_fitness.hpp"
#include "slam/estimator/odometry_floors.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/geometry/index.hpp"
#include "slam/lost/lost_robot.hpp"

namespace azimuth {

/// An estimator around one joint filter and the book of its landmarks, whatever those are: how the robot begins on a
/// saved map, moves and is lost, what is said of its pose and its health, and how the map is saved. What an image means
/// for pose and map the class made from this one says.
///
/// Thread contract: thread-bound.
template <class Filter, class Map>
class EkfOnMap : public BeginsTwice {
 public:
  bool odometry_begins(bool goes_on) final {
    return beginning_.odometry_begins(goes_on, [this](const StartPose& pose) { begin_at(pose); });
  }
  void predict(const Motion& motion) final {
    const Motion noisy = with_floors(motion, rig_.odometry);
    hear_of_rig();
    ekf_.predict(noisy);
    lost_.predict(noisy);
    hearing_.path_m += motion.path_m;
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
    write(moved(belief(), motion), hearing_.path_m + motion.path_m, out);
  }
  bool save_map(MapSnapshot& out) const override {
    out.clear();
    if (judged(ekf_.state().pose_covariance(), hearing_.path_m).health == Health::lost) return false;
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

  /// Takes the map over that is there to start from.
  void begin_on(const MapStart& start) {
    map_.restore(*start.map, ekf_.restore(*start.map));
    if (start.mode == MapMode::localise) ekf_.hold_map();
    beginning_.begin(start, [this](const StartPose& pose) { begin_at(pose); });
  }

  PoseBelief belief() const { return belief_of(ekf_.state(), told_, velocity_); }
  /// All of an estimate but the landmarks.
  void write_robot(Estimate& out) const {
    write(belief(), hearing_.path_m, out);
    out.accepted.assign(sightings_.begin(), sightings_.end());
  }

  Rig rig_;
  HealthSettings health_;
  Filter ekf_;
  Map map_;
  LostRobot lost_;
  MapBeginning beginning_;
  Hearing hearing_;
  AssociationCounts counts_;                 ///< but for landmarks created and deleted
  std::vector<AcceptedSighting> sightings_;  ///< those that corrected the state

 private:
  /// What all images so far have told of it. On a map that is held nothing but the pose could be put
  /// right.
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
  /// The odometry does not go on: what is known of the pose on the map.
  virtual void begin_at(const StartPose& pose) = 0;
  /// By what was heard, and by what the map is like.
  virtual Judgement judged_with_map(Evidence heard) const = 0;
  /// Only points that are no longer on probation: the rest has been seen from too few places to be worth it.
  virtual void list_saved(StateSaver& saver) const = 0;

  void write(const PoseBelief& belief, double path_m, Estimate& out) const {
    write_belief(belief, counts(), judged(belief.covariance, path_m), out);
  }
  Judgement judged(const Eigen::Matrix3d& covariance, double path_m) const {
    if (const auto judgement = lost_.judgement()) return *judgement;
    Evidence heard = hearing_.evidence(covariance, path_m);
    heard.camera = ekf_.camera_errors();
    heard.rig_contradicted = told_.doubts_any();
    heard.lag = lag_;
    return judged_with_map(std::move(heard));
  }

  static constexpr double kWorthBelieving_sigmas = 0.2;
  RigTold told_;
  Considered heard_pull_ = Considered::Zero();  ///< that it is of
  std::optional<LagFound> lag_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  ///< of the body, (m/s, m/s, rad/s)
  mutable StateSaver saver_;                            ///< of a running save_map()
};

}  // namespace azimuth
