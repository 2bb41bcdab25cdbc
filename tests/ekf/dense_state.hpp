#pragma once
// The joint state in textbook form: one dense covariance, rebuilt by whole-matrix products in each operation.
// JointState must agree with this reference.

#include <Eigen/Core>
#include <vector>

#include "slam/ekf/joint_state.hpp"

namespace azimuth {

class DenseState {
 public:
  struct Block {
    BlockKind kind;
    Index first;  ///< First entry in x
  };
  Eigen::VectorXd x;
  Eigen::MatrixXd P;
  Eigen::MatrixXd D;          ///< d(x) / d(errors of the considered constants)
  JointState::Told told;      ///< What the measurements tell about the considered constants
  std::vector<Block> blocks;  ///< Starts with the robot's pose

  DenseState(const Pose2& pose, const Eigen::Matrix3d& covariance);

  void move_robot(const Pose2& pose, const Eigen::Matrix3d& G, const Eigen::Matrix3d& noise,
                  const JointState::ByConsidered& B = JointState::ByConsidered::Zero());
  void clone_robot();
  /// `J` has a column for each entry of x.
  void add(BlockKind kind, const Eigen::VectorXd& mean, const Eigen::MatrixXd& J, const Eigen::MatrixXd& noise);
  void remove(std::size_t block);
  void promote(std::size_t block, BlockKind into, const Eigen::VectorXd& mean, const Eigen::MatrixXd& jacobian);
  /// The update in Joseph form.
  void update(const Eigen::MatrixXd& H, const Eigen::VectorXd& innovation, const Eigen::VectorXd& variances,
              JointState::Retraction retraction);
  /// An update in Joseph form with a gain for one block only.
  void update_only(std::size_t block, const Eigen::MatrixXd& H, const Eigen::VectorXd& innovation,
                   const Eigen::VectorXd& variances);

 private:
  /// P <- A P A^T + B and D <- A D. The caller sets x.
  void transform(const Eigen::MatrixXd& A, const Eigen::MatrixXd& added_noise);
  void correct(const Eigen::VectorXd& correction, JointState::Retraction retraction);
};

}  // namespace azimuth
