#pragma once
// The joint state as a textbook writes it: one dense covariance, rebuilt by whole-matrix products at each operation.
// The reference that JointState must agree with.

#include <Eigen/Core>
#include <vector>

#include "slam/ekf/joint_state.hpp"

namespace azimuth {

class DenseState {
 public:
  struct Block {
    BlockKind kind;
    Index first;  ///< entry in x
  };
  Eigen::VectorXd x;
  Eigen::MatrixXd P;
  Eigen::MatrixXd D;          ///< d(x) / d(errors of the considered constants)
  JointState::Told told;      ///< of them
  std::vector<Block> blocks;  ///< the robot's pose first

  DenseState(const Pose2& pose, const Eigen::Matrix3d& covariance);

  void move_robot(const Pose2& pose, const Eigen::Matrix3d& G, const Eigen::Matrix3d& noise,
                  const JointState::ByConsidered& B = JointState::ByConsidered::Zero());
  void clone_robot();
  /// `J` has a column for each entry of x.
  void add(BlockKind kind, const Eigen::VectorXd& mean, const Eigen::MatrixXd& J, const Eigen::MatrixXd& noise);
  void remove(std::size_t block);
  void promote(std::size_t block, BlockKind into, const Eigen::VectorXd& mean, const Eigen::MatrixXd& jacobian);
  /// Joseph form.
  void update(const Eigen::MatrixXd& H, const Eigen::VectorXd& innovation, const Eigen::VectorXd& variances,
              JointState::Retraction retraction);
  /// Likewise with a gain for one block only.
  void update_only(std::size_t block, const Eigen::MatrixXd& H, const Eigen::VectorXd& innovation,
                   const Eigen::VectorXd& variances);

 private:
  /// x <- A x is not meant: only P <- A P A^T + B and D <- A D, with x set by the caller.
  void transform(const Eigen::MatrixXd& A, const Eigen::MatrixXd& added_noise);
  void correct(const Eigen::VectorXd& correction, JointState::Retraction retraction);
};

}  // namespace azimuth
