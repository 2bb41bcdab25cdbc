// Loop closures that need several images (mathematics VI.20).

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/geometry/index.hpp"
#include "slam/hypotheses/hypothesis.hpp"
#include "slam/hypotheses/loop_reading.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kFewestBearingsBefore = 3;  // minimum number of bearings of a mapped landmark
constexpr std::size_t kFewestMapped = 5;          // minimum number of landmarks for a search
// Minimum relative error between landmarks, as a share of the range.
constexpr double kMapNoiseShare = 0.02;
// Radius of the search: so many standard deviations of the position plus a share of the range.
constexpr double kReachSigmas = 3.0, kReachShare = 0.25;
// Maximum number of optimisations, since a path that bends far may need several.
constexpr int kMostOptimisations = 2;

SmoothedLandmark carried(const SmoothedLandmark& landmark, const Pose2& T) {
  return {T * landmark.p_map_chart, landmark.direction_rad + T.heading_rad, landmark.inverse_distance_per_m};
}

}  // namespace

/// Lists the landmarks that were mapped before an image or come from a saved map. The covariance of each is relative to
/// the other landmarks: that of its own bearings, with the poses taken as known, plus a minimum.
std::vector<LandmarkId> Hypothesis::mapped_before(PoseId image, std::vector<MappedBefore>& map) const {
  std::vector<LandmarkId> ids;
  const double noise_m = kMapNoiseShare * settings_.scene.range_m;
  const double prior_per_m = 1.0 / settings_.smoother.inverse_depth_sigma_per_m;
  for (const LandmarkId id : landmarks_) {
    const SmoothedLandmark& landmark = graph().landmark(id);
    if (!landmark.is_point()) continue;
    const Eigen::Matrix2d by_place = landmark.p_by_chart().inverse();
    Eigen::Matrix2d covariance = noise_m * noise_m * by_place * by_place.transpose();
    if (!graph().is_known(id)) {
      std::size_t before = 0;
      Eigen::Matrix2d information = Eigen::Vector2d(0.0, prior_per_m * prior_per_m).asDiagonal();
      for (const BearingId bearing : graph().bearings_of(id)) {
        before += graph().bearing(bearing).pose < image ? 1U : 0U;
        information += graph().by_landmark_of(bearing) * graph().by_landmark_of(bearing).transpose();
      }
      if (before < kFewestBearingsBefore) continue;
      covariance += information.inverse();
    }
    ids.push_back(id);
    map.push_back({landmark, covariance, kind_of(id)});
  }
  return ids;
}

std::vector<ImageToRead> Hypothesis::images_to_read(PoseId since) const {
  std::vector<ImageToRead> read;
  for (PoseId image = since; image < images(); ++image) {
    ImageToRead& next = read.emplace_back();
    if (image > since) next.motion = motion_of(graph().odometry_to(image));
    for (BearingId id = first_bearing(image); id < first_bearing(image + 1); ++id)
      next.sightings.push_back({graph().bearing(id).azimuth_rad, graph().bearing(id).sigma_rad, kinds_[id]});
  }
  return read;
}

bool Hypothesis::close_loop() {
  const LoopSettings& loops = settings_.loops;
  const PoseId since = images() - loops.images;
  if (since <= 0 || explained(since) >= loops.well_explained * (graph().bearings() - first_bearing(since)))
    return false;
  std::vector<MappedBefore> map;
  const std::vector<LandmarkId> ids = mapped_before(since, map);
  if (map.size() < kFewestMapped) return false;

  const std::vector<ImageToRead> read = images_to_read(since);
  const double sigma_m = std::sqrt(smoother_.pose_covariance(since).topLeftCorner<2, 2>().trace());
  const PositionPrior position_prior{graph().camera_at(since).T_map_body.position(),
                                     kReachSigmas * sigma_m + kReachShare * settings_.scene.range_m};
  const std::vector<PoseGaussian> found = find_in_map(map, read, settings_.scene, position_prior);
  if (found.empty()) return false;
  Hypothesis other = *this;
  other.take_over(read_backwards(map, read, settings_.scene, settings_.smoother.min_distance_m, found.front()), since,
                  ids);
  if (other.energy() > energy() - member_.min_fall) return false;
  *this = std::move(other);
  return true;
}

/// Takes over the association and poses of `reading` for the images from `since` on, and optimises the path.
void Hypothesis::take_over(const Reading& reading, PoseId since, std::span<const LandmarkId> map) {
  const auto is_mapped = [&](LandmarkId id) { return std::find(map.begin(), map.end(), id) != map.end(); };
  BearingGraph::Values values = graph().values();
  for (PoseId image = since; image < images(); ++image)
    values.poses[as_size(image)] = SmoothedPose(graph().body_at(reading.poses[as_size(image - since)].T_map_body));
  // Landmarks found since then move along with the image that showed them first.
  for (const LandmarkId id : landmarks_) {
    if (is_mapped(id) || graph().bearings_of(id).empty()) continue;
    PoseId first = images();
    for (const BearingId bearing : graph().bearings_of(id)) first = std::min(first, graph().bearing(bearing).pose);
    if (first < since) continue;
    SmoothedLandmark& landmark = values.landmarks[as_size(id)];
    landmark = carried(landmark, values.poses[as_size(first)].T_map_body * inverse(graph().pose(first)));
  }
  for (PoseId image = since; image < images(); ++image)
    for (BearingId id = first_bearing(image); id < first_bearing(image + 1); ++id) {
      const int read = reading.landmark_of[as_size(image - since)][as_size(id - first_bearing(image))];
      if (read >= 0)
        smoother_.assign(id, map[as_size(read)]);
      else if (is_mapped(graph().landmark_of(id)))
        smoother_.assign(id, kOfNothing);
    }
  remove_weak_landmarks();
  smoother_.begin_at(values);
  for (int turn = 0; turn < kMostOptimisations && !smoother_.optimise().converged; ++turn) {
  }
  reassociate(
      WindowBelief(smoother_, window_start(), landmarks_near(window_start()), settings_.smoother.min_distance_m), 0);
}

}  // namespace azimuth
