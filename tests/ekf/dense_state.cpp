#include "tests/ekf/dense_state.hpp"

#include <Eigen/LU>

namespace azimuth {
namespace {

Eigen::Vector2d turned_by_right_angle(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// The first entries of a block's pairs of entries that turn with the map.
std::vector<Index> pairs_of(BlockKind kind) {
  if (kind == BlockKind::scalar || kind == BlockKind::plain_pair) return {};
  if (kind == BlockKind::inverse_height) return {0, 2};
  return {0};
}

/// The entry of a block that is an angle, or -1.
Index angle_of(BlockKind kind) {
  if (kind == BlockKind::pose || kind == BlockKind::inverse_depth) return 2;
  return kind == BlockKind::scalar ? 0 : -1;
}

/// V of the exponential map of rigid motions: the integral of R(s turn) over s in [0, 1], computed by its power series.
Eigen::Matrix2d exponential_factor(double turn_rad) {
  Eigen::Matrix2d generator, sum = Eigen::Matrix2d::Zero(), term = Eigen::Matrix2d::Identity();
  generator << 0.0, -turn_rad, turn_rad, 0.0;
  for (int n = 1; n < 25; ++n) {
    sum += term;
    term = (term * generator / (n + 1)).eval();
  }
  return sum;
}

}  // namespace

DenseState::DenseState(const Pose2& pose, const Eigen::Matrix3d& covariance)
    : x(pose.vector()),
      P(covariance),
      D(Eigen::MatrixXd::Zero(3, JointState::kConsidered)),
      blocks{{BlockKind::pose, 0}} {}

void DenseState::transform(const Eigen::MatrixXd& A, const Eigen::MatrixXd& added_noise) {
  D = (A * D).eval();
  P = A * P * A.transpose() + added_noise;
  P = 0.5 * (P + P.transpose()).eval();
}

void DenseState::move_robot(const Pose2& pose, const Eigen::Matrix3d& G, const Eigen::Matrix3d& noise,
                            const JointState::ByConsidered& by_considered) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(x.size(), x.size());
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(x.size(), x.size());
  A.topLeftCorner<3, 3>() = G;
  B.topLeftCorner<3, 3>() = noise;
  transform(A, B);
  D.topRows<3>() += by_considered;
  x.head<3>() = pose.vector();
}

void DenseState::clone_robot() {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, x.size());
  J.leftCols<3>().setIdentity();
  add(BlockKind::pose, x.head<3>(), J, Eigen::Matrix3d::Zero());
}

void DenseState::add(BlockKind kind, const Eigen::VectorXd& mean, const Eigen::MatrixXd& J,
                     const Eigen::MatrixXd& noise) {
  const Index old = x.size(), size = size_of(kind);
  Eigen::MatrixXd A(old + size, old);
  A << Eigen::MatrixXd::Identity(old, old), J;
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(old + size, old + size);
  B.bottomRightCorner(size, size) = noise;
  transform(A, B);
  x.conservativeResize(old + size);
  x.tail(size) = mean;
  blocks.push_back({kind, old});
}

void DenseState::remove(std::size_t block) {
  const Index first = blocks[block].first, size = size_of(blocks[block].kind), rest = x.size() - first - size;
  Eigen::MatrixXd keep = Eigen::MatrixXd::Zero(x.size() - size, x.size());
  keep.topLeftCorner(first, first).setIdentity();
  keep.bottomRightCorner(rest, rest).setIdentity();
  x = (keep * x).eval();
  transform(keep, Eigen::MatrixXd::Zero(x.size(), x.size()));
  blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(block));
  for (std::size_t b = block; b < blocks.size(); ++b) blocks[b].first -= size;
}

void DenseState::promote(std::size_t block, BlockKind into, const Eigen::VectorXd& mean,
                         const Eigen::MatrixXd& jacobian) {
  const Index first = blocks[block].first, size = jacobian.rows(), old = jacobian.cols();
  const Index rest = x.size() - first - old;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(x.size() - old + size, x.size());
  A.topLeftCorner(first, first).setIdentity();
  A.block(first, first, size, old) = jacobian;
  A.bottomRightCorner(rest, rest).setIdentity();
  x = (A * x).eval();
  x.segment(first, size) = mean;
  transform(A, Eigen::MatrixXd::Zero(x.size(), x.size()));
  blocks[block].kind = into;
  for (std::size_t b = block + 1; b < blocks.size(); ++b) blocks[b].first -= old - size;
}

void DenseState::update(const Eigen::MatrixXd& H, const Eigen::VectorXd& innovation, const Eigen::VectorXd& variances,
                        JointState::Retraction retraction) {
  const Eigen::MatrixXd R = variances.asDiagonal();
  const Eigen::MatrixXd S = H * P * H.transpose() + R;
  const Eigen::MatrixXd K = P * H.transpose() * S.inverse();
  told.information += D.transpose() * H.transpose() * S.inverse() * H * D;
  told.pull += D.transpose() * H.transpose() * S.inverse() * innovation;
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(x.size(), x.size());
  transform(I - K * H, K * R * K.transpose());
  correct(K * innovation, retraction);
}

void DenseState::update_only(std::size_t block, const Eigen::MatrixXd& H, const Eigen::VectorXd& innovation,
                             const Eigen::VectorXd& variances) {
  const Eigen::MatrixXd R = variances.asDiagonal();
  const Eigen::MatrixXd S = H * P * H.transpose() + R;
  const Index first = blocks[block].first, size = size_of(blocks[block].kind);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(x.size(), H.rows());
  K.middleRows(first, size) = P.middleRows(first, size) * H.transpose() * S.inverse();
  transform(Eigen::MatrixXd::Identity(x.size(), x.size()) - K * H, K * R * K.transpose());
  correct(K * innovation, JointState::Retraction::additive);
}

/// The invariant error of a position q is xi = dq - turn q_perp. Its exponential moves q to R(turn) q + V xi. Because V
/// turn q_perp = R(turn) q - q, the result equals q + V dq: each position moves by its own correction, independent of
/// the origin. The covariance is kept in the coordinates dq and is transported from the old mean to the new one.
void DenseState::correct(const Eigen::VectorXd& correction, JointState::Retraction retraction) {
  const Eigen::VectorXd before = x;
  const double turn_rad = correction(2);
  x += correction;
  for (const Block& block : blocks) {
    const Index angle = angle_of(block.kind);
    if (angle >= 0) x(block.first + angle) = wrap(x(block.first + angle));
  }
  if (retraction == JointState::Retraction::additive) return;

  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(x.size(), x.size());
  for (const Block& block : blocks) {
    for (const Index pair : pairs_of(block.kind)) {
      const Index first = block.first + pair;
      const Eigen::Vector2d q = before.segment<2>(first);
      x.segment<2>(first) = q + exponential_factor(turn_rad) * correction.segment<2>(first);
      T.block<2, 1>(first, 2) += turned_by_right_angle(x.segment<2>(first) - q);
    }
  }
  transform(T, Eigen::MatrixXd::Zero(x.size(), x.size()));
}

}  // namespace azimuth
