#include "slam/hypotheses/loop_reading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/geometry/index.hpp"
#include "slam/localisation/motion_chain.hpp"

namespace azimuth {
namespace {

// Shares of the detection probability and of the range. The robot's own map may be wrong in places and the range is not
// known exactly, so a missed detection counts for less than in a saved map, and only nearby.
constexpr double kDetectionShare = 2.0 / 3.0, kSurelySeenShare = 0.75;
// Minimum share of the last bearings, and minimum number of images, that a candidate pose must explain.
constexpr double kFewestExplained = 0.3;
constexpr int kFewestImages = 3;
// Comparisons of directions with landmarks per image. The number is low, since the search area is small.
constexpr int kSearchChecks = 100000;

KnownLandmark known(const MappedBefore& landmark) {
  KnownLandmark known;
  const Eigen::Vector2d p = landmark.where.p_map();
  known.p_map_m = {p.x(), p.y(), std::numeric_limits<double>::quiet_NaN()};
  const Eigen::Matrix2d by_chart = landmark.where.p_by_chart();
  known.covariance_m2.topLeftCorner<2, 2>() = by_chart * landmark.covariance * by_chart.transpose();
  known.kind = landmark.kind;
  return known;
}

/// Matrix that turns (x, y, heading) from the map's axes to the pose's own axes.
Eigen::Matrix3d along_own_axes(double heading_rad) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = rotation(-heading_rad);
  return turn;
}

/// Associates one image from a predicted pose, and corrects the pose.
class ImageReader {
 public:
  ImageReader(std::span<const MappedBefore> map, const Scene& scene, double min_distance_m) : map_(map) {
    settings_.scene = scene;
    settings_.min_distance_m = min_distance_m;
  }

  std::vector<int> read(std::span<const NamelessSighting> sightings, PoseGaussian& pose) const {
    std::vector<int> near;
    for (std::size_t j = 0; j < map_.size(); ++j)
      if ((map_[j].where.p_map() - pose.T_map_body.position()).norm() < settings_.scene.asked_within_m())
        near.push_back(static_cast<int>(j));
    const Eigen::Matrix3d turn = along_own_axes(pose.T_map_body.heading_rad);
    PoseAndLandmarks belief{SmoothedPose(pose.T_map_body), {}, {}, {}};
    const auto rows = static_cast<Eigen::Index>(3 + 2 * near.size());
    belief.covariance = Eigen::MatrixXd::Zero(rows, rows);
    belief.covariance.topLeftCorner<3, 3>() = turn * pose.covariance * turn.transpose();
    for (std::size_t k = 0; k < near.size(); ++k) {
      const MappedBefore& landmark = map_[as_size(near[k])];
      belief.landmarks.push_back(landmark.where);
      belief.kinds.push_back(landmark.kind);
      const auto row = static_cast<Eigen::Index>(3 + 2 * k);
      belief.covariance.block<2, 2>(row, row) = landmark.covariance;
    }
    std::vector<int> landmark_of = associate_conditioned(std::move(belief), sightings, settings_);
    for (int& landmark : landmark_of)
      if (landmark >= 0) landmark = near[as_size(landmark)];
    correct(sightings, landmark_of, pose);
    return landmark_of;
  }

 private:
  void correct(std::span<const NamelessSighting> sightings, std::span<const int> landmark_of,
               PoseGaussian& pose) const {
    const Eigen::Matrix3d turn = along_own_axes(pose.T_map_body.heading_rad);
    Eigen::Matrix3d P = turn * pose.covariance * turn.transpose();
    SmoothedPose at(pose.T_map_body);
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      if (landmark_of[i] < 0) continue;
      const MappedBefore& landmark = map_[as_size(landmark_of[i])];
      SeenAzimuth seen;
      if (!see(at, landmark.where, settings_.min_distance_m, seen)) continue;
      const Eigen::Vector3d PH = P * seen.by_pose;
      const double S = seen.by_pose.dot(PH) + seen.by_landmark.dot(landmark.covariance * seen.by_landmark) +
                       sightings[i].sigma_rad * sightings[i].sigma_rad;
      at = at.moved(PH * (wrap(sightings[i].azimuth_rad - seen.azimuth_rad) / S));
      P -= PH * PH.transpose() / S;
    }
    const Eigen::Matrix3d back = along_own_axes(at.T_map_body.heading_rad).transpose();
    pose = {at.T_map_body, back * P * back.transpose()};
  }

  std::span<const MappedBefore> map_;
  ConditionedAssociationSettings settings_;
};

}  // namespace

std::vector<PoseGaussian> find_in_map(std::span<const MappedBefore> map, std::span<const ImageToRead> images,
                                      const Scene& scene, const PositionPrior& position_prior) {
  RelocalisationSettings settings;
  settings.detection_probability = kDetectionShare * scene.detection_probability;
  settings.search_checks = kSearchChecks;
  settings.history_images = static_cast<int>(images.size());
  CameraView view;
  view.field_of_view_rad = scene.field_of_view_rad;
  view.max_distance_m = kSurelySeenShare * scene.range_m;
  view.detection_probability = settings.detection_probability;
  std::vector<KnownLandmark> landmarks;
  std::transform(map.begin(), map.end(), std::back_inserter(landmarks), known);

  Relocaliser relocaliser(settings);
  relocaliser.start(landmarks, view, position_prior);
  std::vector<SeenDirection> directions;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (i > 0) relocaliser.predict(images[i].motion);
    directions.clear();
    for (const NamelessSighting& sighting : images[i].sightings)
      directions.push_back(
          {.azimuth_rad = sighting.azimuth_rad, .sigma_rad = sighting.sigma_rad, .kind = sighting.kind});
    relocaliser.update(directions);
  }
  std::vector<PoseGaussian> found;
  for (const PoseHypothesis& pose : relocaliser.hypotheses())
    if (pose.explained >= kFewestExplained && pose.images >= kFewestImages)
      found.push_back({pose.T_map_body, pose.covariance});
  return found;
}

Reading read_backwards(std::span<const MappedBefore> map, std::span<const ImageToRead> images, const Scene& scene,
                       double min_distance_m, const PoseGaussian& last) {
  const ImageReader reader(map, scene, min_distance_m);
  Reading reading{std::vector<SmoothedPose>(images.size()), std::vector<std::vector<int>>(images.size())};
  PoseGaussian pose = last;
  for (std::size_t i = images.size(); i-- > 0;) {
    reading.landmark_of[i] = reader.read(images[i].sightings, pose);
    reading.poses[i] = SmoothedPose(pose.T_map_body);
    if (i == 0) break;
    const MovedPose before = apply(pose.T_map_body, reversed(images[i].motion));
    pose = {before.T_map_body, before.G * pose.covariance * before.G.transpose() + before.noise};
  }
  return reading;
}

}  // namespace azimuth
