#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/lost/ekf_on_map.hpp"
#include "slam/planar/candidates.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/planar/feature_identities.hpp"
#include "slam/planar/planar_map.hpp"
#include "slam/planar/planar_matcher.hpp"
#include "slam/planar/planar_search.hpp"
#include "slam/planar/planar_view.hpp"

namespace azimuth {

/// Assigns identities to features by descriptors and by the planar filter's belief of where landmarks are.
///
/// Thread contract: thread-bound.
class FeatureNames {
 public:
  FeatureNames(const Rig& rig, const EkfSettings& settings)
      : identities_(settings.identity, rig.camera.sigma_bearing_rad, settings.max_viewing_distance_m) {}

  /// The image with an identity for each bearing; see FeatureIdentities::name(). While the pose is a guess only
  /// descriptors decide.
  const BearingSet& name(const BearingSet& image, std::span<const PlanarLandmark> landmarks,
                         const Candidates& candidates, const PlanarView& view, bool pose_is_a_guess);

  const FeatureIdentities& identities() const { return identities_; }
  FeatureIdentities& identities() { return identities_; }

 private:
  FeatureIdentities identities_;
  IdentityBeliefs beliefs_;
};

/// Bearing-only EKF SLAM (mathematics part I): one joint filter over pose and landmarks, with delayed or undelayed
/// initialisation, known or unknown identities, gates, and re-initialisation after streaks of rejections.
///
/// When the robot is not where the filter believes (it was carried away, or started on a map with an unknown pose), a
/// search on the map starts. During the search images change neither map nor pose until they determine the pose. If a
/// saved map is too small for a search, the filter starts with an empty map.
///
/// Thread contract: thread-bound.
class EkfEstimator final : public EkfOnMap<BearingEkf, PlanarMap> {
 public:
  /// A map to start from must have passed why_unfit_for_ekf().
  EkfEstimator(const Rig& rig, const EkfSettings& settings, const MapStart& start = {},
               const HealthSettings& health = {}, const RelocalisationSettings& relocalisation = {});
  EkfEstimator(const Rig& rig, const EkfSettings& settings, const Restart& again, const HealthSettings& health = {},
               const RelocalisationSettings& relocalisation = {});

  void update(const BearingSet& bearings) override;
  void estimate(Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override;
  bool save_map(MapSnapshot& out) const override;

  /// Computes the joint association hypotheses for these unnamed bearings, leaving out those far less likely than the
  /// best. They are valid for update_as(), until another function is called.
  const JointCompatibility& weigh(const BearingSet& bearings, double keep_log_ratio);
  /// update() with one of these hypotheses.
  void update_as(const BearingSet& bearings, std::size_t hypothesis);
  /// New landmarks get identifiers from `next_id` on.
  void continue_from(std::int64_t next_id) { map_.continue_from(next_id); }

  using Landmark = PlanarLandmark;
  std::span<const Landmark> landmarks() const { return map_.landmarks(); }
  const Candidates& candidates() const { return map_.candidates(); }
  const FeatureIdentities* identities() const { return names_ ? &names_->identities() : nullptr; }
  Initialisation initialisation() const { return initialisation_; }

 private:
  /// `settings` must come from settings_for().
  EkfEstimator(const Rig& rig, const EkfSettings& settings, const std::optional<Restart>& again,
               const HealthSettings& health, const RelocalisationSettings& relocalisation);

  // Start from a saved map.
  bool is_searchable(std::span<const MapLandmark> landmarks) const;
  bool is_worth_starting_from(const MapStart& start) const;
  void start_from(const MapStart& start);
  void begin_at(const StartPose& pose) override;
  void begin_from_nothing();

  // Steps of an update.
  PlanarView view() const { return {ekf_, rig_.camera, search_.reach_m()}; }
  bool has_names() const { return names_landmarks(rig_); }
  /// Whether landmarks may be added, removed and corrected.
  bool maps() const { return start_decision_.extends() && !searching(); }
  ImageAgreement agreement(const BearingSet& image);
  const PlanarMatches& match(const BearingSet& image);
  bool relocate(const BearingSet& image, std::size_t rejected, std::size_t matched);
  void correct(std::span<const PlanarMatches::Pair> pairs, Stamp stamp);
  void recover();
  void extend_map(std::span<const Bearing> unmapped, Stamp stamp);
  bool sees_enough() const;
  void begin_search(const std::optional<PositionPrior>& within = {});
  void search(const BearingSet& image);
  void settle_at(const PoseHypothesis& found, const BearingSet& image);
  void was_found();

  // Output (ekf_output.cpp).
  Judgement judged_with_map(Evidence heard) const override;
  bool may_take_one_for_another() const;
  LandmarkEstimate estimate_of(const Landmark& landmark) const;
  void list_saved(StateSaver& saver) const override;

  EkfSettings settings_;
  Initialisation initialisation_;
  PlanarMatcher matcher_;
  PlanarSearch search_;
  std::optional<FeatureNames> names_;      ///< Set if descriptors replace the sensor's names
  bool may_search_ = false;                ///< The map it started from can be searched
  std::optional<std::size_t> hypothesis_;  ///< The weighed hypothesis that the running update uses
  std::vector<MappedSighting> accepted_;   ///< Bearings used by the running update
};

}  // namespace azimuth
