#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace azimuth {

/// In which order unknowns are eliminated, and what each is tied to by then.
struct Elimination {
  std::vector<int> order;                ///< nodes, the first to go first
  std::vector<std::vector<int>> behind;  ///< of each in that order: the nodes tied to it that go later, ascending
};

/// Which unknowns share a term. Eliminating one ties all those together that it was tied to (fill), so the order
/// matters: whatever has the fewest ties goes next (minimum degree, exact), among nodes of the lowest rank. By that
/// alone a long chain is eaten up from its ends, and what changes somewhere in it has a long way to the node that goes
/// last; so a node that others have to wait for, one after another, goes later: so many levels count as a tie more.
///
/// Thread contract: thread-bound.
class EliminationGraph {
 public:
  static constexpr int kLevelsForATie = 2;

  explicit EliminationGraph(std::size_t nodes);

  void tie(int a, int b);
  void tie_all(std::span<const int> nodes);

  /// `ranks`: one for each node; of two nodes that of the lower rank goes first. Uses the graph up.
  Elimination eliminate(std::span<const std::uint8_t> ranks);

 private:
  using Word = std::uint64_t;
  static constexpr std::size_t kBits = 64;
  Word* row(int node) { return &bits_[static_cast<std::size_t>(node) * words_]; }
  void set(int a, int b) { row(a)[static_cast<std::size_t>(b) / kBits] |= bit(b); }
  void clear(int a, int b) { row(a)[static_cast<std::size_t>(b) / kBits] &= ~bit(b); }
  static Word bit(int node) { return Word{1} << (static_cast<std::size_t>(node) % kBits); }
  int degree(int node);
  std::vector<int> tied_to(int node);
  void join(int node, const std::vector<int>& tied);

  std::size_t nodes_, words_;
  std::vector<Word> bits_;  // row by row, symmetric, the diagonal empty
};

/// Nodes that are eliminated in one dense matrix.
struct FrontDraft {
  static constexpr int kRoot = -1;
  std::vector<int> eliminated, behind;  ///< in the order of elimination; those tied to one of them that go later
  int parent = kRoot;                   ///< the front that eliminates the first of `behind`
};

/// Fronts of an elimination, parents before children. Nodes that are tied to the same ones share a front, and so do few
/// rows, since a front has a cost of its own: some zeros in it are cheaper than another one. `sizes`: rows of each
/// node.
std::vector<FrontDraft> group_into_fronts(const Elimination& elimination, std::span<const int> sizes);

}  // namespace azimuth
