// Compares the factor of growing and changing matrices with dense ones.

#include "slam/smoother/front_tree.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <rapidcheck/gtest.h>

#include "slam/geometry/random.hpp"

namespace azimuth {
namespace {

using AnyNumbers = RandomNumbers<SplitMix>;

/// Blocks of one to three rows, with a term for each block and terms between some blocks.
class AnyEquations : public NormalEquations {
 public:
  Block add_block(int size, AnyNumbers& numbers) {
    first_rows_.push_back(rows_);
    sizes_.push_back(size);
    rows_ += size;
    const auto block = static_cast<Block>(sizes_.size()) - 1;
    add_term(block, block, numbers);
    return block;
  }
  /// Replaces an existing term.
  void add_term(Block a, Block b, AnyNumbers& numbers) {
    const int size = a == b ? sizes_[at(a)] : sizes_[at(a)] + sizes_[at(b)];
    Eigen::MatrixXd J(size, size);
    for (Eigen::Index i = 0; i < J.size(); ++i) J.data()[i] = numbers.normal();
    terms_[{std::min(a, b), std::max(a, b)}] = J.transpose() * J;
  }
  void remove(Block block) {
    sizes_[at(block)] = 0;
    std::erase_if(terms_, [&](const auto& term) { return term.first.first == block || term.first.second == block; });
  }
  bool has_term(Block a, Block b) const { return terms_.contains({std::min(a, b), std::max(a, b)}); }
  Block blocks() const { return static_cast<Block>(sizes_.size()); }

  /// The dense matrix over all rows; unused rows have a one on the diagonal.
  Eigen::MatrixXd dense(double damping = 0.0) const {
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows_, rows_);
    for (const auto& [blocks, term] : terms_) {
      const std::vector<int> rows = rows_of(blocks);
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t k = 0; k < rows.size(); ++k)
          H(rows[i], rows[k]) += term(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    }
    H.diagonal() *= 1.0 + damping;
    for (int i = 0; i < rows_; ++i)
      if (H(i, i) == 0.0) H(i, i) = 1.0;
    return H;
  }

  int rows() const override { return rows_; }
  int size(Block block) const override { return sizes_[at(block)]; }
  int first_row(Block block) const override { return first_rows_[at(block)]; }
  std::uint8_t rank(Block block) const override { return block + 1 == blocks() ? 1 : 0; }
  void append_neighbours(Block block, std::vector<Block>& out) const override {
    for (const auto& [blocks, term] : terms_)
      if (blocks.first == block || blocks.second == block) out.insert(out.end(), {blocks.first, blocks.second});
  }
  void add_terms(Block block, FrontMatrix& front) override {
    const int row = front.row_of(first_row(block));
    for (const auto& [blocks, term] : terms_) {
      if (blocks.first != block && blocks.second != block) continue;
      const Block other = blocks.first == block ? blocks.second : blocks.first;
      if (front.row_of(first_row(other)) < row) continue;
      const std::vector<int> rows = rows_of(blocks);
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t k = 0; k < rows.size(); ++k) {
          const int a = front.row_of(rows[i]), b = front.row_of(rows[k]);
          if (a >= b) front.values()(a, b) += term(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
        }
    }
  }

 private:
  static std::size_t at(Block block) { return static_cast<std::size_t>(block); }
  std::vector<int> rows_of(const std::pair<Block, Block>& blocks) const {
    std::vector<int> rows(static_cast<std::size_t>(size(blocks.first)));
    std::iota(rows.begin(), rows.end(), first_row(blocks.first));
    if (blocks.second != blocks.first)
      for (int i = 0; i < size(blocks.second); ++i) rows.push_back(first_row(blocks.second) + i);
    return rows;
  }
  std::vector<int> first_rows_, sizes_;
  std::map<std::pair<Block, Block>, Eigen::MatrixXd> terms_;
  int rows_ = 0;
};

/// Growing equations and their factor.
struct Growing {
  explicit Growing(std::uint64_t seed) : numbers{SplitMix(seed)} {}
  /// Starts with `blocks` blocks, already factored.
  Growing(std::uint64_t seed, int blocks) : Growing(seed) {
    grow(blocks);
    EXPECT_TRUE(tree.update(equations));
  }

  /// Grows a chain with some ties far back, the structure of a drive.
  void grow(int blocks) {
    for (int i = 0; i < blocks; ++i) {
      const Block block = equations.add_block(1 + static_cast<int>(3.0 * numbers.uniform()), numbers);
      tree.restructure(block);
      if (block == 0) continue;
      if (equations.size(block - 1) > 0) tie(block - 1, block);
      const Block far = static_cast<Block>(block * numbers.uniform());
      if (numbers.uniform() < 0.3 && equations.size(far) > 0) tie(far, block);
    }
  }
  void tie(Block other, Block block) {
    equations.add_term(other, block, numbers);
    tree.restructure(other);
  }

  void expect_solves(const FrontTree& factor, double damping = 0.0) {
    Eigen::VectorXd b(equations.rows());
    for (Eigen::Index i = 0; i < b.size(); ++i) b[i] = numbers.normal();
    const Eigen::VectorXd expected = equations.dense(damping).llt().solve(b);
    Eigen::VectorXd x = b;
    factor.solve(x);
    EXPECT_LT((x - expected).norm(), 1e-7 * (1.0 + expected.norm()));
  }

  AnyNumbers numbers;
  AnyEquations equations;
  FrontTree tree;
};

TEST(FrontTree, SolvesAtEverySizeItGrowsThrough) {
  Growing growing(1);
  for (int i = 0; i < 150; ++i) {
    growing.grow(1);
    ASSERT_TRUE(growing.tree.update(growing.equations));
    growing.expect_solves(growing.tree);
  }
  EXPECT_GT(growing.tree.fronts(), 10u);
}

TEST(FrontTree, NewEndOfAChainLeavesMostAsItWas) {
  Growing chain(2);
  std::size_t blocks_ordered = 0, times_all = 0;
  for (int i = 0; i < 300; ++i) {
    const Block block = chain.equations.add_block(3, chain.numbers);
    chain.tree.restructure(block);
    if (block > 0) chain.tie(block - 1, block);
    ASSERT_TRUE(chain.tree.update(chain.equations));
    blocks_ordered += chain.tree.restructured();
    if (chain.tree.restructured() == static_cast<std::size_t>(block) + 1) ++times_all;
  }
  EXPECT_LT(times_all, 20u);
  EXPECT_LT(blocks_ordered, 3500u);
}

TEST(FrontTree, WhatIsStaleIsMadeAnewAndNothingElse) {
  Growing grown(3, 100);
  FrontTree& tree = grown.tree;
  EXPECT_EQ(tree.updated(), tree.fronts());
  ASSERT_TRUE(tree.update(grown.equations));
  EXPECT_EQ(tree.updated(), 0u);

  grown.equations.add_term(40, 41, grown.numbers);  // replaces the existing term
  tree.mark_stale(40, 41);
  ASSERT_TRUE(tree.update(grown.equations));
  EXPECT_GT(tree.updated(), 0u);
  EXPECT_LT(tree.updated(), tree.fronts());
  grown.expect_solves(tree);
}

TEST(FrontTree, WhatIsHardlyPulledStaysWhereItIs) {
  Growing grown(8, 200);
  const FrontTree& tree = grown.tree;
  Eigen::VectorXd little = Eigen::VectorXd::Constant(grown.equations.rows(), 1e-12);
  tree.forwards(little, 1e-6);
  EXPECT_EQ(little.norm(), 0.0);
  // One large entry, and tiny ones in all other rows
  Eigen::VectorXd b = Eigen::VectorXd::Constant(grown.equations.rows(), 1e-12);
  b.head(3).setOnes();
  const Eigen::VectorXd expected = grown.equations.dense().llt().solve(b);
  tree.forwards(b, 1e-9);
  tree.backwards(b, 1e-9);
  EXPECT_LT((b - expected).norm(), 1e-6 * expected.norm());
}

TEST(FrontTree, DampingMultipliesTheDiagonal) {
  Growing grown(4, 60);
  FrontTree damped = grown.tree;
  damped.mark_all_stale();
  ASSERT_TRUE(damped.update(grown.equations, 0.3));
  grown.expect_solves(damped, 0.3);
  grown.expect_solves(grown.tree);  // the original tree is unchanged
}

TEST(FrontTree, SaysWhenTheMatrixIsNotPositive) {
  AnyNumbers numbers{SplitMix(5)};
  struct Singular : AnyEquations {
    void add_terms(Block block, FrontMatrix& front) override {
      if (block != 7) AnyEquations::add_terms(block, front);
    }
  } equations;
  FrontTree tree;
  for (int i = 0; i < 20; ++i) tree.restructure(equations.add_block(2, numbers));
  EXPECT_FALSE(tree.update(equations));
}

TEST(FrontTree, RemovedBlocksLeaveNothingBehind) {
  Growing grown(6, 80);
  for (const Block block : {10, 79, 0, 41}) {
    for (Block other = 0; other < grown.equations.blocks(); ++other)
      if (grown.equations.has_term(block, other)) grown.tree.mark_stale(block, other);
    grown.tree.remove(block);
    grown.equations.remove(block);
    ASSERT_TRUE(grown.tree.update(grown.equations));
    grown.expect_solves(grown.tree);
  }
}

TEST(FrontTree, CovarianceIsTheInversesBlock) {
  Growing grown(7, 70);
  const Eigen::MatrixXd inverse = grown.equations.dense().inverse();
  const std::vector<Block> blocks{69, 3, 40};
  std::vector<int> rows;
  for (const Block block : blocks)
    for (int i = 0; i < grown.equations.size(block); ++i) rows.push_back(grown.equations.first_row(block) + i);
  const Eigen::MatrixXd P = grown.tree.covariance(blocks, grown.equations);
  ASSERT_EQ(P.rows(), static_cast<Eigen::Index>(rows.size()));
  for (Eigen::Index i = 0; i < P.rows(); ++i)
    for (Eigen::Index k = 0; k < P.cols(); ++k)
      EXPECT_NEAR(P(i, k), inverse(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(k)]),
                  1e-8 * inverse.cwiseAbs().maxCoeff());
}

RC_GTEST_PROP(FrontTreeProperty, AnyHistoryGivesTheSolution, (std::uint64_t seed)) {
  Growing growing(seed);
  auto& [numbers, equations, tree] = growing;
  for (int step = 0; step < 25; ++step) {
    growing.grow(1 + static_cast<int>(6 * numbers.uniform()));
    const Block a = static_cast<Block>(equations.blocks() * numbers.uniform());
    const Block b = static_cast<Block>(equations.blocks() * numbers.uniform());
    if (equations.size(a) > 0 && equations.size(b) > 0) {
      if (numbers.uniform() < 0.3) {
        tree.remove(a);
        equations.remove(a);
      } else {
        const bool in_place = a != b && tree.couples(a, b);
        equations.add_term(a, b, numbers);
        if (in_place || a == b) {
          tree.mark_stale(a, b);
        } else {
          tree.restructure(a);
          tree.restructure(b);
        }
      }
    }
    RC_ASSERT(tree.update(equations));
    Eigen::VectorXd x = Eigen::VectorXd::Ones(equations.rows());
    const Eigen::VectorXd expected = equations.dense().llt().solve(x);
    tree.solve(x);
    RC_ASSERT((x - expected).norm() < 1e-6 * (1.0 + expected.norm()));
  }
}

}  // namespace
}  // namespace azimuth
