#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/hypotheses/conditioned_association.hpp"
#include "slam/hypotheses/loop_reading.hpp"
#include "slam/hypotheses/member_settings.hpp"
#include "slam/hypotheses/scene.hpp"
#include "slam/hypotheses/window_belief.hpp"
#include "slam/sample/map_snapshot.hpp"
#include "slam/smoother/shared_pages.hpp"
#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// Of pairs that may be wrong: they pull less than those of known names do.
inline SmootherSettings doubting_smoother() {
  SmootherSettings settings;
  settings.kernel_width = 2.0;
  return settings;
}

/// How landmarks are found by cameras that see ahead only: too little of what they see is seen again within a few
/// images for landmarks to be found by bearings of several of them together.
struct TrackSettings {
  bool used = false;
  double fresh_s = 3.0;             ///< for how long a landmark is expected where it was
  std::size_t fewest_bearings = 4;  ///< else it is gone by then
  double extra_merge_margin = 0.0;  ///< added to each member's
  double fresh_margin = 0.5;        ///< ln of the odds that a bearing is of a fresh landmark, against the best rival
};

/// When a robot that can tell little of what it sees looks for itself in its own map.
struct LoopSettings {
  PoseId images = 12;           ///< the newest ones, that are read anew
  double well_explained = 0.6;  ///< share of their bearings; where more are of something, it does not look
};

/// What all hypotheses of a beam have in common.
struct HypothesisSettings {
  Scene scene;
  SmootherSettings smoother = doubting_smoother();
  TrackSettings tracks;
  LoopSettings loops;
  HypothesisCosts costs = hypothesis_costs(scene, smoother);
};

/// For a camera of this noise and view. A narrow view sees less of what is there, and that from further away.
HypothesisSettings hypothesis_settings_for(double sigma_bearing_rad, double field_of_view_rad);

/// One answer to the question which bearing is of which landmark, and the path and map that follow (SPEC VI.20). It is
/// corrected when later images speak against it. Each image makes one pose, with the same number.
///
/// Copies are cheap, and share what they have in common. Thread contract: thread-bound. Same calls, same bits.
class Hypothesis {
 public:
  Hypothesis(const HypothesisSettings& settings, const MemberSettings& member);

  /// Begins from a saved map, before anything else: see azimuth::remember(). Its landmarks stay, however little is seen
  /// of them, and have the numbers from 0 on.
  void remember(const MapSnapshot& map, const Eigen::Matrix3d& moved);
  /// The first image, from where the map begins; without bearings, when there is a saved map.
  void begin(std::span<const NamelessSighting> sightings);
  /// The next image, at the end of `motion`, whose covariance is positive definite, so long after the last one.
  void add_image(const Motion& motion, std::span<const NamelessSighting> sightings, double after_s = 1.0);

  /// Where little of the last images is explained, looks for the robot in its own map by all of them together, and when
  /// the path bent to that has the lower energy, takes it over and says true. May take as long as several images.
  bool close_loop();

  /// What decides between hypotheses; lower is better.
  double energy() const;
  /// How often a landmark should have been seen, from its first bearing until a while after its last one, and was not.
  int missed() const;
  /// From now on it decides by this scene; what things cost stays.
  void expect(const Scene& scene) { settings_.scene = scene; }
  /// Decides from outside, as of a name; kOfNothing: of none. Images to come may decide otherwise.
  void assign(BearingId bearing, LandmarkId landmark);
  /// These images are no more, as are landmarks of which hardly a bearing is left: see BearingGraph. Members of a beam
  /// must forget the same, or their energies would be of different things.
  void forget(std::span<const PoseId> images);
  /// Becomes another hypothesis, but goes on deciding as itself.
  void adopt(const Hypothesis& other);

  const Scene& scene() const { return settings_.scene; }
  const Smoother& smoother() const { return smoother_; }
  const BearingGraph& graph() const { return smoother_.graph(); }
  /// Those that bearings are of, in the order in which they were found.
  const std::vector<LandmarkId>& landmarks() const { return landmarks_; }
  PoseId images() const { return time_s_.size(); }
  bool has_saved_map() const { return !graph().remembered().landmarks.empty(); }
  /// What sort of thing it is, as far as a bearing of it tells.
  Kind kind_of(LandmarkId id) const;
  /// Bearings of an image: from this one up to that of the next image.
  BearingId first_bearing(PoseId image) const { return graph().first_bearing_of(image); }

 private:
  /// Bearings that may be of one thing not mapped yet; newest first.
  struct Track {
    std::vector<BearingId> bearings;
    Kind kind = kAnyKind;
    SmoothedLandmark landmark;
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of (alpha, rho), the newest pose taken as exact
    double log_ratio = 0.0;
  };
  /// One that was found in this image: the belief does not know it.
  struct Grown {
    LandmarkId landmark;
    Eigen::Matrix2d covariance;  // of (x, y), the newest pose taken as exact
  };

  void add_sightings(std::span<const NamelessSighting> sightings);
  void associate(std::span<const NamelessSighting> sightings);
  std::vector<LandmarkId> landmarks_near(PoseId since) const;
  PoseId window_start() const { return std::max(0, images() - member_.window); }

  // GROW
  void grow(const WindowBelief& belief, PoseId oldest_anchor);
  std::vector<Track> find_tracks(const WindowBelief& belief, PoseId oldest_anchor, double min_log_ratio) const;
  void find_tracks_from(const WindowBelief& belief, PoseId anchor, BearingId bearing, double min_log_ratio,
                        std::vector<Track>& found) const;
  bool walk(const WindowBelief& belief, Track& track, PoseId anchor, PoseId second) const;
  bool update_track(Track& track, PoseId pose, BearingId bearing, const WindowBelief& belief,
                    double& log_density) const;
  void plant(const Track& track);
  /// Density by angle of all bearings, in the mean of all images.
  double bearings_per_rad() const;
  /// How many bearings are of a landmark, from this image on.
  BearingId explained(PoseId since = 0) const;

  // TRACKS
  void begin_tracks();
  void end_tracks();
  void merge();
  PoseId last_seen(LandmarkId id) const;
  bool is_fresh(LandmarkId id) const;
  bool is_established(LandmarkId id) const;

  // LOOPS
  std::vector<LandmarkId> mapped_before(PoseId image, std::vector<MappedBefore>& map) const;
  std::vector<ImageToRead> images_to_read(PoseId since) const;
  void take_over(const Reading& reading, PoseId since, std::span<const LandmarkId> map);

  // REASSOCIATE
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
  SharedPages<double> time_s_;  // of each image, since the first
  bool has_kinds_ = false;
  SharedPages<Kind> kinds_;             // of each bearing
  std::vector<Kind> remembered_kinds_;  // of each landmark of a saved map
  std::vector<LandmarkId> landmarks_;
  std::vector<Grown> grown_;
};

}  // namespace azimuth
