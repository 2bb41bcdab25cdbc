#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/lost/ekf_on_map.hpp"
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
class EkfEstimator final : public EkfOnMap<BearingEkf, PlanarMap> {
 public:
  /// A map to start from must be none of which why_unfit() says anything.
  EkfEstimator(const Rig& rig, const EkfSettings& settings, const MapStart& start = {});
  EkfEstimator(const Rig& rig, const EkfSettings& settings, const SecondBeginning& again);

  void update(const BearingSet& bearings) override;
  void estimate(Estimate& out) const override;
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
  const Candidates& candidates() const { return map_.candidates(); }
  const FeatureIdentities* identities() const { return names_ ? &names_->identities() : nullptr; }
  Initialisation initialisation() const { return initialisation_; }

 private:
  /// `settings` are those of settings_for().
  EkfEstimator(const Rig& rig, const EkfSettings& settings, const std::optional<SecondBeginning>& again);

  // How it begins (ekf_beginning.cpp).
  bool is_searchable(std::span<const MapLandmark> landmarks) const;
  bool is_worth_starting_from(const MapStart& start) const;
  void start_from(const MapStart& start);
  void begin_at(const StartPose& pose) override;
  void begin_from_nothing();

  // The steps of an update.
  PlanarView view() const { return {ekf_, rig_.camera, search_.reach_m()}; }
  bool has_names() const { return names_landmarks(rig_); }
  /// Landmarks may come, go and be corrected.
  bool maps() const { return beginning_.extends() && !searching(); }
  ImageAgreement agreement(const BearingSet& image);
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
  Judgement judged_with_map(Evidence heard) const override;
  bool may_take_one_for_another() const;
  LandmarkEstimate estimate_of(const Landmark& landmark) const;
  void list_saved(StateSaver& saver) const override;

  EkfSettings settings_;
  Initialisation initialisation_;
  PlanarMatcher matcher_;
  PlanarSearch search_;
  std::optional<FeatureNames> names_;      ///< where looks stand in for the sensor's
  bool may_search_ = false;                ///< on the map that it began from
  std::optional<std::size_t> hypothesis_;  ///< of those weighed, that the running update goes by
  std::vector<MappedSighting> accepted_;   ///< of the running update
};

}  // namespace azimuth
