#pragma once
// Builds a JointState with a given mean and covariance through its public interface.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/ekf/joint_state.hpp"

namespace azimuth::golden {

/// A joint state. Entries 0 to 2 are the robot, and the further blocks have the given kinds, in order.
struct BuiltState {
  JointState state;
  std::vector<Index> entries;  ///< Entry in the state for each entry i of `mean`
};

/// `covariance` must be positive semi-definite.
BuiltState build_state(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance,
                       std::span<const BlockKind> blocks);

Eigen::VectorXd mean_of(const JointState& state, std::span<const Index> entries);
Eigen::MatrixXd covariance_of(const JointState& state, std::span<const Index> entries);

}  // namespace azimuth::golden
