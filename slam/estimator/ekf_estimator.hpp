#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slam/association/joint_compatibility.hpp"
#include "slam/ekf/bearing_ekf.hpp"
#include "slam/estimator/agreement_watch.hpp"
#include "slam/estimator/begins_twice.hpp"
#include "slam/estimator/candidates.hpp"
#include "slam/estimator/duplicates.hpp"
#include "slam/estimator/ekf_settings.hpp"
#include "slam/estimator/feature_identities.hpp"
#include "slam/estimator/image_troubles.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/estimator/map_fitness.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/estimator/relocation.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/localisation/relocaliser.hpp"

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
  /// A map to start from must be one of why_unfit() == "".
  EkfEstimator(const Rig& rig, const EkfSettings& settings, const MapStart& start = {});
  EkfEstimator(const Rig& rig, const EkfSettings& settings, const SecondBeginning& again);

  bool odometry_begins(bool goes_on) override;
  void predict(const Motion& motion) override;
  void update(const BearingSet& bearings) override;
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override;
  bool save_map(MapSnapshot& out) const override;

  /// A landmark in the state.
  struct Landmark {
    std::int64_t id = 0;
    Identity identity = kUnknownIdentity;
    Kind kind = kAnyKind;
    BlockKind block_kind = BlockKind::point;
    Index block = 0;
    std::uint64_t sightings = 0;  ///< bearings accepted
    int rejected_in_row = 0;      ///< since the last accepted one
    double last_used_m = 0.0;     ///< path driven by then
    Stamp last_used{};
    double radius_px = BearingEkf::kNoRadius;  ///< of the last bearing accepted
    bool recalled = false;                     ///< from a saved map, and not seen since the start

    void was_seen(double at_radius_px, double path_m, Stamp stamp) {
      radius_px = at_radius_px;
      last_used_m = path_m;
      last_used = stamp;
      rejected_in_row = 0;
      recalled = false;
      ++sightings;
    }
  };
  std::span<const Landmark> landmarks() const { return landmarks_; }
  const BearingEkf& filter() const { return ekf_; }
  const Candidates& candidates() const { return candidates_; }
  const FeatureIdentities* identities() const { return identities_ ? &*identities_ : nullptr; }
  Initialisation initialisation() const { return initialisation_; }
  std::optional<CentreOffset> centre_offset() const override { return ekf_.centre_offset(); }
  bool searching() const override { return searching_; }
  const AssociationCounts& counts() const override { return counts_; }
  std::int64_t next_id() const override { return next_id_; }

 private:
  /// A bearing paired with a mapped landmark.
  struct Match {
    std::size_t landmark;
    MappedSighting sighting;
    ObservationRow row;
    double variance;  ///< S = H P H^T + R
    bool accepted = true;
  };

  /// A mapped landmark as the camera should see it.
  struct Visible {
    std::size_t landmark;
    ObservationRow row;
    double azimuth_rad;
    double variance_rad2;  ///< of that, what a linear prediction leaves out included
  };

  EkfEstimator(const Rig& rig, const EkfSettings& settings, const BearingEkfSettings& filter);
  bool is_searchable(std::span<const MapLandmark> landmarks) const;
  bool is_worth_starting_from(const MapStart& start) const;
  void start_from(const MapStart& start);
  void begin_at(const StartPose& pose);
  void begin_from_nothing();
  bool was_seen_lately(const Landmark& landmark, const BearingSet& image) const;
  ImageAgreement agreement(const BearingSet& observations);
  CameraView camera_view() const;
  void begin_search(const std::optional<Whereabouts>& within = {});
  void search(const BearingSet& observations);
  void settle_at(const PoseHypothesis& found, const BearingSet& observations);
  void pair_from_here(const BearingSet& observations);
  void was_found();
  void note_range(const Landmark& landmark);
  std::string_view why_lost() const;
  /// Landmarks may come, go and be corrected.
  bool maps() const { return mode_ == MapMode::extend && !searching_; }
  bool has_names() const { return rig_.camera.identities || identities_.has_value(); }
  bool sees_enough() const;
  const BearingSet& named(const BearingSet& observations);
  /// Whether an earlier bearing of the same image has the same name: a name stands for one landmark.
  static bool repeats_a_name(const Bearing& bearing, const BearingSet& image);
  void match_identities(const BearingSet& observations);
  void match_by_position(const BearingSet& observations);
  double variance_rad2(const Bearing& bearing) const;
  MappedSighting sighting_of(const Landmark& landmark, const Bearing& bearing) const;
  void add_match(std::size_t landmark, const Bearing& bearing, Stamp stamp);
  std::optional<Visible> predict(std::size_t landmark) const;
  void predict_visible();
  void drop_on_probation();
  void gate_individually();
  void gate_jointly();
  bool relocate(const BearingSet& observations);
  PoseBelief belief() const { return belief_of(ekf_.state()); }
  void apply_matches(Stamp stamp);
  void extend_map(Stamp stamp);
  void add_unmapped(Stamp stamp);
  void add_landmark(Landmark landmark, std::uint64_t sightings, double radius_px, Stamp stamp);
  void promote_converged();
  void recover();
  void merge_duplicates(Stamp stamp);
  void list_points(Stamp stamp);
  void merge(const Duplicates::Pair& pair);
  void forget_landmark(std::size_t at);
  void remove_landmark(std::size_t at);
  void write(const PoseBelief& belief, double path_m, Estimate& out) const;
  Judgement judged(const Eigen::Matrix3d& covariance, double path_m) const;

  Rig rig_;
  EkfSettings settings_;
  Initialisation initialisation_;
  double new_density_per_rad_;
  BearingEkf ekf_;
  Candidates candidates_;
  Duplicates duplicates_;
  std::optional<FeatureIdentities> identities_;  ///< where looks stand in for names
  IdentityBeliefs beliefs_;
  JointCompatibility association_;
  JointTest joint_test_;

  std::vector<Landmark> landmarks_;
  std::int64_t next_id_ = 0;
  MapMode mode_ = MapMode::extend;
  std::optional<StartPose> undecided_;  ///< until the odometry has begun
  AgreementWatch watch_;
  bool may_search_ = false;  ///< on the map that it began from
  bool searching_ = false;   ///< for the pose, on a map that is kept as it is meanwhile
  std::optional<Relocaliser> relocaliser_;
  double seen_range_m_ = 0.0;  ///< of the farthest landmark seen lately
  AssociationCounts counts_;
  double path_m_ = 0.0, last_accepted_m_ = 0.0;
  int deaf_sightings_ = 0;  ///< rejected since any bearing was accepted
  int deaf_streaks_ = 0;    ///< recoveries of the pose since then
  ImageTroubles troubles_;

  // Of the running update.
  std::vector<Visible> visible_;
  std::vector<double> visible_azimuths_rad_;
  std::vector<Kind> visible_kinds_;
  std::vector<MeasuredAzimuth> measured_;
  std::vector<Pairing> pairings_;
  std::vector<Match> matches_;
  std::vector<std::size_t> gated_;
  std::vector<double> innovations_;
  std::vector<std::uint8_t> jointly_accepted_;
  Workspace innovation_covariance_;
  std::vector<Bearing> unmapped_;
  std::vector<MappedSighting> accepted_;
  std::vector<Duplicates::Point> points_;
  std::vector<AcceptedSighting> sightings_;   ///< those that corrected the state
  std::vector<MappedSighting> named_;         ///< all mapped points of the image, thinned or not
  std::vector<std::size_t> named_landmarks_;  ///< of those
  std::vector<std::uint8_t> explained_;       ///< bearings that are of some landmark where it should be
  std::vector<SeenDirection> directions_;

  // Of a running save_map().
  mutable StateSaver saver_;
};

}  // namespace azimuth
