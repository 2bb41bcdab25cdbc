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

/// The Cholesky factor of a sparse normal matrix that grows and changes, stored as a tree of small dense fronts
/// (mathematics VI.19).
///
/// A changed term changes the fronts on the path from its front to the root; all other fronts are reused. When two
/// blocks become neighbours for the first time, the blocks of those fronts get a new order of elimination. From time to
/// time all blocks are ordered anew.
///
/// Copies share fronts until one copy recomputes them. Thread contract: thread-bound; copies that share fronts may be
/// used on several threads.
class FrontTree {
 public:
  /// Marks a block that is new, that was removed, or that has a new neighbour.
  void restructure(Block block) { changed_.push_back(block); }
  /// Announces that the block is about to become no unknown.
  void remove(Block block);
  /// Marks the term of the two blocks as changed. For a term of one block, both are the same, or the other is no
  /// unknown.
  void mark_stale(Block a, Block b);
  void mark_all_stale();
  /// Whether the current tree has a front that holds both blocks, so that a term between them fits in.
  bool couples(Block a, Block b) const;

  /// Recomputes the marked fronts and those above them. With `damping` d, the diagonal of the matrix is multiplied by
  /// (1 + d); such a tree serves for one step only. Returns false when the matrix is not positive definite.
  bool update(NormalEquations& equations, double damping = 0.0);

  /// Solves H x = b in place. Entries of unused rows stay unchanged.
  void solve(Eigen::VectorXd& b) const {
    forwards(b);
    backwards(b);
  }
  /// The first half of solve(): solves L y = b in place, so that y^T y = b^T H^-1 b. Entries of y below `negligible`
  /// are set to zero, and fronts without other entries are skipped.
  void forwards(Eigen::VectorXd& b, double negligible = 0.0) const;
  /// The second half of solve(): solves L^T x = y in place. A front is skipped when its own entries of y are all zero
  /// and no entry of x above the front exceeds `negligible`; the entries of x of a skipped front are zero.
  void backwards(Eigen::VectorXd& y, double negligible = 0.0) const;
  /// Joint covariance of the blocks: the part of H^-1 that belongs to their rows, in the given order.
  Eigen::MatrixXd covariance(std::span<const Block> blocks, const NormalEquations& equations) const;

  std::size_t fronts() const { return postorder_.size(); }
  std::size_t factor_entries() const;
  /// Number of fronts recomputed by the last update().
  std::size_t updated() const { return updated_; }
  std::size_t restructured() const { return restructured_; }  ///< number of blocks ordered anew by the last update()

 private:
  static constexpr int kNone = -1;
  struct Node {
    std::shared_ptr<const FrontShape> shape;  // null: the node is unused
    std::shared_ptr<FrontNumbers> numbers;    // copied before a change when another tree shares them
    int parent = kNone;
    int turn = 0;  // position in the postorder
    bool stale = true;
  };
  /// Temporary storage, which copies of the tree do not copy.
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
  std::vector<int> front_of_;          // per block, the front that eliminates it
  std::vector<std::int64_t> turn_of_;  // per block, its place in the order of elimination
  std::int64_t turns_ = 0;
  std::vector<Block> changed_;  // marked since the last update
  std::size_t blocks_ = 0;      // number of blocks in the tree
  std::size_t ordered_ = 0;     // number of blocks when all were last ordered anew
  std::size_t updated_ = 0, restructured_ = 0;
  bool valid_ = true;
  Scratch scratch_;
};

}  // namespace azimuth
