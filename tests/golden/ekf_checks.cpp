#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include "slam/ekf/bearing_model.hpp"
#include "slam/ekf/relinearisation.hpp"
#include "tests/golden/checks.hpp"
#include "tests/golden/state_building.hpp"

namespace azimuth::golden {

void check_clone(const GoldenCase& golden) {
  const std::array blocks{BlockKind::scalar};
  BuiltState built = build_state(to_vector(golden.input.at("x")), to_matrix(golden.input.at("P")), blocks);
  const Index clone = built.state.clone_robot();
  // The golden file's order: robot, clone, all earlier entries.
  const std::array<Index, 7> order{0, 1, 2, clone, clone + 1, clone + 2, built.entries[3]};
  expect_near(mean_of(built.state, order), to_vector(golden.expected.at("x")), golden.tolerance, "x");
  expect_near(covariance_of(built.state, order), to_matrix(golden.expected.at("P")), golden.tolerance, "P");
}

void check_bearing(const GoldenCase& golden) {
  const Eigen::Vector2d landmark = to_vector(golden.input.at("xf"));
  const auto predicted = predict_bearing(to_pose(golden.input.at("xv")), landmark, /*min_distance_m=*/0.05);
  ASSERT_TRUE(predicted);
  expect_near(predicted->azimuth_rad, golden.expected.at("h"), golden.tolerance, "h");
  expect_near(predicted->by_pose.transpose(), to_vector(golden.expected.at("Hv")), golden.tolerance, "Hv");
  expect_near(predicted->by_landmark.transpose(), to_vector(golden.expected.at("Hf")), golden.tolerance, "Hf");
}

void check_ekf_update(const GoldenCase& golden) {
  const auto order = golden.input.at("order").get<std::vector<std::string>>();
  const std::vector<BlockKind> blocks(order.size() - 1, BlockKind::point);
  BuiltState built = build_state(to_vector(golden.input.at("x")), to_matrix(golden.input.at("P")), blocks);
  std::map<std::string, Index> landmark_block;
  for (std::size_t i = 1; i < order.size(); ++i) landmark_block[order[i]] = built.entries[3 + 2 * (i - 1)];

  const double sigma_rad = degrees_to_rad(golden.input.at("sigma_deg").get<double>());
  std::vector<ObservationRow> rows;
  for (const auto& z : golden.input.at("Z")) {
    MappedSighting sighting;
    sighting.landmark = landmark_block.at("lm" + std::to_string(z.at(0).get<int>()));
    sighting.azimuth_rad = z.at(1);
    sighting.variance_rad2 = sigma_rad * sigma_rad;
    const auto row = linearise(sighting, CameraOffsets{}, 0.05, [&](Index entry) { return built.state.mean(entry); });
    ASSERT_TRUE(row);
    rows.push_back(*row);
  }
  ASSERT_TRUE(built.state.update(rows, JointState::Retraction::additive));
  expect_near(mean_of(built.state, built.entries), to_vector(golden.expected.at("x")), golden.tolerance, "x");
  expect_near(covariance_of(built.state, built.entries), to_matrix(golden.expected.at("P")), golden.tolerance, "P");
}

}  // namespace azimuth::golden
