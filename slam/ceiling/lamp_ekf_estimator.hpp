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

/// Bearing-only SLAM below lamps that all look alike, for a camera that looks up: one joint filter over the pose and
/// lamps in space. A lamp enters the state with its first sighting, at a guessed height, and stays on probation until
/// it was seen again from elsewhere, and known to be no reflection. Bearings need an elevation; those without are not
/// used.
///
/// A robot that is not where it should be (carried away, or begun from a map without knowing the pose) is searched for:
/// what images show changes nothing until they say where it is.
///
/// Thread contract: thread-bound.
class LampEkfEstimator final : public EkfOnMap<LampEkf, LampMap> {
 public:
  /// A map to start from must be fit, see why_unfit_for_lamp_ekf().
  LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const MapStart& start = {},
                   const RelocalisationSettings& relocalisation = {});
  LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const SecondBeginning& again,
                   const RelocalisationSettings& relocalisation = {});

  void update(const BearingSet& bearings) override;
  void estimate(Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override;

  std::span<const Lamp> lamps() const { return map_.lamps(); }
  bool views_differ() const override;
  std::optional<UsualHeight> usual_height() const override;
  /// Id of the lamp each bearing of the last image was used for; kNoLamp: none.
  static constexpr std::int64_t kNoLamp = -1;
  std::span<const std::int64_t> lamps_of_bearings() const { return lamps_of_bearings_; }

 private:
  LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const std::optional<SecondBeginning>& again,
                   const RelocalisationSettings& relocalisation);

  void begin_at(const StartPose& pose) override;

  // The steps of an update.
  void measure(const BearingSet& bearings);
  const LampMatches& match();
  bool is_due(const PredictedDirection& predicted) const;
  ImageAgreement agreement(const LampMatches& matches) const;
  bool contradicts_the_map(const LampMatches& matches) const;
  void doubt();
  void agree();
  /// What an image shows, and does not, may count for and against lamps.
  bool may_judge_lamps() const { return !image_.crowded && doubts_ == 0; }
  void apply(const LampMatches& matches, const BearingSet& bearings);
  bool correct(const LampMatches& matches);
  void extend_map(const LampMatches& matches);
  void begin_search(const std::optional<Whereabouts>& within = {});
  CameraView camera_view() const;
  void search(const BearingSet& bearings);
  void settle_at(const PoseHypothesis& found, const BearingSet& bearings);

  // What it says.
  CameraErrors camera_or_exact() const;
  Judgement judged_with_map(Evidence heard) const override;
  std::string_view why_starting(std::string_view usual) const;
  void list_saved(StateSaver& saver) const override;

  LampEkfSettings settings_;
  CeilingView view_;
  LampMatcher matcher_;
  bool was_tracking_ = false;  ///< before it was lost: so it is probably not far
  /// Images that contradict the map less those that agree with it, as hearing_.contradictions, whatever became of the
  /// pose; while there are any, the map is held.
  int doubts_ = 0;
  CeilingImage image_;                                   ///< the last one
  std::vector<MappedLampSighting> accepted_, doubtful_;  ///< of proven lamps, and of others
  std::vector<std::int64_t> lamps_of_bearings_;
  std::vector<SeenDirection> directions_seen_;  ///< the measured ones, for a search
};

}  // namespace azimuth
