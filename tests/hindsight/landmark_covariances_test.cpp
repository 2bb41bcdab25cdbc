// The covariances of the landmarks of a large map, which are computed in turn.

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/hindsight/smoother_estimator.hpp"

namespace azimuth {
namespace {

/// Landmarks all round, and a robot that sees all of them from each pose.
struct Crowd {
  explicit Crowd(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double direction_rad = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(count);
      places.emplace_back(6.0 * std::cos(direction_rad), 4.0 * std::sin(direction_rad));
    }
    look();
    for (int pose = 0; pose < 3; ++pose) go_on();
  }
  void go_on() {
    Motion motion;
    motion.T_start_end = {0.4, 0.1, 0.2};
    motion.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();
    smoother.add_pose(motion);
    T_map_body = T_map_body * motion.T_start_end;
    look();
    smoother.optimise(50);
  }
  void look() {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector2d p = inverse(T_map_body) * places[i];
      const BearingId bearing = smoother.add_bearing(std::atan2(p.y(), p.x()), 0.02);
      if (landmarks.size() < places.size()) {
        const LandmarkId landmark = smoother.add_landmark(bearing);
        landmarks.push_back({.id = as_index(i) + 7, .in_graph = landmark});
      } else {
        smoother.assign(bearing, landmarks[i].in_graph);
      }
    }
  }

  Smoother smoother{SmootherSettings{}};
  Pose2 T_map_body;
  std::vector<Eigen::Vector2d> places;
  std::vector<HindsightLandmark> landmarks;
};

TEST(LandmarkCovariances, OfAFewAreThoseOfTheMoment) {
  Crowd crowd(20);
  LandmarkCovariances covariances;
  covariances.refresh(crowd.landmarks, crowd.smoother);
  crowd.go_on();
  for (const HindsightLandmark& landmark : crowd.landmarks)
    EXPECT_EQ(covariances.of(landmark, crowd.smoother), crowd.smoother.point_covariance(landmark.in_graph));
}

TEST(LandmarkCovariances, OfManyAreComputedInTurn) {
  Crowd crowd(LandmarkCovariances::kEachTime + 20);
  const HindsightLandmark &first = crowd.landmarks.front(), &last = crowd.landmarks.back();
  LandmarkCovariances covariances;
  // GIVEN a turn that does not include the last landmark
  covariances.refresh(crowd.landmarks, crowd.smoother);
  const Eigen::Matrix2d before = crowd.smoother.point_covariance(first.in_graph);
  crowd.go_on();
  const Eigen::Matrix2d now = crowd.smoother.point_covariance(first.in_graph);
  ASSERT_LT(now.determinant(), before.determinant());
  // THEN the last landmark's covariance is computed on request, and the first one's is still that of the turn
  EXPECT_EQ(covariances.of(last, crowd.smoother), crowd.smoother.point_covariance(last.in_graph));
  EXPECT_EQ(covariances.of(first, crowd.smoother), before);
  // AND one image later the first covariance is that of the new image
  covariances.refresh(crowd.landmarks, crowd.smoother);
  EXPECT_EQ(covariances.of(first, crowd.smoother), now);
}

TEST(LandmarkCovariances, OfALandmarkPlantedAnewIsNotThatOfTheOldOne) {
  Crowd crowd(LandmarkCovariances::kEachTime + 1);
  LandmarkCovariances covariances;
  covariances.refresh(crowd.landmarks, crowd.smoother);
  HindsightLandmark anew = crowd.landmarks.front();
  anew.in_graph = crowd.landmarks.back().in_graph;
  EXPECT_EQ(covariances.of(anew, crowd.smoother), crowd.smoother.point_covariance(anew.in_graph));
}

}  // namespace
}  // namespace azimuth
