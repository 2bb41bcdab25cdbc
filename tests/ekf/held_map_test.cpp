// A filter that holds its map fixed is compared with the gain of Schmidt's filter in Joseph form. A map restored from a
// snapshot is compared with the saved one.

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <numeric>

#include "slam/ekf/bearing_ekf.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr double kSigmaSighting_rad = 0.02;
constexpr Index kFree = 6;  // entries of the pose, the yaw and the image centre

/// Points around a robot near the origin, all correlated with the robot, with each other and with the camera's offsets.
MapSnapshot correlated_map(RandomDraws& draws, std::size_t landmarks) {
  MapSnapshot map;
  map.T_map_body = draws.pose(0.5);
  map.camera = {0.02, 1.5, -2.0};
  for (std::size_t i = 0; i < landmarks; ++i) {
    const double direction_rad = draws.uniform(-kPi, kPi), distance_m = draws.uniform(3.0, 8.0);
    map.landmarks.push_back(
        {.id = static_cast<std::int64_t>(i),
         .p_map_landmark_m = distance_m * Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad))});
  }
  const Eigen::MatrixXd P = draws.covariance(static_cast<Index>(map.entries()), 0.05);
  map.covariance.resize(map.entries());
  for (std::size_t c = 0; c < map.entries(); ++c)
    for (std::size_t r = c; r < map.entries(); ++r)
      map.covariance(r, c) = P(static_cast<Index>(r), static_cast<Index>(c));
  return map;
}

BearingEkfSettings with_offsets(int iterations = 1) {
  BearingEkfSettings settings;
  settings.estimate_yaw = true;
  settings.sigma_yaw_rad = 0.1;
  settings.sigma_centre_px = 10.0;
  settings.max_iterations = iterations;
  settings.iterate_below_heading_rad = 10.0;
  return settings;
}

Eigen::MatrixXd covariance_of(const JointState& state) {
  std::vector<Index> all(static_cast<std::size_t>(state.extent()));
  std::iota(all.begin(), all.end(), 0);
  Eigen::MatrixXd P(state.extent(), state.extent());
  state.covariance(all, all, P);
  return P;
}

Eigen::VectorXd mean_of(const JointState& state) {
  return Eigen::VectorXd::NullaryExpr(state.extent(), [&](Index i) { return state.mean(i); });
}

std::vector<MappedSighting> sightings_of(const BearingEkf& ekf, const std::vector<Index>& blocks, RandomDraws& draws) {
  std::vector<MappedSighting> sightings;
  for (const Index block : blocks) {
    MappedSighting sighting{.landmark = block,
                            .variance_rad2 = kSigmaSighting_rad * kSigmaSighting_rad,
                            .radius_px = draws.uniform(50.0, 200.0)};
    sighting.azimuth_rad = wrap(-ekf.linearise(sighting)->innovation + draws.normal(3.0 * kSigmaSighting_rad));
    sightings.push_back(sighting);
  }
  return sightings;
}

/// Schmidt's gain: the optimal gain with the rows of the held entries set to zero. Joseph's form holds for any gain.
struct ConsideredMap {
  Eigen::VectorXd mean;
  Eigen::MatrixXd P;

  ConsideredMap(const BearingEkf& ekf, const std::vector<MappedSighting>& sightings)
      : mean(mean_of(ekf.state())), P(covariance_of(ekf.state())) {
    const auto rows = static_cast<Index>(sightings.size());
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows, P.cols()), R = Eigen::MatrixXd::Zero(rows, rows);
    Eigen::VectorXd innovation(rows);
    for (Index k = 0; k < rows; ++k) {
      const ObservationRow row = *ekf.linearise(sightings[static_cast<std::size_t>(k)]);
      for (int p = 0; p < row.count; ++p) {
        const auto& part = row.parts[static_cast<std::size_t>(p)];
        for (Index i = 0; i < part.size; ++i) H(k, part.offset + i) += part.coefficients[static_cast<std::size_t>(i)];
      }
      R(k, k) = row.variance;
      innovation(k) = row.innovation;
    }
    Eigen::MatrixXd K = P * H.transpose() * (H * P * H.transpose() + R).inverse();
    K.bottomRows(P.rows() - kFree).setZero();
    mean += K * innovation;
    mean(2) = wrap(mean(2));
    const Eigen::MatrixXd kept = Eigen::MatrixXd::Identity(P.rows(), P.cols()) - K * H;
    P = kept * P * kept.transpose() + K * R * K.transpose();
  }
};

TEST(HeldMap, IsConsideredButNotCorrected) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RandomDraws draws(seed);
    BearingEkf ekf(with_offsets());
    const std::vector<Index> blocks = ekf.restore(correlated_map(draws, 7));
    ekf.hold_map();
    const Eigen::VectorXd mean_before = mean_of(ekf.state());
    const Eigen::MatrixXd P_before = covariance_of(ekf.state());
    const auto sightings = sightings_of(ekf, blocks, draws);
    const ConsideredMap expected(ekf, sightings);
    ASSERT_TRUE(ekf.update(sightings));
    const Index held = ekf.state().extent() - kFree;
    EXPECT_LT((mean_of(ekf.state()) - expected.mean).cwiseAbs().maxCoeff(), 1e-9) << seed;
    EXPECT_LT((covariance_of(ekf.state()) - expected.P).cwiseAbs().maxCoeff(), 1e-12) << seed;
    EXPECT_EQ(mean_of(ekf.state()).tail(held), mean_before.tail(held)) << "to the last bit";
    EXPECT_EQ(covariance_of(ekf.state()).bottomRightCorner(held, held), P_before.bottomRightCorner(held, held));
    EXPECT_LT(ekf.state().covariance(0, 0), P_before(0, 0)) << "and the pose gains by it";
  }
}

TEST(HeldMap, IsNotMovedByTheIteratedUpdateEither) {
  // GIVEN exact bearings of a certain map, and a pose that is off by a few standard deviations
  RandomDraws draws(3);
  MapSnapshot map = correlated_map(draws, 7);
  const Pose2 truth = map.T_map_body;
  map.camera = {};
  map.covariance.resize(map.entries());
  for (const std::size_t i : {0, 1, 2}) map.covariance(i, i) = 0.04;
  map.T_map_body = {truth.x_m + 0.3, truth.y_m - 0.2, wrap(truth.heading_rad + 0.25)};
  BearingEkfSettings settings = with_offsets(10);
  settings.estimate_yaw = false;
  settings.sigma_centre_px = 0.0;
  BearingEkf ekf(settings);
  const std::vector<Index> blocks = ekf.restore(map);
  ekf.hold_map();
  const Eigen::VectorXd before = mean_of(ekf.state());
  std::vector<MappedSighting> sightings;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    sightings.push_back({.landmark = blocks[i],
                         .azimuth_rad = predict_bearing(truth, map.landmarks[i].p_map_landmark_m, 0.0)->azimuth_rad,
                         .variance_rad2 = 1e-8});
  // WHEN the bearings correct the pose
  ASSERT_TRUE(ekf.update(sightings));
  // THEN the pose is the true one, which a single linearisation would miss by far, and the map has not moved
  EXPECT_LT((ekf.state().pose().vector() - truth.vector()).norm(), 1e-4);
  EXPECT_EQ(mean_of(ekf.state()).tail(before.size() - 3), before.tail(before.size() - 3));
}

TEST(RestoredMap, IsTheOneThatWasSaved) {
  RandomDraws draws(5);
  const MapSnapshot map = correlated_map(draws, 9);
  BearingEkf ekf(with_offsets());
  const std::vector<Index> blocks = ekf.restore(map);
  ASSERT_EQ(blocks.size(), 9u);
  std::vector<Index> all(map.entries());
  std::iota(all.begin(), all.end(), 0);
  PackedSymmetric P;
  ekf.state().covariance(all, P);
  EXPECT_EQ(P, map.covariance);
  EXPECT_EQ(ekf.state().pose(), map.T_map_body);
  EXPECT_EQ(ekf.yaw_offset_rad(), map.camera[0]);
  EXPECT_EQ(ekf.camera_errors()->centre().mean_px, Eigen::Vector2d(map.camera[1], map.camera[2]));
  for (std::size_t i = 0; i < blocks.size(); ++i)
    EXPECT_EQ(ekf.state().position(blocks[i]), map.landmarks[i].p_map_landmark_m);
}

TEST(RestoredMap, LeavesTheCameraAloneWhenTheOtherFilterEstimatedSomethingElse) {
  RandomDraws draws(6);
  const MapSnapshot map = correlated_map(draws, 4);
  BearingEkfSettings settings = with_offsets();
  settings.estimate_yaw = false;
  BearingEkf ekf(settings);
  const std::vector<Index> blocks = ekf.restore(map);
  EXPECT_EQ(ekf.camera_errors()->centre().mean_px, Eigen::Vector2d::Zero());
  EXPECT_EQ(ekf.camera_errors()->centre().covariance_px2, Eigen::Matrix2d(100.0 * Eigen::Matrix2d::Identity()));
  EXPECT_EQ(ekf.state().covariance(kCameraEntry, blocks[1]), 0.0);
  EXPECT_EQ(ekf.state().covariance(blocks[2], blocks[1]),
            map.covariance(map.first_landmark_entry() + 4, map.first_landmark_entry() + 2));
}

TEST(RestoredMap, ForgetsTheRobotWithoutForgettingTheMap) {
  RandomDraws draws(7);
  const MapSnapshot map = correlated_map(draws, 4);
  BearingEkf ekf(with_offsets());
  ekf.restore(map);
  const Eigen::MatrixXd before = covariance_of(ekf.state());
  ekf.place_robot(ekf.state().pose(), Eigen::Vector3d(9.0, 9.0, 1.0).asDiagonal());
  const Eigen::MatrixXd after = covariance_of(ekf.state());
  EXPECT_EQ(after.topLeftCorner(3, 3), Eigen::MatrixXd(Eigen::Vector3d(9.0, 9.0, 1.0).asDiagonal()));
  EXPECT_EQ(after.block(3, 0, after.rows() - 3, 3).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(after.bottomRightCorner(after.rows() - 3, after.cols() - 3),
            before.bottomRightCorner(before.rows() - 3, before.cols() - 3));
}

}  // namespace
}  // namespace azimuth
