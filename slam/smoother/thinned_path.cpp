#include "slam/smoother/thinned_path.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cstddef>
#include <optional>

namespace azimuth {
namespace {

std::array<float, 6> packed(const Eigen::Matrix3d& P) {
  return {static_cast<float>(P(0, 0)), static_cast<float>(P(1, 0)), static_cast<float>(P(1, 1)),
          static_cast<float>(P(2, 0)), static_cast<float>(P(2, 1)), static_cast<float>(P(2, 2))};
}

Eigen::Matrix3d unpacked(const std::array<float, 6>& packed) {
  const Eigen::Matrix<double, 6, 1> P = Eigen::Map<const Eigen::Matrix<float, 6, 1>>(packed.data()).cast<double>();
  Eigen::Matrix3d whole;
  whole << P[0], P[1], P[3], P[1], P[2], P[4], P[3], P[4], P[5];
  return whole;
}

Eigen::Matrix3d turned_by(double heading_rad) {
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  turned.topLeftCorner<2, 2>() = rotation(heading_rad);
  return turned;
}

Pose2 as_pose(const Eigen::Vector3d& relative) { return {relative.x(), relative.y(), wrap(relative.z())}; }

}  // namespace

void ThinnedPath::add_pose() {
  const PoseNumber number = places_.size();
  places_.push_back({.from = number});
  numbers_.push_back(number);
}

void ThinnedPath::forget(const BearingGraph& graph, std::span<const PoseId> poses) {
  std::vector<PoseNumber> left;
  std::optional<OdometryMeasurement> way;  // odometry from the last remaining pose
  auto next = poses.begin();
  for (PoseId id = 0; id < graph.poses(); ++id) {
    const PoseNumber number = numbers_[static_cast<std::size_t>(id)];
    if (next == poses.end() || *next != id) {
      left.push_back(number);
      way.reset();
      continue;
    }
    ++next;
    way = way ? composed(*way, graph.odometry_to(id)) : graph.odometry_to(id);
    Place& place = places_.edit(number);
    place.from = left.back();
    place.covariance = packed(way->covariance());
    Eigen::Map<Eigen::Vector3d>(place.relative.data()) = way->relative;
  }
  numbers_ = std::move(left);
}

/// The way to a pose from a pose that the graph still has. It follows the chain of places, since a place's reference
/// pose may itself have been removed later.
ThinnedPath::Way ThinnedPath::way_to(PoseNumber number) const {
  Way way{.from = number};
  for (const Place* place = &places_[number]; place->from != way.from; place = &places_[way.from]) {
    const Eigen::Vector3d first = Eigen::Map<const Eigen::Vector3d>(place->relative.data());
    const Eigen::Matrix3d turned = turned_by(first.z());
    const Eigen::Vector3d whole = first + turned * way.relative;
    const Eigen::Matrix3d G = by_first(first, whole);
    way.covariance = G * unpacked(place->covariance) * G.transpose() + turned * way.covariance * turned.transpose();
    way.relative = whole;
    way.from = place->from;
  }
  return way;
}

ThinnedPath::Told ThinnedPath::tell(PoseNumber number, const Smoother& smoother) const {
  const Way way = way_to(number);
  const auto start = static_cast<PoseId>(std::ranges::lower_bound(numbers_, way.from) - numbers_.begin());
  if (way.from == number) return {smoother.graph().pose(start), smoother.pose_covariance(start)};
  return between(way, start, smoother);
}

/// The removed pose lies between a and b, the remaining poses before and after it. Odometry says z with covariance S
/// for the way from a to the removed pose, and o with covariance O for the way from a to b; r is the estimated pose of
/// b relative to a. The error r - o of the whole way is shared out: the part before the removed pose is K (r - o) with
/// K = S J^T O^-1 and J = d(o) / d(z). The remaining covariance is S - K O K^T.
ThinnedPath::Told ThinnedPath::between(const Way& way, PoseId start, const Smoother& smoother) {
  const BearingGraph& graph = smoother.graph();
  const OdometryMeasurement& whole = graph.odometry_to(start + 1);
  const Pose2 &a = graph.pose(start), &b = graph.pose(start + 1);
  const SeenMotion seen = see_motion(SmoothedPose(a), SmoothedPose(b));
  Eigen::Vector3d off = seen.relative - whole.relative;
  off.z() = wrap(off.z());
  const Eigen::Matrix3d K = way.covariance * by_first(way.relative, whole.relative).transpose() *
                            whole.whitening.transpose() * whole.whitening;
  const Eigen::Vector3d relative = way.relative + K * off;

  const Eigen::Matrix3d turned = turned_by(a.heading_rad);
  const Eigen::Matrix3d by_a =
      by_first(Eigen::Vector3d::Zero(), turned * relative) + turned * K * seen.by_start * turned.transpose();
  const Eigen::Matrix3d by_b = turned * K * seen.by_end * turned_by(b.heading_rad).transpose();
  Eigen::Matrix3d P = turned * (way.covariance - K * whole.covariance() * K.transpose()) * turned.transpose();
  if (start == 0) {  // the first pose is a constant
    P += by_b * smoother.pose_covariance(start + 1) * by_b.transpose();
  } else {
    const std::array<Smoother::Unknown, 2> ends{Smoother::PoseOf{start}, Smoother::PoseOf{start + 1}};
    Eigen::Matrix<double, 3, 6> by_ends;
    by_ends << by_a, by_b;
    P += by_ends * smoother.covariance(ends) * by_ends.transpose();
  }
  return {a * as_pose(relative), P};
}

}  // namespace azimuth
