#include "slam/smoother/remembered_map.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace azimuth {
namespace {

constexpr double kNearest_m = 0.5;
// Standard deviations of a motion that stands for no odometry at all.
constexpr double kAnywhere_m = 1e3, kAnyHeading_rad = 1e2;
// Smallest standard deviation of a remembered entry [m, rad, 1/m]. Smaller ones are fixed by convention, not by
// measurement.
constexpr double kSurest = 1e-6;

/// The landmark in a chart at the map's origin (mathematics VI.21), or beside the origin when the landmark lies there.
/// The most uncertain degree of freedom of a map is a turn about its origin. Such a turn changes all alpha of such
/// charts equally, wherever the landmarks are later corrected to. In any other chart it would depend on the landmark's
/// position, and the linear prior could not follow.
SmoothedLandmark from_origin(const Eigen::Vector2d& p_map) {
  const bool is_far = p_map.norm() > kNearest_m;
  const Eigen::Vector2d chart = is_far ? Eigen::Vector2d(0.0, 0.0) : Eigen::Vector2d(p_map.x() - 1.0, p_map.y());
  const Eigen::Vector2d there = p_map - chart;
  return {chart, std::atan2(there.y(), there.x()), 1.0 / there.norm()};
}

void add_robot(const Pose2& T_map_body, Smoother& smoother) {
  Motion motion;
  motion.T_start_end = inverse(smoother.newest_pose()) * T_map_body;
  motion.covariance = Eigen::Vector3d(kAnywhere_m, kAnywhere_m, kAnyHeading_rad).cwiseAbs2().asDiagonal();
  smoother.add_pose(motion);
}

}  // namespace

std::vector<LandmarkId> remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved,
                                 Smoother& smoother) {
  Remembered known;
  std::vector<Eigen::Index> entries;
  if (moved) {
    add_robot(map.T_map_body, smoother);
    known.pose = smoother.graph().poses() - 1;
    entries = {0, 1, 2};
  }
  const auto size = static_cast<Eigen::Index>(entries.size() + 2 * map.landmarks.size());
  known.mean.resize(size);
  if (moved) known.mean.head<3>() = map.T_map_body.vector();
  Eigen::MatrixXd by_map = Eigen::MatrixXd::Identity(size, size);  // d(entries) / d(pose, points)
  auto saved = static_cast<Eigen::Index>(map.first_landmark_entry());
  for (const MapLandmark& landmark : map.landmarks) {
    const SmoothedLandmark at = from_origin(landmark.p_map_landmark_m);
    const auto first = static_cast<Eigen::Index>(entries.size());
    known.landmarks.push_back(smoother.add_known_landmark(at));
    known.mean.segment<2>(first) << at.direction_rad, at.inverse_distance_per_m;
    by_map.block<2, 2>(first, first) = at.p_by_chart().inverse();
    entries.insert(entries.end(), {saved, saved + 1});
    saved += static_cast<Eigen::Index>(landmark.size());
  }
  Eigen::MatrixXd P(size, size);
  for (Eigen::Index c = 0; c < size; ++c)
    for (Eigen::Index r = 0; r < size; ++r)
      P(r, c) = map.covariance(static_cast<std::size_t>(entries[static_cast<std::size_t>(r)]),
                               static_cast<std::size_t>(entries[static_cast<std::size_t>(c)]));
  if (moved) P.topLeftCorner<3, 3>() += *moved;
  P = by_map * P * by_map.transpose();
  P.diagonal().array() += kSurest * kSurest;
  known.information = P.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
  const std::vector<LandmarkId> landmarks = known.landmarks;
  smoother.remember(std::move(known));
  smoother.optimise();
  return landmarks;
}

}  // namespace azimuth
