#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/estimator/begins_twice.hpp"
#include "slam/estimator/hearing.hpp"
#include "slam/estimator/map_beginning.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/lost/lost_robot.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/planar/feature_names.hpp"
#include "slam/planar/planar_map.hpp"
#include "slam/planar/planar_matcher.hpp"
#include "slam/planar/planar_search.hpp"

namespace azimuth {

/// Bearing-only EKF SLAM (SPEC part I): one joint filter over pose and landmarks, with delayed or undelayed
/// initialisation, known or unknown identities, gates, and recovery from streaks of rejections.
///
/// A robot that is not where it should be (carried away, or begun from a map without knowing the pose) is searched for:
/// what images show changes nothing until they say where it is. On a map too small for that it begins without.
///
/// Thread contract: thread-bound.
class EkfEstimator final : public BeginsTwice {
 public:
  /// A map to start from must be none of which why_unfit() says anything.
  EkfEstimator(const Rig& rig, const EkfSettings& settings, const MapStart& start = {});
  EkfEstimator(const Rig& rig, const EkfSettings& settings, const SecondBeginning& again);

  bool odometry_begins(bool goes_on) override;
  void predict(const Motion& motion) override;
  void update(const BearingSet& bearings) override;
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override;
  bool save_map(MapSnapshot& out) const override;

  /// The joint hypotheses of what these bearings without names are of, those far less likely than the best left out:
  /// for update_as(), until anything else is called.
  const JointCompatibility& weigh(const BearingSet& bearings, double keep_log_ratio);
  /// update() by one of them.
  void update_as(const BearingSet& bearings, std::size_t hypothesis);
  /// Landmarks begun from now on have ids from `next_id` on.
  void continue_from(std::int64_t next_id) { map_.continue_from(next_id); }

  using Landmark = PlanarLandmark;
  std::span<const Landmark> landmarks() const { return map_.landmarks(); }
  const BearingEkf& filter() const { return ekf_; }
  const Candidates& candidates() const { return map_.candidates(); }
  const FeatureIdentities* identities() const { return names_ ? &names_->identities() : nullptr; }
  Initialisation initialisation() const { return initialisation_; }
  std::optional<CentreOffset> centre_offset() const override { return ekf_.centre_offset(); }
  bool searching() const override { return lost_.is_searched_for(); }
  AssociationCounts counts() const override;
  std::int64_t next_id() const override { return map_.next_id(); }

 private:
  EkfEstimator(const Rig& rig, const EkfSettings& settings, const std::optional<SecondBeginning>& again);

  // How it begins (ekf_beginning.cpp).
  bool is_searchable(std::span<const MapLandmark> landmarks) const;
  bool is_worth_starting_from(const MapStart& start) const;
  void start_from(const MapStart& start);
  void begin_at(const StartPose& pose);
  void begin_from_nothing();

  // The steps of an update.
  PlanarView view() const { return {ekf_, rig_.camera}; }
  bool has_names() const { return names_landmarks(rig_); }
  /// Landmarks may come, go and be corrected.
  bool maps() const { return beginning_.extends() && !searching(); }
  const PlanarMatches& match(const BearingSet& image);
  bool relocate(const BearingSet& image, std::size_t rejected, std::size_t matched);
  void correct(std::span<const PlanarMatches::Pair> pairs, Stamp stamp);
  void recover();
  void extend_map(std::span<const Bearing> unmapped, Stamp stamp);
  bool sees_enough() const;
  void begin_search(const std::optional<Whereabouts>& within = {});
  void search(const BearingSet& image);
  void settle_at(const PoseHypothesis& found, const BearingSet& image);
  void was_found();

  // What it says.
  PoseBelief belief() const { return belief_of(ekf_.state()); }
  void write(const PoseBelief& belief, double path_m, Estimate& out) const;
  Judgement judged(const Eigen::Matrix3d& covariance, double path_m) const;
  bool may_take_one_for_another() const;
  LandmarkEstimate estimate_of(const Landmark& landmark) const;

  Rig rig_;
  EkfSettings settings_;
  Initialisation initialisation_;
  BearingEkf ekf_;
  PlanarMap map_;
  PlanarMatcher matcher_;
  PlanarSearch search_;
  LostRobot lost_;
  std::optional<FeatureNames> names_;  ///< where looks stand in for the sensor's
  MapBeginning beginning_;
  bool may_search_ = false;  ///< on the map that it began from
  Hearing hearing_;
  std::optional<std::size_t> hypothesis_;    ///< of those weighed, that the running update goes by
  AssociationCounts counts_;                 ///< but for landmarks created and deleted
  std::vector<MappedSighting> accepted_;     ///< of the running update
  std::vector<AcceptedSighting> sightings_;  ///< those that corrected the state
  mutable StateSaver saver_;                 ///< of a running save_map()
};

}  // namespace azimuth
