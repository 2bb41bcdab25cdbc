#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace azimuth {

/// The order of elimination of the unknowns, and the neighbours that each one has when it is eliminated.
struct Elimination {
  std::vector<int> order;                ///< nodes in the order of elimination
  std::vector<std::vector<int>> behind;  ///< per position in that order: the neighbours eliminated later, ascending
};

/// The graph of unknowns (nodes) in which two nodes are tied when they share a term. Eliminating a node ties all its
/// neighbours to each other (fill), so the order matters. The node with the fewest ties goes next (exact minimum
/// degree), among the nodes of the lowest rank.
///
/// Minimum degree alone eliminates a long chain from its ends, and a change in the middle then has a long way to the
/// root. Therefore a node that has to wait for others, one after another, is delayed: kLevelsForATie levels of waiting
/// count as one more tie.
///
/// Thread contract: thread-bound.
class EliminationGraph {
 public:
  static constexpr int kLevelsForATie = 2;

  explicit EliminationGraph(std::size_t nodes);

  void tie(int a, int b);
  void tie_all(std::span<const int> nodes);

  /// Computes the order. `ranks` has one entry per node; a node of a lower rank is eliminated first. The call destroys
  /// the graph.
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
  std::vector<Word> bits_;  // adjacency matrix, row by row: symmetric, diagonal empty
};

/// A front: nodes that are eliminated together in one dense matrix.
struct FrontDraft {
  static constexpr int kRoot = -1;
  std::vector<int> eliminated, behind;  ///< nodes in the order of elimination; their neighbours eliminated later
  int parent = kRoot;                   ///< the front that eliminates the first of `behind`
};

/// Groups the nodes of an elimination into fronts, parents before children. Nodes with the same neighbours share a
/// front. Nodes with few rows share one as well, because a few zeros in a front cost less than another front. `sizes`
/// has the number of rows of each node.
std::vector<FrontDraft> group_into_fronts(const Elimination& elimination, std::span<const int> sizes);

}  // namespace azimuth
