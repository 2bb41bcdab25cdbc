// Landmarks above the robot, whose bearings have elevations.

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "slam/geometry/random.hpp"
#include "slam/smoother/smoother.hpp"
#include "tests/support/batch_solution.hpp"

namespace azimuth {
namespace {

constexpr double kSigma_rad = 0.01;

SmootherSettings exactly_solved(bool charts_go_along = true) {
  SmootherSettings settings;
  settings.converged_below = 1e-18;
  settings.charts_go_along = charts_go_along;
  return settings;
}

/// A robot drives a circle under lamps; posts at the height of the camera have no elevations.
struct LampDrive {
  std::vector<Eigen::Vector3d> lamps{{2.0, 3.0, 3.0},  {-3.0, 1.0, 2.5}, {0.5, -2.0, 4.0},
                                     {4.0, -3.0, 3.5}, {-2.0, 5.0, 2.0}, {1.0, 1.0, 5.0}};
  std::vector<Eigen::Vector2d> posts{{5.0, 5.0}, {-4.0, -4.0}};
  Smoother smoother;
  RandomNumbers<SplitMix> noise;
  std::vector<LandmarkId> landmarks;
  Pose2 T_map_body;

  explicit LampDrive(std::uint64_t seed, const SmootherSettings& settings = exactly_solved())
      : smoother(settings), noise{SplitMix(seed)}, landmarks(lamps.size() + posts.size(), kOfNothing) {}

  void drive_on() {
    Motion motion;
    motion.T_start_end = {0.25 + noise.normal(0.01), noise.normal(0.005), 0.08 + noise.normal(0.01)};
    motion.covariance.diagonal() << 1e-4, 0.25e-4, 1e-4;
    T_map_body = T_map_body * Pose2{0.25, 0.0, 0.08};
    smoother.add_pose(motion);
  }
  void look() {
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const bool is_lamp = i < lamps.size();
      const Eigen::Vector2d p =
          inverse(T_map_body) * (is_lamp ? Eigen::Vector2d(lamps[i].head<2>()) : posts[i - lamps.size()]);
      const double azimuth_rad = std::atan2(p.y(), p.x()) + noise.normal(kSigma_rad);
      std::optional<MeasuredElevation> elevation;
      if (is_lamp) elevation = {std::atan2(lamps[i].z(), p.norm()) + noise.normal(kSigma_rad), kSigma_rad};
      const BearingId bearing = smoother.add_bearing(azimuth_rad, kSigma_rad, elevation);
      if (landmarks[i] == kOfNothing)
        landmarks[i] = smoother.add_landmark(bearing);
      else
        smoother.assign(bearing, landmarks[i]);
    }
  }
  void run(int images, int iterations) {
    look();
    for (int image = 1; image < images; ++image) {
      drive_on();
      look();
      smoother.optimise(iterations);
    }
  }
};

void expect_batch(const LampDrive& drive, const SmootherSettings& settings) {
  BatchProblem batch(drive.smoother.graph(), settings);
  ASSERT_GT(batch.solve(), 0);
  EXPECT_LT(largest_difference(batch.values(), drive.smoother.graph().values()), 1e-6);
  EXPECT_NEAR(batch.energy(), drive.smoother.energy(), 1e-7 * (1.0 + batch.energy()));
}

TEST(Heights, AreSolvedAsABatch) {
  for (const bool charts_go_along : {false, true}) {
    LampDrive drive(1, exactly_solved(charts_go_along));
    drive.run(80, 4);
    drive.smoother.optimise(100);
    expect_batch(drive, exactly_solved(charts_go_along));
  }
}

TEST(Heights, GoWithWhatBearingsAreTakenFor) {
  LampDrive drive(2);
  drive.run(40, 4);
  Smoother& smoother = drive.smoother;
  // GIVEN one lamp that is removed, one that loses half of its bearings, and one whose bearings move to another lamp
  const auto take = [&](LandmarkId from, LandmarkId to, int of_each) {
    const std::vector<BearingId> bearings = smoother.graph().bearings_of(from);
    for (std::size_t i = 0; i < bearings.size(); i += static_cast<std::size_t>(of_each))
      smoother.assign(bearings[i], to);
  };
  take(drive.landmarks[0], kOfNothing, 1);
  take(drive.landmarks[1], kOfNothing, 2);
  const LandmarkId again = smoother.add_landmark(smoother.graph().bearings_of(drive.landmarks[2]).front());
  take(drive.landmarks[2], again, 1);
  smoother.optimise(100);
  EXPECT_EQ(smoother.graph().elevations_of(drive.landmarks[0]), 0);
  EXPECT_TRUE(std::isnan(smoother.graph().height_m(drive.landmarks[0])));
  EXPECT_EQ(smoother.graph().elevations_of(again), 40);
  expect_batch(drive, exactly_solved());
  // AND when the removed lamp returns
  drive.landmarks[2] = again;
  drive.run(10, 4);
  smoother.optimise(100);
  EXPECT_EQ(smoother.graph().elevations_of(drive.landmarks[0]), 10);
  expect_batch(drive, exactly_solved());
}

TEST(Heights, AreThereAfterPosesAreForgotten) {
  LampDrive drive(3);
  drive.run(60, 4);
  std::vector<PoseId> poses;
  for (PoseId id = 1; id < 40; ++id)
    if (id % 3 != 0) poses.push_back(id);
  drive.smoother.forget(poses);
  drive.smoother.optimise(100);
  EXPECT_EQ(drive.smoother.graph().elevations_of(drive.landmarks[0]), 60 - static_cast<int>(poses.size()));
  expect_batch(drive, exactly_solved());
  drive.run(10, 4);
  drive.smoother.optimise(100);
  expect_batch(drive, exactly_solved());
}

TEST(Heights, CovarianceIsThatOfTheBatch) {
  LampDrive drive(4);
  drive.run(30, 4);
  drive.smoother.optimise(100);
  BatchProblem batch(drive.smoother.graph(), exactly_solved());
  ASSERT_GT(batch.solve(), 0);
  // A live factor contains linearisations from earlier images. The comparison needs all of it at the current values.
  drive.smoother.start_factor_anew();
  drive.smoother.optimise(1);
  const Eigen::MatrixXd H = Eigen::MatrixXd(batch.normal().H).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd P = H.inverse();
  for (const std::size_t i : {0U, 3U, 5U}) {
    const LandmarkId id = drive.landmarks[i];
    const Eigen::Index row = batch.row_of_landmark(id);
    const SmoothedLandmark& landmark = drive.smoother.graph().landmark(id);
    const double rho = landmark.inverse_distance_per_m, height_m = drive.smoother.graph().height_m(id);
    Eigen::Matrix3d by_chart = Eigen::Matrix3d::Zero();
    by_chart.topLeftCorner<2, 2>() = landmark.p_by_chart();
    by_chart.row(2) << 0.0, -height_m / rho, 1.0 / rho;
    const Eigen::Matrix3d expected = by_chart * P.block<3, 3>(row, row) * by_chart.transpose();
    EXPECT_LT((drive.smoother.point_covariance_with_height(id) - expected).norm(), 1e-6 * expected.norm());
  }
}

TEST(Heights, AreAsSureAsTheirCovarianceSays) {
  constexpr int kDrives = 60;
  double nees = 0.0, heights = 0.0;
  for (std::uint64_t seed = 100; seed < 100 + kDrives; ++seed) {
    LampDrive drive(seed, SmootherSettings{});
    drive.run(50, 4);
    for (std::size_t i = 0; i < drive.lamps.size(); ++i) {
      const LandmarkId id = drive.landmarks[i];
      Eigen::Vector3d off;
      off << drive.smoother.graph().landmark(id).p_map() - drive.lamps[i].head<2>(),
          drive.smoother.graph().height_m(id) - drive.lamps[i].z();
      nees += off.dot(drive.smoother.point_covariance_with_height(id).ldlt().solve(off)) / 3.0;
      heights += 1.0;
    }
  }
  nees /= heights;
  RecordProperty("nees", std::to_string(nees));
  EXPECT_GT(nees, 0.8);
  EXPECT_LT(nees, 1.3);
}

}  // namespace
}  // namespace azimuth
