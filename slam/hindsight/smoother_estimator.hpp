#pragma once
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/hearing.hpp"
#include "slam/estimator/map_beginning.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/hindsight/image_poses.hpp"
#include "slam/hindsight/landmark_covariances.hpp"
#include "slam/hindsight/mapper.hpp"
#include "slam/hindsight/names_seen.hpp"
#include "slam/hindsight/rest_watch.hpp"
#include "slam/hindsight/usual_odds.hpp"
#include "slam/lost/lost_robot.hpp"

namespace azimuth {

/// What SmootherEstimator says and when, whoever maps.
struct SmootherEstimatorSettings {
  bool named = true;               ///< landmarks have names, so a lost robot can be searched for
  int confirm_after_bearings = 3;  ///< a landmark of fewer is not published
  /// Path and map may be too large by this share, which no bearing tells: standard deviation.
  double sigma_scale_distance = 0.0;
  HealthSettings health;
  RelocalisationSettings relocalisation;
};

/// Path and map by everything seen so far: each image may change what earlier ones meant (SPEC VI.18 to VI.20). What it
/// says of the present is the newest pose; what it thinks of the past by now, write_past().
///
/// A robot that is not where it should be is searched for in the map, where landmarks have names.
///
/// Thread contract: thread-bound. Allocates: path and map grow.
class SmootherEstimator final : public Estimator {
 public:
  SmootherEstimator(const Rig& rig, const SmootherEstimatorSettings& settings, std::unique_ptr<Mapper> mapper,
                    const MapStart& start = {});

  bool odometry_begins(bool goes_on) override;
  void predict(const Motion& motion) override;
  void update(const BearingSet& bearings) override;
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override;
  RigFinding rig_finding() const override;
  bool save_map(MapSnapshot& out) const override;
  bool write_past(std::vector<PastPose>& out) const override;
  bool write_path(std::vector<PathPose>& out) const override;
  void conclude() override;

  const Mapper& mapper() const { return *mapper_; }

 private:
  static constexpr int kFitsAgain = 8;       // bearings
  static constexpr int kSlipsUntilLost = 3;  // in a row: wheels that slip do not so with every image

  void hear(const BearingSet& bearings);
  void turn_to_body(const BearingSet& image);
  void listen(const UpdateOutcome& heard);
  ImageAgreement agreement() const;
  /// Of a bearing of the last image, in the robot's frame; its own noise is left out, as is what robot and landmark
  /// have in common.
  struct Prediction {
    double azimuth_rad = 0.0, variance_rad2 = 0.0;
  };
  std::optional<Prediction> predict(const HindsightLandmark& landmark) const;
  bool is_in_view(const Prediction& predicted) const;
  double bearing_noise() const;  ///< times what the rig says
  bool agrees(const Bearing& bearing, const Prediction& predicted) const;
  void note_names();
  void begin_at(const StartPose& pose);
  void begin_search(const std::optional<Whereabouts>& within = {});
  bool has_driven() const;
  bool can_be_lost() const;
  void lifted();
  bool relocate();
  void search();
  std::optional<PoseGaussian> look_for_robot();
  bool fits_again();
  void go_back();
  void go_back_to(const PoseGaussian& here);
  void was_found();
  void set_bookmark();
  bool is_held_back();
  bool is_seen_anew() const;
  std::vector<HindsightLandmark> seen_lately() const;
  std::optional<Compared> compared(std::span<const HindsightLandmark> landmarks, const PoseGaussian& here,
                                   const MappedShare& mapped);
  std::vector<KnownLandmark> known(std::span<const HindsightLandmark> landmarks) const;
  CameraView view() const;
  std::vector<SeenDirection> directions() const;
  bool found_by_places();
  bool has_place(const HindsightLandmark& landmark) const;
  bool is_settled(const HindsightLandmark& landmark) const;
  std::size_t count_settled() const;
  std::vector<HindsightLandmark> settled_landmarks() const;

  void write(const PoseGaussian& belief, double path_m, Estimate& out) const;
  double doubted_lag_s() const;
  Judgement judged(const Eigen::Matrix3d& covariance, double path_m) const;

  Rig rig_;
  SmootherEstimatorSettings settings_;
  std::unique_ptr<Mapper> mapper_;
  LandmarkCovariances covariances_;
  MapBeginning beginning_;
  std::optional<MapSnapshot> start_;  ///< until it is known where on it the robot is
  LostRobot lost_;
  NamesSeen names_seen_;
  RestWatch rest_;
  std::int64_t known_below_ = 0;  ///< ids of landmarks that were there before anything spoke against the pose
  Hearing hearing_;
  ImagePoses image_poses_;
  int images_since_bookmark_ = 0;
  std::size_t images_at_bookmark_ = 0;
  int fit_again_ = 0;       ///< bearings, while the robot is searched for
  int slips_in_row_ = 0;    ///< until enough bearings fit between two of them
  int fit_since_slip_ = 0;  ///< bearings
  double map_reach_m_ = 0.0;
  AssociationCounts counts_;
  PoseGaussian belief_;
  std::deque<PathPose> latest_;  ///< at the newest images
  BearingSet image_;             ///< the last one, in the robot's frame
  bool held_back_ = false;       ///< it is not mapped: it may be of somewhere else
  Pose2 judged_from_;            ///< where the robot was thought to be when that was asked last
  UsualOdds usual_odds_;
  MappedShare usual_share_;
  PoseGaussian candidate_;       ///< where the robot may be, while it is searched for without names
  double candidate_odds_ = 0.0;  ///< ln, by images since
  ImageMatch match_;
  KnownMap known_map_;
  RaysOfImage rays_;
};

}  // namespace azimuth
