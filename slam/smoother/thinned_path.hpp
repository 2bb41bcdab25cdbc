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

/// Of poses in the order of arrival, for ever: what a graph calls them changes when it forgets others.
using PoseNumber = std::int32_t;

/// Where the robot was at all poses that a graph has ever had: of those that it has forgotten, what odometry says of
/// the way there from the last one before that is left.
///
/// Thread contract: thread-bound. Copies share what is equal.
class ThinnedPath {
 public:
  /// Of a graph that has its first pose.
  ThinnedPath() { add_pose(); }

  /// The graph has a newest one.
  void add_pose();
  /// The graph is about to forget these, ascending.
  void forget(const BearingGraph& graph, std::span<const PoseId> poses);

  PoseNumber newest() const { return places_.size() - 1; }
  /// Of the graph's poses.
  const std::vector<PoseNumber>& numbers() const { return numbers_; }

  struct Told {
    Pose2 T_map_body;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad]) in the map
  };
  /// As of the last optimise().
  Told tell(PoseNumber number, const Smoother& smoother) const;

 private:
  /// A pose as seen from an earlier one: from itself as long as the graph has it.
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
