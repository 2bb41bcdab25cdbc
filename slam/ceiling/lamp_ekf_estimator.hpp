#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/ceiling/ceiling_view.hpp"
#include "slam/ceiling/lamp_ekf_settings.hpp"
#include "slam/ceiling/lamp_map.hpp"
#include "slam/ceiling/lamp_matcher.hpp"
#include "slam/ekf/lamp_ekf.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/lost/ekf_on_map.hpp"

namespace azimuth {

/// Bearing-only SLAM with indistinguishable ceiling lamps, for a camera that looks up: a joint EKF over the pose and
/// the 3D lamps. A lamp enters the state with its first detection, at a guessed height. It stays on probation until it
/// was detected from places far enough apart and the evidence excludes a reflection. Bearings without an elevation are
/// not used.
///
/// If the pose is wrong or unknown (the robot was carried away, or starts on a map without a known pose), the estimator
/// runs a relocalisation: images do not change the filter until they determine the pose.
///
/// Thread contract: thread-bound.
class LampEkfEstimator final : public EkfOnMap<LampEkf, LampMap> {
 public:
  /// A map to start from must pass why_unfit_for_lamp_ekf().
  LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const MapStart& start = {},
                   const HealthSettings& health = {}, const RelocalisationSettings& relocalisation = {});
  LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const Restart& again,
                   const HealthSettings& health = {}, const RelocalisationSettings& relocalisation = {});

  void update(const BearingSet& bearings) override;
  void estimate(Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override;

  std::span<const Lamp> lamps() const { return map_.lamps(); }
  bool views_differ() const override;
  std::optional<UsualHeight> usual_height() const override;
  /// For each bearing of the last image: the id of the lamp that it corrected, or kNoLamp.
  static constexpr std::int64_t kNoLamp = -1;
  std::span<const std::int64_t> lamps_of_bearings() const { return lamps_of_bearings_; }

 private:
  LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const std::optional<Restart>& again,
                   const HealthSettings& health, const RelocalisationSettings& relocalisation);

  void begin_at(const StartPose& pose) override;

  // The steps of update().
  void measure(const BearingSet& bearings);
  const LampMatches& match();
  bool is_due(const PredictedDirection& predicted) const;
  ImageAgreement agreement(const LampMatches& matches) const;
  bool contradicts_the_map(const LampMatches& matches) const;
  void doubt();
  void agree();
  /// Whether the image's detections and misses may count as evidence for and against lamps.
  bool may_judge_lamps() const { return !image_.crowded && doubts_ == 0; }
  void apply(const LampMatches& matches, const BearingSet& bearings);
  bool correct(const LampMatches& matches);
  void extend_map(const LampMatches& matches);
  void begin_search(const std::optional<PositionPrior>& within = {});
  CameraView camera_view() const;
  void search(const BearingSet& bearings);
  void settle_at(const PoseHypothesis& found, const BearingSet& bearings);

  // Output.
  CameraErrors camera_or_exact() const;
  Judgement judged_with_map(Evidence heard) const override;
  std::string_view why_starting(std::string_view usual) const;
  void list_saved(StateSaver& saver) const override;

  LampEkfSettings settings_;
  CeilingView view_;
  LampMatcher matcher_;
  /// Whether the pose was being tracked before it was lost, so that the robot is probably still near this pose
  bool was_tracking_ = false;
  /// Number of images that contradict the map minus those that agree with it, like recognition_.contradictions but
  /// independent of changes of the pose. The map is frozen while this is positive.
  int doubts_ = 0;
  CeilingImage image_;                                   ///< The last image
  std::vector<MappedLampSighting> accepted_, doubtful_;  ///< Detections of proven lamps, and of other lamps
  std::vector<std::int64_t> lamps_of_bearings_;
  std::vector<SeenDirection> directions_seen_;  ///< The measured directions, in the form for a relocalisation
};

}  // namespace azimuth
