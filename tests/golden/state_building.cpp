#include "tests/golden/state_building.hpp"

#include <Eigen/QR>
#include <numeric>

namespace azimuth::golden {
namespace {

void append_entries(std::vector<Index>& entries, Index block, Index size) {
  entries.resize(entries.size() + static_cast<std::size_t>(size));
  std::iota(entries.end() - size, entries.end(), block);
}

}  // namespace

BuiltState build_state(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance,
                       std::span<const BlockKind> blocks) {
  BuiltState built{JointState({mean(0), mean(1), mean(2)}, covariance.topLeftCorner<3, 3>()), {}};
  append_entries(built.entries, JointState::kPose, 3);
  for (const BlockKind kind : blocks) {
    // The block is conditioned on all blocks before it: mean J x and independent noise, with J = P_bx P_xx^+.
    const auto before = static_cast<Index>(built.entries.size());
    const Index size = size_of(kind);
    const Eigen::MatrixXd P_xx = covariance.topLeftCorner(before, before);
    const Eigen::MatrixXd P_xb = covariance.block(0, before, before, size);
    const Eigen::MatrixXd J = P_xx.completeOrthogonalDecomposition().solve(P_xb).transpose();
    const Eigen::MatrixXd noise = covariance.block(before, before, size, size) - J * P_xb;
    const Index block = built.state.add(kind, mean.segment(before, size), built.entries, J, noise);
    append_entries(built.entries, block, size);
  }
  return built;
}

Eigen::VectorXd mean_of(const JointState& state, std::span<const Index> entries) {
  Eigen::VectorXd mean(static_cast<Index>(entries.size()));
  for (std::size_t i = 0; i < entries.size(); ++i) mean(static_cast<Index>(i)) = state.mean(entries[i]);
  return mean;
}

Eigen::MatrixXd covariance_of(const JointState& state, std::span<const Index> entries) {
  const auto size = static_cast<Index>(entries.size());
  Eigen::MatrixXd covariance(size, size);
  state.covariance(entries, entries, covariance);
  return covariance;
}

}  // namespace azimuth::golden
