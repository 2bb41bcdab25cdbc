// Compares every Jacobian of the measurement and of the initialisation with numeric differentiation.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "slam/ekf/relinearisation.hpp"
#include "slam/ekf/triangulation.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr int kJacobianDraws = 250;
constexpr double kMinDistance_m = 0.05;

Pose2 pose_at(const Eigen::VectorXd& x, Index block) { return {x(block), x(block + 1), x(block + 2)}; }

// ---- The azimuth of a point ----

void expect_point_jacobians_match(const Pose2& pose, const Eigen::Vector2d& landmark) {
  const auto azimuth = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd::Constant(
        1, predict_bearing(pose_at(x, 0), Eigen::Vector2d(x.tail<2>()), kMinDistance_m)->azimuth_rad);
  };
  Eigen::VectorXd x(5);
  x << pose.vector(), landmark;
  const Eigen::MatrixXd numeric = numeric_jacobian(azimuth, x, {0});
  const auto predicted = predict_bearing(pose, landmark, kMinDistance_m);
  ASSERT_TRUE(predicted);
  EXPECT_LT(largest_difference(predicted->by_pose, numeric.leftCols<3>()), kJacobianTolerance);
  EXPECT_LT(largest_difference(predicted->by_landmark, numeric.rightCols<2>()), kJacobianTolerance);
}

TEST(PointBearing, JacobiansAtIdentityTinyAndRandom) {
  RandomDraws draws(41);
  expect_point_jacobians_match({}, {1.0, 0.0});
  for (int i = 0; i < kJacobianDraws; ++i) {
    const Eigen::Vector2d offset =
        draws.uniform(0.4, 15.0) * Eigen::Rotation2Dd(draws.uniform(-kPi, kPi)).toRotationMatrix().col(0);
    const Pose2 tiny = draws.pose(1e-6), anywhere = draws.pose(20.0);
    expect_point_jacobians_match(tiny, offset);
    expect_point_jacobians_match(anywhere, anywhere.position() + offset);
  }
}

TEST(PointBearing, IsRefusedWithinTheMinimumDistance) {
  EXPECT_FALSE(predict_bearing(Pose2{}, Eigen::Vector2d(0.049, 0.0), kMinDistance_m));
  EXPECT_TRUE(predict_bearing(Pose2{}, Eigen::Vector2d(0.051, 0.0), kMinDistance_m));
  EXPECT_FALSE(predict_bearing(Pose2{}, Eigen::Vector2d(0.0, 0.0), 0.0));
}

// ---- The azimuth of a ray in inverse depth ----

InverseDepth ray_at(const Eigen::VectorXd& x, Index block) { return {x.segment<2>(block), x(block + 2), x(block + 3)}; }

void expect_ray_jacobians_match(const Pose2& pose, const InverseDepth& ray) {
  const auto azimuth = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd::Constant(1, predict_bearing(pose_at(x, 0), ray_at(x, 3), kMinDistance_m)->azimuth_rad);
  };
  Eigen::VectorXd x(7);
  x << pose.vector(), ray.anchor, ray.bearing_rad, ray.inverse_distance_per_m;
  const auto predicted = predict_bearing(pose, ray, kMinDistance_m);
  ASSERT_TRUE(predicted);
  const Eigen::MatrixXd numeric = numeric_jacobian(azimuth, x, {0}, 2e-4);
  EXPECT_LT(largest_difference(predicted->by_pose, numeric.leftCols<3>()), kJacobianTolerance);
  EXPECT_LT(largest_difference(predicted->by_landmark, numeric.rightCols<4>()), kJacobianTolerance);
}

/// Whether the landmark is far enough from the robot for numeric differentiation.
bool is_benign(const Pose2& pose, const InverseDepth& ray) {
  return (ray.inverse_distance_per_m * (ray.anchor - pose.position()) + ray.direction()).norm() > 0.3;
}

TEST(RayBearing, JacobiansAtIdentityTinyAndRandom) {
  RandomDraws draws(42);
  expect_ray_jacobians_match({}, {Eigen::Vector2d::Zero(), 0.0, 0.0});
  int checked = 0;
  for (int i = 0; checked < 3 * kJacobianDraws; ++i) {
    const double extent_m = i % 2 == 0 ? 1e-6 : 8.0;
    const Pose2 pose = draws.pose(extent_m);
    for (const double rho_per_m : {draws.uniform(0.0, 2.0), 0.0, -draws.uniform(0.0, 0.5)}) {
      const InverseDepth ray{draws.point(extent_m), draws.uniform(-kPi, kPi), rho_per_m};
      if (!is_benign(pose, ray)) continue;
      expect_ray_jacobians_match(pose, ray);
      ++checked;
    }
  }
}

TEST(RayBearing, IsThatOfThePointItDescribes) {
  RandomDraws draws(43);
  for (int i = 0; i < kJacobianDraws; ++i) {
    const Pose2 pose = draws.pose(5.0);
    const InverseDepth ray{draws.point(5.0), draws.uniform(-kPi, kPi), draws.uniform(0.05, 2.0)};
    if (!is_benign(pose, ray)) continue;
    const auto by_ray = predict_bearing(pose, ray, kMinDistance_m);
    const auto by_point = predict_bearing(pose, point_of(ray), kMinDistance_m);
    ASSERT_TRUE(by_ray && by_point);
    EXPECT_NEAR(wrap(by_ray->azimuth_rad - by_point->azimuth_rad), 0.0, 1e-12);
    EXPECT_LT(largest_difference(by_ray->by_pose, by_point->by_pose), 1e-9);
  }
}

TEST(RayBearing, PassesSmoothlyThroughInfinity) {
  const Pose2 pose{1.0, 2.0, 0.3};
  const auto at = [&](double rho_per_m) {
    return predict_bearing(pose, InverseDepth{{0.0, 0.0}, 0.7, rho_per_m}, kMinDistance_m)->azimuth_rad;
  };
  EXPECT_NEAR(at(0.0), 0.4, 1e-15) << "at infinity the direction is the ray's own";
  EXPECT_NEAR(at(1e-9) - at(0.0), at(0.0) - at(-1e-9), 1e-15);
}

TEST(RayBearing, IsRefusedWithinTheMinimumDistance) {
  const InverseDepth ray{{0.0, 0.0}, 0.0, 0.5};  // the point (2, 0)
  EXPECT_FALSE(predict_bearing(Pose2{2.04, 0.0, 0.0}, ray, kMinDistance_m));
  EXPECT_TRUE(predict_bearing(Pose2{2.06, 0.0, 0.0}, ray, kMinDistance_m));
}

TEST(RayPoint, JacobianMatches) {
  RandomDraws draws(44);
  const auto point = [](const Eigen::VectorXd& x) { return point_of(ray_at(x, 0)); };
  for (int i = 0; i < kJacobianDraws; ++i) {
    Eigen::Vector4d x;
    x << draws.point(10.0), draws.uniform(-kPi, kPi), draws.uniform(0.2, 2.0);
    if (i % 10 == 0) x(3) = -x(3);
    Eigen::Matrix<double, 2, 4> jacobian;
    point_of(ray_at(x, 0), &jacobian);
    EXPECT_LT(largest_difference(jacobian, numeric_jacobian(point, x, {}, 1e-4)), kJacobianTolerance);
  }
}

// ---- One row of the update: from the robot and from clones, with the camera's yaw and centre as states ----

constexpr Index kClone = 3, kPoint = 6, kRay = 8, kYawEntry = 12, kCentre = 13, kJacobianSize = 15;

Eigen::RowVectorXd dense(const ObservationRow& row) {
  Eigen::RowVectorXd h = Eigen::RowVectorXd::Zero(kJacobianSize);
  for (int p = 0; p < row.count; ++p) {
    const auto& part = row.parts[static_cast<std::size_t>(p)];
    for (Index i = 0; i < part.size; ++i) h(part.offset + i) += part.coefficients[static_cast<std::size_t>(i)];
  }
  return h;
}

Eigen::VectorXd random_state(RandomDraws& draws) {
  Eigen::VectorXd x(kJacobianSize);
  x << draws.pose(3.0).vector(), draws.pose(3.0).vector(), draws.point(8.0), draws.point(3.0), draws.uniform(-kPi, kPi),
      draws.uniform(-0.2, 0.6), draws.uniform(-0.5, 0.5), draws.point(12.0);
  return x;
}

bool is_benign(const MappedSighting& sighting, const Eigen::VectorXd& x) {
  const Pose2 pose = pose_at(x, sighting.pose);
  if (sighting.kind == BlockKind::point) return (x.segment<2>(kPoint) - pose.position()).norm() > 0.4;
  return is_benign(pose, ray_at(x, kRay));
}

TEST(Linearise, RowIsMinusTheDerivativeOfTheInnovation) {
  RandomDraws draws(45);
  int checked = 0;
  while (checked < 4 * kJacobianDraws) {
    const Eigen::VectorXd x = random_state(draws);
    MappedSighting sighting;
    sighting.pose = draws.chance(0.5) ? JointState::kPose : kClone;
    sighting.kind = draws.chance(0.5) ? BlockKind::point : BlockKind::inverse_depth;
    sighting.landmark = sighting.kind == BlockKind::point ? kPoint : kRay;
    sighting.azimuth_rad = draws.uniform(-kPi, kPi);
    sighting.variance_rad2 = 0.01;
    if (!is_benign(sighting, x)) continue;
    if (draws.chance(0.7)) sighting.radius_px = draws.uniform(40.0, 400.0);
    CameraOffsets offsets{0.3, std::nullopt, std::nullopt};
    if (draws.chance(0.5)) offsets.yaw_block = kYawEntry;
    if (draws.chance(0.5)) offsets.errors_block = kCentre;

    const auto row_at = [&](const Eigen::VectorXd& at) {
      return *linearise(sighting, offsets, kMinDistance_m, [&](Index entry) { return at(entry); });
    };
    const auto innovation = [&](const Eigen::VectorXd& at) {
      return Eigen::VectorXd::Constant(1, row_at(at).innovation);
    };
    const Eigen::MatrixXd numeric = -numeric_jacobian(innovation, x, {0}, 2e-4);
    EXPECT_LT(largest_difference(dense(row_at(x)), numeric), kJacobianTolerance);
    EXPECT_EQ(row_at(x).variance, 0.01);
    ++checked;
  }
}

TEST(Linearise, ConstantYawTurnsTheMeasurement) {
  const Eigen::VectorXd x = (Eigen::VectorXd(5) << 0.0, 0.0, 0.1, 3.0, 0.0).finished();
  const MappedSighting sighting{JointState::kPose, 3, BlockKind::point, 0.25, 1.0};
  const auto row = linearise(sighting, CameraOffsets{0.05, std::nullopt, std::nullopt}, kMinDistance_m,
                             [&](Index i) { return x(i); });
  EXPECT_NEAR(row->innovation, 0.25 + 0.05 - (0.0 - 0.1), 1e-15);
  EXPECT_EQ(row->count, 2);
}

TEST(Linearise, TheCentresOffsetTurnsABearingAsAnImageWithAnotherCentreWould) {
  // The radius and azimuth refer to the assumed centre. The true centre is 10 px away towards azimuth 0.
  const Eigen::VectorXd x = (Eigen::VectorXd(7) << 0.0, 0.0, 0.0, 3.0, 0.0, 10.0, 0.0).finished();
  MappedSighting sighting{JointState::kPose, 3, BlockKind::point, kPi / 2, 1.0};
  sighting.radius_px = 100.0;
  const CameraOffsets offsets{0.0, std::nullopt, 5};
  const auto row = linearise(sighting, offsets, kMinDistance_m, [&](Index i) { return x(i); });
  EXPECT_NEAR(row->innovation, kPi / 2 + std::atan2(10.0, 100.0), 1e-15);
}

TEST(Linearise, ABearingWithoutARadiusDoesNotCareForTheCentre) {
  const Eigen::VectorXd x = (Eigen::VectorXd(7) << 0.0, 0.0, 0.0, 3.0, 0.0, 10.0, -7.0).finished();
  const MappedSighting sighting{JointState::kPose, 3, BlockKind::point, 0.25, 1.0};
  const auto row = linearise(sighting, {0.0, std::nullopt, 5}, kMinDistance_m, [&](Index i) { return x(i); });
  EXPECT_NEAR(row->innovation, 0.25, 1e-15);
}

// ---- The intersection of two rays: six pose entries and two azimuths ----

TEST(IntersectJacobians, MatchAtRandomGeometries) {
  RandomDraws draws(46);
  const auto point = [](const Eigen::VectorXd& x) {
    return intersect({pose_at(x, 0), x(6)}, {pose_at(x, 3), x(7)})->p_map_landmark_m;
  };
  int checked = 0;
  while (checked < kJacobianDraws) {
    Eigen::VectorXd x(8);
    const double extent_m = checked % 4 == 0 ? 1e-6 : 4.0;  // every fourth trial puts both poses near the origin
    x << draws.pose(extent_m).vector(), draws.pose(extent_m).vector(), draws.uniform(-kPi, kPi),
        draws.uniform(-kPi, kPi);
    const auto meeting = intersect({pose_at(x, 0), x(6)}, {pose_at(x, 3), x(7)});
    if (!meeting || std::abs(meeting->sine) < 0.2) continue;
    const Eigen::MatrixXd numeric = numeric_jacobian(point, x, {}, 2e-4);
    EXPECT_LT(largest_difference(meeting->by_poses, numeric.leftCols<6>()), kJacobianTolerance);
    EXPECT_LT(largest_difference(meeting->by_azimuths, numeric.rightCols<2>()), kJacobianTolerance);
    ++checked;
  }
}

TEST(IntersectJacobians, AreTheInverseOfTheMeasurementJacobians) {
  // mathematics I.8: G = -Hf^-1 Hv stacked, W = Hf^-1, and the position parts of G sum to the identity.
  RandomDraws draws(47);
  int checked = 0;
  while (checked < kJacobianDraws) {
    const Pose2 i = draws.pose(5.0), j = draws.pose(5.0);
    const Eigen::Vector2d landmark = draws.point(10.0);
    const auto seen_i = predict_bearing(i, landmark, 0.3), seen_j = predict_bearing(j, landmark, 0.3);
    if (!seen_i || !seen_j) continue;
    const auto meeting = intersect({i, seen_i->azimuth_rad}, {j, seen_j->azimuth_rad});
    if (!meeting || std::abs(meeting->sine) < 0.05) continue;
    EXPECT_LT((meeting->p_map_landmark_m - landmark).norm(), 1e-9);
    EXPECT_TRUE(meeting->valid());
    EXPECT_NEAR(meeting->distance_i_m, (landmark - i.position()).norm(), 1e-9);
    EXPECT_NEAR(meeting->distance_j_m, (landmark - j.position()).norm(), 1e-9);
    Eigen::Matrix2d Hf;
    Hf << seen_i->by_landmark, seen_j->by_landmark;
    Matrix26d Hv = Matrix26d::Zero();
    Hv.block<1, 3>(0, 0) = seen_i->by_pose;
    Hv.block<1, 3>(1, 3) = seen_j->by_pose;
    EXPECT_LT(largest_difference(meeting->by_azimuths, Hf.inverse()), 1e-8);
    EXPECT_LT(largest_difference(meeting->by_poses, -Hf.inverse() * Hv), 1e-8);
    const Eigen::Matrix2d shares = meeting->by_poses.block<2, 2>(0, 0) + meeting->by_poses.block<2, 2>(0, 3);
    EXPECT_LT((shares - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff(), 1e-9);
    ++checked;
  }
}

}  // namespace
}  // namespace azimuth
