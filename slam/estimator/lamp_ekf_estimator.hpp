#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/association/direction_matching.hpp"
#include "slam/ekf/lamp_ekf.hpp"
#include "slam/estimator/agreement_watch.hpp"
#include "slam/estimator/begins_twice.hpp"
#include "slam/estimator/image_troubles.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/estimator/lamp_directions.hpp"
#include "slam/estimator/lamp_ekf_settings.hpp"
#include "slam/estimator/map_fitness.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/fastslam/lamp_evidence.hpp"
#include "slam/localisation/relocaliser.hpp"

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

  /// A lamp in the state.
  struct Lamp {
    std::int64_t id = 0;
    Identity identity = kUnknownIdentity;
    LampBlock at;
    std::uint64_t sightings = 0;  ///< that were used
    double log_odds = 0.0;        ///< of being there, by sightings and misses
    LampEvidence evidence;        ///< of being a lamp, and not what reflections look like by chance
    int missed_in_row = 0;        ///< since the last sighting, where it should have been seen
    double first_seen_m = 0.0;    ///< path driven by then
    double last_seen_m = 0.0;
    std::uint64_t last_image = 0;    ///< in which it was seen
    std::uint64_t last_weighed = 0;  ///< image of its last evidence by a sighting
    bool confirmed = false;          ///< no longer on probation
  };
  std::span<const Lamp> lamps() const { return lamps_; }
  const LampEkf& filter() const { return ekf_; }
  std::optional<CentreOffset> centre_offset() const override { return ekf_.centre_offset(); }
  bool searching() const override { return searching_; }
  const AssociationCounts& counts() const override { return counts_; }
  std::int64_t next_id() const override { return next_id_; }
  /// Id of the lamp each bearing of the last image was used for; kNoLamp: none.
  static constexpr std::int64_t kNoLamp = -1;
  std::span<const std::int64_t> lamps_of_bearings() const { return lamps_of_bearings_; }

 private:
  /// A lamp as the camera should see it.
  struct Predicted {
    std::size_t lamp;
    PredictedLamp offset;
    Eigen::Matrix2d covariance;
  };
  /// A direction of a crowded image, by the confirmed lamp it is nearest to.
  struct Ranked {
    double distance2;
    std::size_t direction;
  };
  /// Two lamps that were seen in one image, near each other: they are two.
  struct Apart {
    std::int64_t a, b;
  };

  LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const LampEkfModel& model,
                   const RelocalisationSettings& relocalisation);
  void start_from(const MapStart& start);
  void begin_at(const StartPose& pose);
  ImageAgreement agreement() const;
  CameraView camera_view() const;
  void begin_search(const std::optional<Whereabouts>& within = {});
  void search(const BearingSet& bearings);
  void settle_at(const PoseHypothesis& found, const BearingSet& bearings);
  std::optional<PoseHypothesis> nearby() const;
  std::string_view why_lost() const;
  CentreOffset centre_or_exact() const;
  void recognise();
  void extend_map();
  void measure(const BearingSet& bearings);
  void predict_lamps();
  void thin_crowded();
  void rank_by_confirmed();
  void find_near();
  static double squared_distance(const MeasuredDirection& measured, const Predicted& predicted);
  bool is_near_a_direction(const Predicted& predicted) const;
  void match();
  bool is_in_view(const Predicted& predicted) const;
  bool is_due(const Predicted& predicted) const { return lamps_[predicted.lamp].confirmed && is_in_view(predicted); }
  void weigh_evidence();
  double detection(const Predicted& predicted) const;
  double chance_of_miss(const Predicted& predicted) const;
  double chance_of_view(const Predicted& predicted) const;
  bool contradicts_the_map() const;
  void recover();
  void agree();
  const Predicted& paired(const DirectionMatch& match) const;
  bool correct();
  void apply_matches(const BearingSet& bearings);
  void count_sighting(Lamp& lamp, const Bearing& bearing);
  void confirm(Lamp& lamp, double nonlinearity);
  void count_misses();
  void forget_doubtful();
  void merge_twins();
  std::optional<std::size_t> twin_of(const Lamp& missed) const;
  bool are_apart(std::int64_t a, std::int64_t b) const;
  void note_apart();
  void add_new();
  void begin_lamp(std::size_t direction);
  void promote_converged();
  void remove_lamp(std::size_t at);
  void forget_lamp(std::size_t at);
  std::size_t confirmed() const;
  bool any_proven() const;
  Judgement judged(const Eigen::Matrix3d& covariance, double path_m) const;
  PoseBelief belief() const { return belief_of(ekf_.state()); }
  void write(const PoseBelief& belief, double path_m, Estimate& out) const;

  Rig rig_;
  LampEkfSettings settings_;
  LampDirections directions_;
  double max_zenith_rad_, log_seen_, log_missed_;  // what a sighting and a miss are worth
  double inverse_height_per_m_, sigma_inverse_height_per_m_;
  LampEkf ekf_;
  DirectionMatching matching_;
  RelocalisationSettings relocalisation_;
  AgreementWatch watch_;
  Relocaliser relocaliser_;

  std::vector<Lamp> lamps_;
  std::vector<Apart> apart_;
  std::int64_t next_id_ = 0;
  MapMode mode_ = MapMode::extend;
  std::optional<StartPose> undecided_;  ///< until the odometry has begun
  bool searching_ = false;              // for the pose
  bool was_tracking_ = false;           // before it was lost: so it is probably not far
  std::uint64_t image_ = 0;
  AssociationCounts counts_;
  double path_m_ = 0.0, last_accepted_m_ = 0.0, last_judged_m_ = 0.0, last_weighed_m_ = 0.0;
  int contradictions_ = 0;  // images that contradict the map, less those that agree with it
  int doubts_ = 0;          // likewise, whatever became of the pose; while there are any, the map is held
  int deaf_streaks_ = 0;    // recoveries of the pose since the map was recognised
  ImageTroubles troubles_;
  bool without_elevation_ = false;  // the last image had bearings, but none of use
  std::size_t lights_ = 0;          // directions of use in the last image
  bool crowded_ = false;            // they were more than there is room for
  double new_density_per_sr_ = 0.0;

  // Of the running update.
  std::vector<LampSeen> seen_;
  std::vector<MeasuredDirection> measured_;  // the same, for matching
  std::vector<std::size_t> bearing_of_;      // of each direction
  std::vector<Ranked> ranked_;               // of a crowded image
  std::vector<Predicted> predicted_;         // every lamp above the camera
  std::vector<std::size_t> near_;            // of those, the ones that some direction may be of
  std::vector<Eigen::Vector2d> near_offsets_;
  std::vector<Identity> near_identities_;
  Workspace near_covariance_;
  std::vector<DirectionMatch> matches_;
  std::vector<MappedLampSighting> accepted_, doubtful_;  // of proven lamps, and of others
  std::vector<std::int64_t> lamps_of_bearings_;
  std::vector<AcceptedSighting> sightings_;
  std::vector<SeenDirection> directions_seen_;  // the measured ones, for a search

  // Of a running save_map().
  mutable StateSaver saver_;
};

}  // namespace azimuth
