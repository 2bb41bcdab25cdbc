// Charts of landmarks that move along with the path.

#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "slam/smoother/smoother.hpp"

namespace azimuth {
namespace {

TEST(Charts, ALandmarkSeenFromElsewhereStaysWhereItIs) {
  const SmoothedLandmark landmark({1.0, 2.0}, 0.7, 0.25);
  for (const Eigen::Vector2d& shift : {Eigen::Vector2d(1e-3, 0.0), Eigen::Vector2d(0.0, 1e-3)}) {
    EXPECT_LT((landmark.seen_from(shift).p_map() - landmark.p_map()).norm(), 1e-6);
    EXPECT_EQ(landmark.seen_from(shift).p_map_chart, landmark.p_map_chart + shift);
  }
  // A landmark at infinity.
  const SmoothedLandmark star = SmoothedLandmark({1.0, 2.0}, 0.7, 0.0).seen_from({5.0, -3.0});
  EXPECT_EQ(star.direction_rad, 0.7);
  EXPECT_EQ(star.inverse_distance_per_m, 0.0);
}

/// A path of 30 m past landmarks whose overall direction is unconstrained.
struct FreeToTurn {
  explicit FreeToTurn(bool charts_go_along)
      : graph(
            [&] {
              SmootherSettings settings;
              settings.charts_go_along = charts_go_along;
              settings.inverse_depth_sigma_per_m = 1e3;  // a very weak prior
              return settings;
            }(),
            {}) {
    for (int i = 0; i < 60; ++i) {
      Motion motion;
      motion.T_start_end = {0.5, 0.0, 0.0};
      motion.covariance = (i == 0 ? 1e6 : 1e-4) * Eigen::Matrix3d::Identity();
      const PoseId pose = graph.add_pose(motion);
      for (int k = 0; k < 12; ++k) {
        const Eigen::Vector2d there(2.5 * k, k % 2 == 0 ? 3.0 : -4.0);
        const Eigen::Vector2d p = inverse(graph.pose(pose)) * there;
        if (p.norm() > 6.0) continue;
        const BearingId bearing = graph.add_bearing(std::atan2(p.y(), p.x()), 0.02);
        if (k >= static_cast<int>(landmarks.size())) {
          landmarks.push_back(graph.add_landmark(bearing));
          places.push_back(there);
        }
        graph.assign(bearing, landmarks[static_cast<std::size_t>(k)]);
      }
    }
    put_landmarks();
  }
  /// Moves the landmarks to their true places.
  void put_landmarks() {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(graph.rows());
    for (std::size_t k = 0; k < landmarks.size(); ++k) {
      const SmoothedLandmark& now = graph.landmark(landmarks[k]);
      const Eigen::Vector2d from_chart = places[k] - now.p_map_chart;
      step.segment<2>(graph.first_row(graph.block_of_landmark(landmarks[k])))
          << wrap(std::atan2(from_chart.y(), from_chart.x()) - now.direction_rad),
          1.0 / from_chart.norm() - now.inverse_distance_per_m;
    }
    graph.move(step);
  }
  /// The step that rotates the path and all landmarks about the first pose.
  Eigen::VectorXd turn(double angle_rad) const {
    const auto turned = [&](const Eigen::Vector2d& p) {
      return Eigen::Vector2d(-angle_rad * p.y(), angle_rad * p.x());
    };
    Eigen::VectorXd step = Eigen::VectorXd::Zero(graph.rows());
    for (PoseId id = 1; id < graph.poses(); ++id)
      step.segment<3>(graph.first_row(graph.block_of_pose(id)))
          << graph.smoothed_pose(id).to_body(turned(graph.pose(id).position())),
          angle_rad;
    for (const LandmarkId id : landmarks) {
      const SmoothedLandmark& landmark = graph.landmark(id);
      step.segment<2>(graph.first_row(graph.block_of_landmark(id))) =
          landmark.p_by_chart().inverse() * turned(landmark.p_map());
    }
    return step;
  }

  BearingGraph graph;
  std::vector<LandmarkId> landmarks;
  std::vector<Eigen::Vector2d> places;
};

TEST(Charts, APathTurnsAsOneWithWhatIsSeenFromIt) {
  for (const bool go_along : {false, true}) {
    FreeToTurn path(go_along);
    path.graph.evaluate();
    ASSERT_LT(path.graph.energy(), 1e-3);
    path.graph.move(path.turn(0.03));
    path.graph.evaluate();
    if (go_along)
      EXPECT_LT(path.graph.energy(), 0.1);
    else
      EXPECT_GT(path.graph.energy(), 5.0);
  }
}

}  // namespace
}  // namespace azimuth
