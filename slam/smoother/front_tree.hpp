#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "slam/smoother/elimination.hpp"
#include "slam/smoother/front.hpp"
#include "slam/smoother/normal_equations.hpp"

namespace azimuth {

/// The Cholesky factor of a sparse normal matrix that grows and changes, as a tree of small dense fronts (SPEC VI.19).
///
/// What changes in a term changes the fronts from there to the root; all others stand. When blocks become neighbours
/// that were not, the blocks of those fronts are put into a new order of elimination. From time to time all of them
/// are.
///
/// Copies share all fronts until one of them makes some anew. Thread contract: thread-bound; copies that share fronts
/// may be on several threads.
class FrontTree {
 public:
  /// The block is new, or gone, or has a neighbour that it had not.
  void restructure(Block block) { changed_.push_back(block); }
  /// The block is about to be none.
  void remove(Block block);
  /// A term of the two has other values; of one alone when they are the same, or the other is no unknown.
  void mark_stale(Block a, Block b);
  void mark_all_stale();
  /// Whether a term of the two would find its place as the tree is.
  bool couples(Block a, Block b) const;

  /// Makes anew what is marked, and what follows from it. With `damping` d the diagonal of the matrix is (1 + d) of
  /// what it is; such a tree is for one step. False: the matrix is not positive definite.
  bool update(NormalEquations& equations, double damping = 0.0);

  /// x of H x = b, in place; entries of rows unused are left alone.
  void solve(Eigen::VectorXd& b) const {
    forwards(b);
    backwards(b);
  }
  /// The first half, y of L y = b: y^T y = b^T H^-1 b. What would make a y below `negligible` is taken as zero: fronts
  /// that have nothing else are passed over.
  void forwards(Eigen::VectorXd& b, double negligible = 0.0) const;
  /// The second half, x of L^T x = y. Fronts below which nothing is pulled, and above which no x is above `negligible`,
  /// are passed over: theirs is zero.
  void backwards(Eigen::VectorXd& y, double negligible = 0.0) const;
  /// The blocks' joint covariance, (H^-1) of their rows, in their order.
  Eigen::MatrixXd covariance(std::span<const Block> blocks, const NormalEquations& equations) const;

  std::size_t fronts() const { return postorder_.size(); }
  std::size_t factor_entries() const;
  /// Fronts made anew by the last update().
  std::size_t updated() const { return updated_; }
  std::size_t restructured() const { return restructured_; }  ///< blocks ordered anew by the last update()

 private:
  static constexpr int kNone = -1;
  struct Node {
    std::shared_ptr<const FrontShape> shape;  // null: free
    std::shared_ptr<FrontNumbers> numbers;    // not changed while another tree has them, too
    int parent = kNone;
    int turn = 0;  // in the postorder
    bool stale = true;
  };
  /// Of no meaning between two calls, so copies do without.
  struct Scratch {
    Scratch() = default;
    Scratch(const Scratch& /*other*/) noexcept {}
    Scratch& operator=(const Scratch& /*other*/) noexcept { return *this; }
    ~Scratch() = default;
    FrontMatrix matrix;
  };
  class Part;
  class Columns;

  Node& node(int at) { return nodes_[static_cast<std::size_t>(at)]; }
  const Node& node(int at) const { return nodes_[static_cast<std::size_t>(at)]; }
  int front_of(Block block) const {
    return static_cast<std::size_t>(block) < front_of_.size() ? front_of_[static_cast<std::size_t>(block)] : kNone;
  }
  void order_changed(const NormalEquations& equations);
  bool wants_new_order() const;
  Part take_out_changed(const NormalEquations& equations);
  void take_out(int at, std::vector<Block>& blocks);
  Elimination eliminate(const Part& part, const NormalEquations& equations) const;
  void put_back(const Part& part, const std::vector<FrontDraft>& drafts, const NormalEquations& equations);
  std::shared_ptr<const FrontShape> shape_of(const Part& part, const FrontDraft& draft, std::vector<int> children,
                                             const NormalEquations& equations) const;
  int free_node();
  void list_postorder();
  Eigen::MatrixXd covariance_of_few(std::span<const Block> blocks, const NormalEquations& equations) const;
  std::vector<int> way_to_root(std::span<const Block> blocks) const;
  bool factorise(Node& front, NormalEquations& equations, double damping);

  std::vector<Node> nodes_;
  std::vector<int> free_, postorder_;
  std::vector<int> front_of_;          // of each block: the front that eliminates it
  std::vector<std::int64_t> turn_of_;  // of each block: a lower one is eliminated before
  std::int64_t turns_ = 0;
  std::vector<Block> changed_;  // since the last update
  std::size_t blocks_ = 0;      // in the tree
  std::size_t ordered_ = 0;     // of these, when all were ordered last
  std::size_t updated_ = 0, restructured_ = 0;
  bool valid_ = true;
  Scratch scratch_;
};

}  // namespace azimuth
