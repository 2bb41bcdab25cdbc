#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/recognition_history.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/estimator/start_from_map.hpp"
#include "slam/hindsight/carried.hpp"
#include "slam/hindsight/image_poses.hpp"
#include "slam/hindsight/mapper.hpp"
#include "slam/lost/lost_robot.hpp"

namespace azimuth {

/// Covariances of the landmarks for the estimate after each image. One covariance takes some microseconds, so in a
/// large map each image recomputes only some of them, in turn; a landmark's covariance hardly changes within seconds.
///
/// Thread contract: thread-bound.
class LandmarkCovariances {
 public:
  /// Up to this number of landmarks, covariances are computed on request and are exact.
  static constexpr std::size_t kEachTime = 256;

  /// Must be called after an image was used. Recomputes the next covariances if there are many landmarks. All landmarks
  /// must be points.
  void refresh(std::span<const HindsightLandmark> landmarks, const Smoother& smoother);
  /// Covariance of (x, y) in the map [m^2], as of one of the last images.
  Eigen::Matrix2d of(const HindsightLandmark& landmark, const Smoother& smoother) const;
  /// Must be called when the map was replaced.
  void forget() { kept_.clear(); }

 private:
  struct Kept {
    LandmarkId in_graph = kOfNothing;
    Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
  };
  std::unordered_map<std::int64_t, Kept> kept_;  // by landmark id
  std::size_t next_ = 0;                         // next landmark to recompute
};

/// Settings of SmootherEstimator that do not depend on the mapper.
struct SmootherEstimatorSettings {
  bool named = true;               ///< bearings carry identities
  int confirm_after_bearings = 3;  ///< a landmark with fewer bearings is not published
  /// Standard deviation of the relative scale error of path and map, which bearings cannot reveal.
  double sigma_scale_distance = 0.0;
  HealthSettings health;
  RelocalisationSettings relocalisation;
};

/// Running mean and variance of the evidence that recent images gave for the robot's place (ln of odds).
///
/// Thread contract: thread-bound.
class UsualOdds {
 public:
  void add(double log_odds) {
    images_ = std::min(images_ + 1, kRemembered);
    const double off = log_odds - mean_;
    mean_ += off / images_;
    variance_ += (off * (log_odds - mean_) - variance_) / images_;
  }
  double mean() const { return mean_; }
  /// Whether images nearly always support the believed place. Only then does an image that does not support this place
  /// mean that the robot is elsewhere; otherwise the map is wrong in parts, or landmarks are often occluded.
  bool nearly_all_positive() const {
    return images_ >= kFewest && mean_ > 0.0 && mean_ * mean_ > kSigmas * kSigmas * variance_;
  }

 private:
  static constexpr int kRemembered = 50, kFewest = 20;
  static constexpr double kSigmas = 2.0;
  int images_ = 0;
  double mean_ = 0.0, variance_ = 0.0;
};

/// An estimator that optimises path and map from all measurements so far, so each image may revise what earlier images
/// meant (mathematics VI.18 to VI.20). estimate() gives the newest pose, write_past() the current estimate of all past
/// poses.
///
/// A robot that is not where the estimator believes is relocalised in the map.
///
/// Thread contract: thread-bound. Allocates memory, since path and map grow.
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
  static constexpr int kFitsAgain = 8;       // number of bearings
  static constexpr int kSlipsUntilLost = 3;  // number of consecutive slips; wheels do not slip with every image

  void hear(const BearingSet& bearings);
  void turn_to_body(const BearingSet& image);
  void listen(const UpdateOutcome& heard);
  ImageAgreement agreement() const;
  /// Predicted azimuth of a landmark in the last image, in the robot's frame. The variance contains neither the
  /// bearing's noise nor the correlation of robot and landmark.
  struct Prediction {
    double azimuth_rad = 0.0, variance_rad2 = 0.0;
  };
  std::optional<Prediction> predict(const HindsightLandmark& landmark) const;
  bool is_in_view(const Prediction& predicted) const;
  double bearing_noise() const;  ///< factor on the rig's standard deviation
  bool agrees(const Bearing& bearing, const Prediction& predicted) const;
  void note_names();
  void begin_at(const StartPose& pose);
  void begin_search(const std::optional<PositionPrior>& within = {});
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
  MapStartDecision start_decision_;
  std::optional<MapSnapshot> start_;  ///< saved map; kept until the robot's pose on this map is known
  LostRobot lost_;
  NamesSeen names_seen_;
  RestWatch rest_;
  std::int64_t known_below_ = 0;  ///< landmarks below this id were mapped before the pose was in doubt
  RecognitionHistory recognition_;
  ImagePoses image_poses_;
  int images_since_bookmark_ = 0;
  std::size_t images_at_bookmark_ = 0;
  int fit_again_ = 0;       ///< number of bearings that fit during relocalisation
  int slips_in_row_ = 0;    ///< reset when enough bearings fit between two slips
  int fit_since_slip_ = 0;  ///< number of bearings that fit since the last slip
  double map_reach_m_ = 0.0;
  AssociationCounts counts_;
  PoseGaussian belief_;
  std::deque<PathPose> latest_;  ///< poses at the newest images
  BearingSet image_;             ///< the last image, in the robot's frame
  bool held_back_ = false;       ///< the last image is not mapped, since the robot may be elsewhere
  Pose2 judged_from_;            ///< believed pose when an image was last tested against the place
  UsualOdds usual_odds_;
  MappedShare usual_share_;
  PoseGaussian candidate_;       ///< pose to be confirmed during relocalisation without identities
  double candidate_odds_ = 0.0;  ///< ln of the odds of `candidate_`, from the images since its choice
  ImageMatch match_;
  KnownMap known_map_;
  RaysOfImage rays_;
};

}  // namespace azimuth
