#include "tests/ekf/state_twins.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/geometry/numeric_jacobian.hpp"

namespace azimuth {

void Twins::add(BlockKind kind) {
  // The new block depends on the robot and on one other block, as an intersection of two rays does.
  const std::size_t other = static_cast<std::size_t>(draws_.integer(0, static_cast<int>(size()) - 1));
  std::vector<Index> sources{0, 1, 2}, dense_sources{0, 1, 2};
  for (Index i = 0; other > 0 && i < size_of(dense.blocks[other].kind); ++i) {
    sources.push_back(offsets_[other] + i);
    dense_sources.push_back(dense.blocks[other].first + i);
  }
  const Index size = size_of(kind);
  const Eigen::VectorXd mean = 0.5 * draws_.normals(size);
  const Eigen::MatrixXd noise = draws_.covariance(size, 0.1);
  Eigen::MatrixXd J(size, static_cast<Index>(sources.size()));
  Eigen::MatrixXd J_dense = Eigen::MatrixXd::Zero(size, dense.x.size());
  for (std::size_t s = 0; s < sources.size(); ++s) {
    J.col(static_cast<Index>(s)) = 0.5 * draws_.normals(size);
    J_dense.col(dense_sources[s]) = J.col(static_cast<Index>(s));
  }
  offsets_.push_back(state.add(kind, mean, sources, J, noise));
  dense.add(kind, mean, J_dense, noise);
}

/// Promotes an inverse depth or an inverse height to the point that it describes.
void Twins::promote_one() {
  std::vector<std::size_t> rays;
  for (std::size_t b = 1; b < size(); ++b)
    if (dense.blocks[b].kind == BlockKind::inverse_depth || dense.blocks[b].kind == BlockKind::inverse_height)
      rays.push_back(b);
  if (rays.empty()) return;
  const std::size_t ray = rays[static_cast<std::size_t>(draws_.integer(0, static_cast<int>(rays.size()) - 1))];
  if (dense.blocks[ray].kind == BlockKind::inverse_depth)
    promote<2, 4>(ray, BlockKind::point);
  else
    promote<3, 5>(ray, BlockKind::point3);
}

template <int New, int Old>
void Twins::promote(std::size_t ray, BlockKind into) {
  const Eigen::Matrix<double, New, 1> position = 1.5 * draws_.normals(New);
  const Eigen::Matrix<double, New, Old> jacobian =
      Eigen::Map<const Eigen::Matrix<double, New, Old>>(Eigen::VectorXd(draws_.normals(New * Old)).data());
  state.promote(offsets_[ray], position, jacobian);
  dense.promote(ray, into, position, jacobian);
}

void Twins::move() {
  const Pose2 pose = state.pose();
  const Control control = draws_.control(0.3, 0.3);
  const Eigen::Matrix3d G = motion_jacobians(pose.heading_rad, control).G, noise = draws_.covariance(3, 0.03);
  const Pose2 moved = azimuth::move(pose, control);
  const JointState::ByConsidered B = Eigen::Map<const JointState::ByConsidered>(
      Eigen::VectorXd(draws_.normals(JointState::ByConsidered::SizeAtCompileTime)).data());
  state.move_robot(moved, G, noise, B);
  dense.move_robot(moved, G, noise, B);
  if (!draws_.chance(0.3)) return;
  state.inflate_robot(noise);
  dense.move_robot(moved, Eigen::Matrix3d::Identity(), noise);
}

void Twins::update(int rows) {
  const Rows drawn = draw(rows);
  ASSERT_TRUE(state.update(drawn.sparse, retraction_));
  dense.update(drawn.H, drawn.innovation, drawn.variances, retraction_);
}

void Twins::update_only(std::size_t block, int rows) {
  const Rows drawn = draw(rows);
  ASSERT_TRUE(state.update_only(offsets_[block], dense.blocks[block].kind, drawn.sparse));
  dense.update_only(block, drawn.H, drawn.innovation, drawn.variances);
}

Twins::Rows Twins::draw(int rows) {
  Rows drawn;
  auto& [sparse, H, innovation, variances] = drawn;
  sparse.resize(static_cast<std::size_t>(rows));
  H = Eigen::MatrixXd::Zero(rows, dense.x.size());
  innovation.resize(rows);
  variances.resize(rows);
  for (Index r = 0; r < rows; ++r) {
    ObservationRow& row = sparse[static_cast<std::size_t>(r)];
    std::vector<std::size_t> parts{0};
    for (int p = draws_.integer(0, 3); p > 0; --p) {
      const auto block = static_cast<std::size_t>(draws_.integer(0, static_cast<int>(size()) - 1));
      if (std::find(parts.begin(), parts.end(), block) == parts.end()) parts.push_back(block);
    }
    // a row from a clone, which does not involve the robot
    if (parts.size() > 1 && draws_.chance(0.3)) parts.erase(parts.begin());
    for (const std::size_t block : parts) {
      const Eigen::VectorXd h = 0.3 * draws_.normals(size_of(dense.blocks[block].kind));
      row.add(offsets_[block], {h.data(), static_cast<std::size_t>(h.size())});
      H.row(r).segment(dense.blocks[block].first, h.size()) = h.transpose();
    }
    row.innovation = innovation(r) = draws_.normal(0.05);
    row.variance = variances(r) = draws_.uniform(1e-3, 1e-2);
  }
  return drawn;
}

void Twins::expect_equal() const {
  const std::vector<Index> all = entries();
  ASSERT_EQ(static_cast<Index>(all.size()), dense.x.size());
  Eigen::VectorXd mean(dense.x.size());
  for (std::size_t i = 0; i < all.size(); ++i) mean(static_cast<Index>(i)) = state.mean(all[i]);
  EXPECT_LT(largest_difference(mean, dense.x), 1e-9);
  Eigen::MatrixXd P(dense.x.size(), dense.x.size());
  state.covariance(all, all, P);
  EXPECT_LT(largest_difference(P, dense.P), 1e-9);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_LT(largest_difference(state.by_considered(all[i]), dense.D.row(static_cast<Index>(i))), 1e-9);
  const JointState::Told& told = state.told_of_considered();
  EXPECT_LT(largest_difference(told.information, dense.told.information), 1e-9 * (1.0 + dense.told.information.norm()));
  EXPECT_LT(largest_difference(told.pull, dense.told.pull), 1e-9 * (1.0 + dense.told.pull.norm()));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(P, Eigen::EigenvaluesOnly);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-9 * std::max(1.0, eigen.eigenvalues().maxCoeff()));
}

void Twins::expect_gaps_are_zero() const {
  std::vector<bool> used(static_cast<std::size_t>(state.extent()), false);
  for (const Index entry : entries()) used[static_cast<std::size_t>(entry)] = true;
  for (Index i = 0; i < state.extent(); ++i) {
    if (used[static_cast<std::size_t>(i)]) continue;
    EXPECT_EQ(state.mean(i), 0.0);
    EXPECT_FALSE(state.is_position(i));
    for (Index j = 0; j < state.extent(); ++j) ASSERT_EQ(state.covariance(i, j), 0.0) << i << ", " << j;
  }
}

}  // namespace azimuth
