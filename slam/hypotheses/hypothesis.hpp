#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/hypotheses/conditioned_association.hpp"
#include "slam/hypotheses/loop_reading.hpp"
#include "slam/hypotheses/scene.hpp"
#include "slam/hypotheses/window_belief.hpp"
#include "slam/sample/map_snapshot.hpp"
#include "slam/smoother/robust_kernel.hpp"
#include "slam/smoother/shared_pages.hpp"
#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// Decision thresholds of one member of a beam. No setting is right everywhere, so members differ on purpose.
struct MemberSettings {
  int window = 12;             ///< newest images searched for landmarks and associated anew with each image
  int anchors = 1;             ///< number of newest images that may hold a new landmark's last bearing
  int min_hits = 4;            ///< minimum number of bearings of a new landmark
  double min_fall = 6.0;       ///< minimum fall of the energy by a set of new landmarks
  double step_fall = 1.0;      ///< minimum fall of the energy by each further landmark of the set
  double min_log_ratio = 2.0;  ///< minimum ln of the odds of a new landmark against chance
  double rival_gap = 1.5;      ///< a bearing stays unassociated if the second best choice costs less than this more
  bool past_stands = true;     ///< whether pairs of images before the window stay although a rival is within rival_gap
  double merge_margin = 3.0;   ///< minimum ln of the odds for merging two landmarks, against the best rival
  double missed_scale = 1.0;   ///< factor on the cost of a missed detection
  RobustKernel kernel = RobustKernel::cauchy;
  friend bool operator==(const MemberSettings&, const MemberSettings&) = default;
};

/// Settings of `count` different members; the first has the defaults. The same count gives the same settings.
std::vector<MemberSettings> differing_members(int count);

/// Smoother settings for associations that may be wrong. Outliers get less weight than with known identities.
inline SmootherSettings doubting_smoother() {
  SmootherSettings settings;
  settings.kernel_width = 2.0;
  return settings;
}

/// Initialisation of landmarks for cameras with a narrow field of view. Such a camera sees few landmarks again within a
/// few images, so a landmark cannot be found from bearings of several images together.
struct TrackSettings {
  bool used = false;
  double fresh_s = 3.0;             ///< a landmark is fresh for this long after its last bearing
  std::size_t fewest_bearings = 4;  ///< a landmark with fewer bearings is removed when no longer fresh
  double extra_merge_margin = 0.0;  ///< added to MemberSettings::merge_margin
  double fresh_margin = 0.5;        ///< ln of the odds for a bearing of a fresh landmark, against the best rival
};

/// Conditions under which a hypothesis searches its own map for the robot (loop closure).
struct LoopSettings {
  PoseId images = 12;           ///< number of newest images that are associated anew
  double well_explained = 0.6;  ///< no search when more than this share of these images' bearings is associated
};

/// Settings shared by all hypotheses of a beam.
struct HypothesisSettings {
  Scene scene;
  SmootherSettings smoother = doubting_smoother();
  TrackSettings tracks;
  LoopSettings loops;
  HypothesisCosts costs = hypothesis_costs(scene, smoother);
};

/// Settings for a camera of this noise and field of view. Through a narrow view, the camera detects a smaller share of
/// the landmarks and sees them from further away.
HypothesisSettings hypothesis_settings_for(double sigma_bearing_rad, double field_of_view_rad);

/// One data association of all bearings with landmarks, and the path and map that follow from it (mathematics VI.20).
/// The association is corrected when later images contradict it. Each image makes one pose, which has the image's
/// number.
///
/// Copies are cheap and share equal parts. Thread contract: thread-bound. The same calls give the same bits.
class Hypothesis {
 public:
  Hypothesis(const HypothesisSettings& settings, const MemberSettings& member);

  /// Starts from a saved map: see azimuth::remember(). This must be the first call. The map's landmarks are never
  /// removed and get the numbers from 0 on.
  void remember(const MapSnapshot& map, const Eigen::Matrix3d& moved);
  /// Adds the first image, at the start of the map. With a saved map it has no bearings.
  void begin(std::span<const NamelessSighting> sightings);
  /// Adds the next image, at the end of `motion` and `after_s` after the image before. The motion's covariance must be
  /// positive definite.
  void add_image(const Motion& motion, std::span<const NamelessSighting> sightings, double after_s = 1.0);

  /// Tries to close a loop. If few bearings of the last images are associated, the hypothesis searches its own map for
  /// the robot, with all these images together. It accepts the corrected path and returns true when that lowers the
  /// energy. May take as long as several images.
  bool close_loop();

  /// The cost that ranks hypotheses; lower is better.
  double energy() const;
  /// Number of missed detections over all landmarks: images in which a landmark should have been seen and was not.
  /// Counted are the images from the landmark's first bearing until some images after its last bearing.
  int missed() const;
  /// Uses this scene for all later decisions. The costs stay the same.
  void expect(const Scene& scene) { settings_.scene = scene; }
  /// Assigns a bearing to a landmark from outside; kOfNothing: to no landmark. Later images may change the association.
  void assign(BearingId bearing, LandmarkId landmark);
  /// Corrects odometry and azimuths so far for these errors of the rig: see BearingGraph.
  void correct(const Calibration& errors);
  /// Removes these images, and landmarks that keep hardly any bearing: see BearingGraph. All members of a beam must
  /// remove the same images, so that their energies stay comparable.
  void forget(std::span<const PoseId> images);
  /// Copies another hypothesis, but keeps its own MemberSettings.
  void adopt(const Hypothesis& other);

  const Scene& scene() const { return settings_.scene; }
  const Smoother& smoother() const { return smoother_; }
  const BearingGraph& graph() const { return smoother_.graph(); }
  /// The landmarks of the map, in the order in which they were found.
  const std::vector<LandmarkId>& landmarks() const { return landmarks_; }
  PoseId images() const { return time_s_.size(); }
  bool has_saved_map() const { return !graph().remembered().landmarks.empty(); }
  /// Kind of the landmark, as far as its bearings tell.
  Kind kind_of(LandmarkId id) const;
  /// The image's first bearing; its bearings end before the next image's first one.
  BearingId first_bearing(PoseId image) const { return graph().first_bearing_of(image); }

 private:
  /// A candidate for a new landmark: bearings that may belong to it, newest first.
  struct Track {
    std::vector<BearingId> bearings;
    Kind kind = kAnyKind;
    SmoothedLandmark landmark;
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of (alpha, rho), relative to the newest pose
    double log_ratio = 0.0;
  };
  /// A landmark that was found in the current image and is not in the WindowBelief.
  struct Grown {
    LandmarkId landmark;
    Eigen::Matrix2d covariance;  // of (x, y), relative to the newest pose
  };

  void add_sightings(std::span<const NamelessSighting> sightings);
  void associate(std::span<const NamelessSighting> sightings);
  std::vector<LandmarkId> landmarks_near(PoseId since) const;
  PoseId window_start() const { return std::max(0, images() - member_.window); }

  // New landmarks from bearings of several images (hypothesis_growth.cpp).
  void grow(const WindowBelief& belief, PoseId oldest_anchor);
  std::vector<Track> find_tracks(const WindowBelief& belief, PoseId oldest_anchor, double min_log_ratio) const;
  void find_tracks_from(const WindowBelief& belief, PoseId anchor, BearingId bearing, double min_log_ratio,
                        std::vector<Track>& found) const;
  bool walk(const WindowBelief& belief, Track& track, PoseId anchor, PoseId second) const;
  bool update_track(Track& track, PoseId pose, BearingId bearing, const WindowBelief& belief,
                    double& log_density) const;
  void initialise(const Track& track);
  /// Mean number of bearings per image and radian, over all images.
  double bearings_per_rad() const;
  /// Number of associated bearings from this image on.
  BearingId explained(PoseId since = 0) const;

  // Landmarks through a narrow view (hypothesis_tracks.cpp).
  void begin_tracks();
  void end_tracks();
  void merge();
  PoseId last_seen(LandmarkId id) const;
  bool is_fresh(LandmarkId id) const;
  bool is_established(LandmarkId id) const;

  // Loop closure (hypothesis_loops.cpp).
  std::vector<LandmarkId> mapped_before(PoseId image, std::vector<MappedBefore>& map) const;
  std::vector<ImageToRead> images_to_read(PoseId since) const;
  void take_over(const Reading& reading, PoseId since, std::span<const LandmarkId> map);

  // Data association in hindsight (hypothesis_reassociation.cpp).
  void reassociate(const WindowBelief& belief, PoseId from);
  bool reassociate_image(const WindowBelief& belief, PoseId image);
  void remove_weak_landmarks();
  double prediction_variance(const WindowBelief& belief, PoseId pose, LandmarkId landmark,
                             const SeenAzimuth& seen) const;

  bool may_be_of(BearingId bearing, Kind kind) const { return !has_kinds_ || same_kind(kinds_[bearing], kind); }
  bool is_unassigned(BearingId bearing) const { return graph().landmark_of(bearing) == kOfNothing; }

  HypothesisSettings settings_;
  MemberSettings member_;
  Smoother smoother_;
  SharedPages<double> time_s_;  // time of each image since the first
  bool has_kinds_ = false;
  SharedPages<Kind> kinds_;             // per bearing
  std::vector<Kind> remembered_kinds_;  // per landmark of a saved map
  std::vector<LandmarkId> landmarks_;
  std::vector<Grown> grown_;
};

}  // namespace azimuth
