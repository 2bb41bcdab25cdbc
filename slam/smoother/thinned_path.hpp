#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "slam/smoother/shared_pages.hpp"
#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// Permanent number of a pose in the order of arrival. A PoseId, in contrast, changes when the graph removes other
/// poses.
using PoseNumber = std::int32_t;

/// The path through all poses that a graph has ever had. For a removed pose, the path keeps the odometry from the last
/// remaining pose before it.
///
/// Thread contract: thread-bound. Copies share equal parts.
class ThinnedPath {
 public:
  /// Starts the path of a graph that has only its first pose.
  ThinnedPath() { add_pose(); }

  /// Notes that the graph has a new newest pose.
  void add_pose();
  /// Must be called before the graph removes these poses, ascending.
  void forget(const BearingGraph& graph, std::span<const PoseId> poses);

  PoseNumber newest() const { return places_.size() - 1; }
  /// The permanent number of each of the graph's poses.
  const std::vector<PoseNumber>& numbers() const { return numbers_; }

  struct Told {
    Pose2 T_map_body;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad]) in the map
  };
  /// Pose and covariance as of the smoother's last optimise().
  Told tell(PoseNumber number, const Smoother& smoother) const;

 private:
  /// A pose relative to an earlier pose `from`. A pose that the graph still has is its own `from`.
  struct Place {
    PoseNumber from = 0;
    std::array<float, 6> covariance{};  // lower triangle
    std::array<double, 3> relative{};
  };
  struct Way {
    PoseNumber from = 0;
    Eigen::Vector3d relative = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };
  Way way_to(PoseNumber number) const;
  static Told between(const Way& way, PoseId start, const Smoother& smoother);

  SharedPages<Place> places_;
  std::vector<PoseNumber> numbers_;
};

}  // namespace azimuth
