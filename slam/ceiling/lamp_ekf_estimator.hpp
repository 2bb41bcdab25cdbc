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
#include "slam/estimator/begins_twice.hpp"
#include "slam/estimator/hearing.hpp"
#include "slam/estimator/map_beginning.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/lost/lost_robot.hpp"

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
class LampEkfEstimator final : public BeginsTwice {
 public:
  /// A map to start from must be one of why_unfit() == "".
  LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const MapStart& start = {},
                   const RelocalisationSettings& relocalisation = {});
  LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const SecondBeginning& again,
                   const RelocalisationSettings& relocalisation = {});

  bool odometry_begins(bool goes_on) override;
  void predict(const Motion& motion) override;
  void update(const BearingSet& bearings) override;
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override;
  bool save_map(MapSnapshot& out) const override;

  std::span<const Lamp> lamps() const { return map_.lamps(); }
  const LampEkf& filter() const { return ekf_; }
  std::optional<CentreOffset> centre_offset() const override { return ekf_.centre_offset(); }
  bool views_differ() const override;
  bool searching() const override { return lost_.is_searched_for(); }
  AssociationCounts counts() const override;
  std::int64_t next_id() const override { return map_.next_id(); }
  /// Id of the lamp each bearing of the last image was used for; kNoLamp: none.
  static constexpr std::int64_t kNoLamp = -1;
  std::span<const std::int64_t> lamps_of_bearings() const { return lamps_of_bearings_; }

 private:
  LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const std::optional<SecondBeginning>& again,
                   const RelocalisationSettings& relocalisation);

  // How it begins.
  void start_from(const MapStart& start);
  void begin_at(const StartPose& pose);

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
  PoseBelief belief() const { return belief_of(ekf_.state()); }
  CentreOffset centre_or_exact() const;
  void write(const PoseBelief& belief, double path_m, Estimate& out) const;
  Judgement judged(const Eigen::Matrix3d& covariance, double path_m) const;
  std::string_view why_starting(std::string_view usual) const;

  Rig rig_;
  LampEkfSettings settings_;
  CeilingView view_;
  LampEkf ekf_;
  LampMap map_;
  LampMatcher matcher_;
  LostRobot lost_;
  MapBeginning beginning_;
  bool was_tracking_ = false;  ///< before it was lost: so it is probably not far
  Hearing hearing_;            ///< contradictions: images that contradict the map, less those that agree with it
  int doubts_ = 0;             ///< likewise, whatever became of the pose; while there are any, the map is held
  AssociationCounts counts_;   ///< but for lamps created and deleted
  CeilingImage image_;         ///< the last one
  std::vector<MappedLampSighting> accepted_, doubtful_;  ///< of proven lamps, and of others
  std::vector<std::int64_t> lamps_of_bearings_;
  std::vector<AcceptedSighting> sightings_;     ///< those that corrected the state
  std::vector<SeenDirection> directions_seen_;  ///< the measured ones, for a search
  mutable StateSaver saver_;                    ///< of a running save_map()
};

}  // namespace azimuth
