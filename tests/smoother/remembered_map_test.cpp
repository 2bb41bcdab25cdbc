// A saved map as a term of the graph.

#include "slam/smoother/remembered_map.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>
#include <random>

#include "slam/smoother/known_names.hpp"

namespace azimuth {
namespace {

/// A map of `landmarks` landmarks around a robot, with fully correlated errors.
MapSnapshot some_map(int landmarks, double sigma_m = 0.05) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  MapSnapshot map;
  map.T_map_body = {2.0, -1.0, 0.8};
  map.names = MapNames::sensor;
  for (int i = 0; i < landmarks; ++i) {
    MapLandmark& landmark = map.landmarks.emplace_back();
    landmark.id = 10 + i;
    landmark.identity = 100 + i;
    landmark.sightings = 5;
    const double turn_rad = 6.283 * i / landmarks;
    landmark.p_map_landmark_m = Eigen::Vector2d(2.0 + 3.0 * std::cos(turn_rad), -1.0 + 4.0 * std::sin(turn_rad));
  }
  map.next_id = 10 + landmarks;
  const auto size = static_cast<Eigen::Index>(map.entries());
  Eigen::MatrixXd A(size, size + 3);
  for (Eigen::Index i = 0; i < A.size(); ++i) A.data()[i] = normal(random);
  const Eigen::MatrixXd P = sigma_m * sigma_m / static_cast<double>(size) * A * A.transpose();
  map.covariance.resize(map.entries());
  for (Eigen::Index c = 0; c < size; ++c)
    for (Eigen::Index r = c; r < size; ++r)
      map.covariance(static_cast<std::size_t>(r), static_cast<std::size_t>(c)) = P(r, c);
  return map;
}

/// Joint covariance of the newest pose and all landmarks, in the map frame.
Eigen::MatrixXd covariance_in_map(const Smoother& smoother, const std::vector<LandmarkId>& landmarks) {
  std::vector<Smoother::Unknown> unknowns{Smoother::PoseOf{smoother.graph().poses() - 1}};
  for (const LandmarkId id : landmarks) unknowns.push_back(Smoother::LandmarkOf{id});
  const Eigen::MatrixXd P = smoother.covariance(unknowns);
  Eigen::MatrixXd to_map = Eigen::MatrixXd::Identity(P.rows(), P.cols());
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 + 2 * i);
    to_map.block<2, 2>(at, at) = smoother.graph().landmark(landmarks[i]).p_by_chart();
  }
  return to_map * P * to_map.transpose();
}

TEST(RememberedMap, IsKnownAsWellAsItWasWhenItWasSaved) {
  const MapSnapshot map = some_map(7);
  Smoother smoother{SmootherSettings{}};
  const Eigen::Matrix3d moved = Eigen::Vector3d(0.01, 0.02, 0.005).asDiagonal();
  const std::vector<LandmarkId> landmarks = remember(map, moved, smoother);
  ASSERT_EQ(landmarks.size(), map.landmarks.size());
  EXPECT_LT((smoother.newest_pose().vector() - map.T_map_body.vector()).norm(), 1e-9);
  for (std::size_t i = 0; i < landmarks.size(); ++i)
    EXPECT_LT((smoother.graph().landmark(landmarks[i]).p_map() - map.landmarks[i].p_map_landmark_m).norm(), 1e-9);
  const Eigen::MatrixXd P = covariance_in_map(smoother, landmarks);
  for (Eigen::Index c = 0; c < P.cols(); ++c)
    for (Eigen::Index r = 0; r < P.rows(); ++r) {
      const double more = r < 3 && c < 3 ? moved(r, c) : 0.0;
      EXPECT_NEAR(P(r, c), map.covariance(static_cast<std::size_t>(r), static_cast<std::size_t>(c)) + more, 1e-8);
    }
}

TEST(RememberedMap, OfARobotThatIsAnywhereOnlyLandmarksAreKnown) {
  const MapSnapshot map = some_map(5);
  Smoother smoother{SmootherSettings{}};
  const std::vector<LandmarkId> landmarks = remember(map, std::nullopt, smoother);
  EXPECT_EQ(smoother.graph().poses(), 1);
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Eigen::Matrix2d P = smoother.point_covariance(landmarks[i]);
    const std::size_t row = map.first_landmark_entry() + 2 * i;
    EXPECT_NEAR(P(0, 0), map.covariance(row, row), 1e-8);
    EXPECT_NEAR(P(1, 0), map.covariance(row + 1, row), 1e-8);
  }
}

TEST(RememberedMap, ItsGradientIsThatOfItsEnergy) {
  const MapSnapshot map = some_map(4, 0.3);
  BearingGraph graph(SmootherSettings{}, {});
  {  // The term alone: the motion to the robot's pose carries hardly any information.
    Smoother smoother{SmootherSettings{}};
    remember(map, Eigen::Matrix3d::Identity().eval(), smoother);
    graph = smoother.graph();
  }
  const Eigen::VectorXd off = 0.05 * Eigen::VectorXd::Ones(graph.rows());
  graph.move(off);
  graph.evaluate();
  const Eigen::VectorXd gradient = graph.gradient();
  constexpr double kStep = 1e-6;
  for (int i = 0; i < graph.rows(); ++i) {
    const auto energy_at = [&](double step) {
      BearingGraph moved = graph;
      Eigen::VectorXd by = Eigen::VectorXd::Zero(graph.rows());
      by[i] = step;
      moved.move(by);
      moved.evaluate();
      return moved.energy();
    };
    EXPECT_NEAR(gradient[i], (energy_at(kStep) - energy_at(-kStep)) / (2.0 * kStep),
                1e-4 * (1.0 + std::abs(gradient[i])))
        << i;
  }
}

TEST(RememberedMap, BearingsCorrectItAndTheRobotInIt) {
  const MapSnapshot map = some_map(6);
  KnownNames names{{}};
  const Eigen::Matrix3d moved = Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal();
  names.remember(map, moved);
  const Eigen::Matrix3d before = names.covariance();
  // GIVEN a robot that is 0.1 m farther ahead
  const Pose2 T_map_body = map.T_map_body * Pose2{0.1, 0.0, 0.0};
  BearingSet set;
  for (const MapLandmark& landmark : map.landmarks) {
    const Eigen::Vector2d p = inverse(T_map_body) * landmark.p_map_landmark_m;
    set.bearings.push_back({.azimuth_rad = std::atan2(p.y(), p.x()), .identity = landmark.identity, .sigma_rad = 0.01});
  }
  set.stamp = Stamp{} + duration_from_seconds(100.0);
  EXPECT_TRUE(names.update(set));
  EXPECT_EQ(names.smoother().graph().landmarks(), 6) << "no new ones";
  EXPECT_LT((names.pose().position() - T_map_body.position()).norm(), 0.03);
  EXPECT_LT(names.covariance().trace(), 0.3 * before.trace());
}

TEST(RememberedMap, GivesNothingUpWhenABearingIsTakenBack) {
  const MapSnapshot map = some_map(5);
  Smoother smoother{SmootherSettings{}};
  const std::vector<LandmarkId> landmarks = remember(map, Eigen::Matrix3d::Identity().eval(), smoother);
  const Eigen::MatrixXd before = covariance_in_map(smoother, landmarks);
  const BearingId bearing = smoother.add_bearing(0.3, 0.01);
  smoother.assign(bearing, landmarks[2]);
  smoother.optimise();
  smoother.assign(bearing, kOfNothing);
  while (!smoother.optimise().converged) continue;
  EXPECT_LT((covariance_in_map(smoother, landmarks) - before).norm(), 1e-3 * before.norm());
}

}  // namespace
}  // namespace azimuth
