#pragma once
#include <array>
#include <vector>

#include "tests/ekf/dense_state.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {

/// JointState and the dense reference filter side by side, given the same operations.
class Twins {
 public:
  Twins(unsigned seed, JointState::Retraction retraction)
      : draws_(seed),
        retraction_(retraction),
        start_(draws_.pose(2.0)),
        P_start_(draws_.covariance(3, 0.1)),
        state(start_, P_start_),
        dense(start_, P_start_) {
    state.consider(Considered::Constant(1e-4));
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
  JointState::Retraction retraction_;
  Pose2 start_;
  Eigen::Matrix3d P_start_;
  std::vector<Index> offsets_{JointState::kPose};  // offsets of the dense state's blocks, in its order

  /// Observation rows on some of the blocks, in sparse and in dense form.
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

}  // namespace azimuth
