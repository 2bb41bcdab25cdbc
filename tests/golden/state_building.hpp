#pragma once
// Puts a JointState into a given mean and covariance through its public interface.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/ekf/joint_state.hpp"

namespace azimuth::golden {

/// A joint state whose entries 0 to 2 are the robot and whose further blocks, in order, have the given kinds.
struct BuiltState {
  JointState state;
  std::vector<Index> entries;  ///< where entry i of `mean` is
};

/// `covariance` must be positive semi-definite.
BuiltState build_state(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance,
                       std::span<const BlockKind> blocks);

Eigen::VectorXd mean_of(const JointState& state, std::span<const Index> entries);
Eigen::MatrixXd covariance_of(const JointState& state, std::span<const Index> entries);

}  // namespace azimuth::golden
