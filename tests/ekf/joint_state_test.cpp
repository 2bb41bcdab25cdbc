// JointState, with its gaps, reuse and growth, against the dense textbook filter over random sequences of operations.

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/ekf/dense_state.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

using Retraction = JointState::Retraction;

/// Both filters side by side, given the same operations.
class Twins {
 public:
  Twins(unsigned seed, Retraction retraction)
      : draws_(seed),
        retraction_(retraction),
        start_(draws_.pose(2.0)),
        P_start_(draws_.covariance(3, 0.1)),
        state(start_, P_start_),
        dense(start_, P_start_) {
    state.consider({1e-4, 4e-4});
  }

  std::size_t size() const { return offsets_.size(); }
  Index offset(std::size_t block) const { return offsets_[block]; }

  void step() {
    const int choice = draws_.integer(0, 99);
    if (choice < 15) return clone();
    if (choice < 40) return add();
    if (choice < 60) return remove_one();
    if (choice < 70) return promote_one();
    if (choice < 85) return move();
    if (choice < 93) return update(draws_.integer(1, 6));
    update_only(static_cast<std::size_t>(draws_.integer(0, static_cast<int>(size()) - 1)), draws_.integer(1, 6));
  }

  void clone() {
    offsets_.push_back(state.clone_robot());
    dense.clone_robot();
  }
  void add() {
    static constexpr std::array kKinds{BlockKind::point,  BlockKind::point,          BlockKind::inverse_depth,
                                       BlockKind::scalar, BlockKind::inverse_height, BlockKind::point3};
    add(kKinds[static_cast<std::size_t>(draws_.integer(0, static_cast<int>(kKinds.size()) - 1))]);
  }
  void add(BlockKind kind);
  void remove_one() {
    if (size() > 1) remove(static_cast<std::size_t>(draws_.integer(1, static_cast<int>(size()) - 1)));
  }
  void remove(std::size_t block) {
    state.remove(offsets_[block], dense.blocks[block].kind);
    dense.remove(block);
    offsets_.erase(offsets_.begin() + static_cast<std::ptrdiff_t>(block));
  }
  void promote_one();
  template <int New, int Old>
  void promote(std::size_t ray, BlockKind into);
  void move();
  void update(int rows);
  void update_only(std::size_t block, int rows);

  void expect_equal() const;
  void expect_gaps_are_zero() const;

 private:
  RandomDraws draws_;
  Retraction retraction_;
  Pose2 start_;
  Eigen::Matrix3d P_start_;
  std::vector<Index> offsets_{JointState::kPose};  // of the dense state's blocks, in its order

  /// Rows on some of the blocks, sparse and dense.
  struct Rows {
    std::vector<ObservationRow> sparse;
    Eigen::MatrixXd H;
    Eigen::VectorXd innovation, variances;
  };
  Rows draw(int rows);

  std::vector<Index> entries() const {
    std::vector<Index> entries;
    for (std::size_t b = 0; b < size(); ++b)
      for (Index i = 0; i < size_of(dense.blocks[b].kind); ++i) entries.push_back(offsets_[b] + i);
    return entries;
  }

 public:
  JointState state;
  DenseState dense;
};

void Twins::add(BlockKind kind) {
  // Depends on the robot and on one other block, as an intersection of two rays does.
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

/// An inverse depth or an inverse height, into the point it describes.
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
  const ByScales B = Eigen::Map<const ByScales>(Eigen::VectorXd(draws_.normals(6)).data());
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
    if (parts.size() > 1 && draws_.chance(0.3)) parts.erase(parts.begin());  // a clone's view: not of the robot
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

class RandomOperations : public testing::TestWithParam<std::tuple<int, Retraction>> {};

TEST_P(RandomOperations, AgreeWithTheDenseFilter) {
  const auto [seed, retraction] = GetParam();
  Twins twins(static_cast<unsigned>(seed), retraction);
  for (int i = 0; i < 150 && !HasFailure(); ++i) {
    SCOPED_TRACE("operation " + std::to_string(i));
    twins.step();
    twins.expect_equal();
    twins.expect_gaps_are_zero();
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomOperations,
                         testing::Combine(testing::Range(1, 21),
                                          testing::Values(Retraction::additive, Retraction::invariant)),
                         test::PrintedName());

class Growth : public testing::TestWithParam<Retraction> {};

TEST_P(Growth, KeepsEverythingAcrossEachDoubling) {
  Twins twins(100, GetParam());
  for (int i = 0; twins.state.extent() < 280 && !HasFailure(); ++i) {  // past 64, 128 and 256
    const Index before = twins.state.extent();
    twins.add(i % 3 == 0 ? BlockKind::inverse_depth : BlockKind::point);
    if (i % 4 == 0) twins.clone();
    if (i % 10 == 9) twins.update(5);
    const bool doubled = (before <= 64) != (twins.state.extent() <= 64) ||
                         (before <= 128) != (twins.state.extent() <= 128) ||
                         (before <= 256) != (twins.state.extent() <= 256);
    if (doubled) twins.expect_equal();
  }
  twins.expect_equal();
}
INSTANTIATE_TEST_SUITE_P(Both, Growth, testing::Values(Retraction::additive, Retraction::invariant),
                         test::PrintedName());

TEST(JointStateGaps, AreReusedByBlocksOfTheirSize) {
  Twins twins(101, Retraction::additive);
  for (int i = 0; i < 10; ++i) {
    twins.add(BlockKind::point);
    twins.clone();
    twins.add(BlockKind::inverse_depth);
  }
  const Index full = twins.state.extent();
  for (int round = 0; round < 50; ++round) {
    for (int removed = 0; removed < 6; ++removed) twins.remove(1);
    for (int added = 0; added < 2; ++added) {
      twins.add(BlockKind::point);
      twins.clone();
      twins.add(BlockKind::inverse_depth);
    }
    ASSERT_EQ(twins.state.extent(), full) << "nothing may grow with the length of the run";
  }
  twins.expect_equal();
}

TEST(JointStateGaps, HalfOfAPromotedRayServesAPoint) {
  Twins twins(102, Retraction::additive);
  twins.add(BlockKind::inverse_depth);
  const Index ray = twins.offset(1), extent = twins.state.extent();
  twins.promote_one();
  EXPECT_EQ(twins.offset(1), ray);
  twins.expect_gaps_are_zero();
  twins.add(BlockKind::point);
  EXPECT_EQ(twins.offset(2), ray + 2);
  EXPECT_EQ(twins.state.extent(), extent);
  twins.expect_equal();
}

TEST(JointStateUpdate, WithoutAPositiveInnovationCovarianceChangesNothing) {
  Twins twins(103, Retraction::invariant);
  for (int i = 0; i < 5; ++i) twins.add(BlockKind::point);
  ObservationRow good, bad;
  const std::array h{0.1, 0.2, -1.0};
  good.add(JointState::kPose, h);
  good.innovation = 0.3;
  good.variance = 0.01;
  bad = good;
  bad.variance = -1e3;
  const std::array rows{good, bad};
  EXPECT_FALSE(twins.state.update(rows, Retraction::invariant));
  twins.expect_equal();
  EXPECT_TRUE(twins.state.update({}, Retraction::invariant));
  twins.expect_equal();
}

TEST(JointStateUpdate, ManyMoreRowsThanEverBefore) {
  Twins twins(104, Retraction::additive);
  for (int i = 0; i < 8; ++i) twins.add(BlockKind::point);
  for (const int rows : {1, 17, 40, 3}) {
    twins.update(rows);
    twins.expect_equal();
  }
}

}  // namespace
}  // namespace azimuth
