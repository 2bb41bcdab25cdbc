#include "slam/smoother/elimination.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <queue>
#include <tuple>

namespace azimuth {

EliminationGraph::EliminationGraph(std::size_t nodes)
    : nodes_(nodes), words_((nodes + kBits - 1) / kBits), bits_(nodes_ * words_) {}

void EliminationGraph::tie(int a, int b) {
  if (a == b) return;
  set(a, b);
  set(b, a);
}

void EliminationGraph::tie_all(std::span<const int> nodes) {
  std::vector<Word> together(words_);
  for (const int node : nodes) together[static_cast<std::size_t>(node) / kBits] |= bit(node);
  for (const int node : nodes) {
    Word* const ties = row(node);
    for (std::size_t w = 0; w < words_; ++w) ties[w] |= together[w];
    clear(node, node);
  }
}

Elimination EliminationGraph::eliminate(std::span<const std::uint8_t> ranks) {
  // Outdated entries stay in the queue and are skipped when they come up.
  using Entry = std::tuple<std::uint8_t, int, int>;  // rank, cost, node
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
  std::vector<int> costs(nodes_), heights(nodes_);
  const auto enter = [&](int node) {
    const auto at = static_cast<std::size_t>(node);
    costs[at] = kLevelsForATie * degree(node) + heights[at];
    next.emplace(ranks[at], costs[at], node);
  };
  for (std::size_t node = 0; node < nodes_; ++node) enter(static_cast<int>(node));

  constexpr int kGone = -1;
  Elimination elimination;
  elimination.order.reserve(nodes_);
  elimination.behind.reserve(nodes_);
  while (!next.empty()) {
    const auto [rank, entered_cost, node] = next.top();
    next.pop();
    const auto at = static_cast<std::size_t>(node);
    if (costs[at] != entered_cost) continue;
    costs[at] = kGone;
    std::vector<int> tied = tied_to(node);
    join(node, tied);
    for (const int other : tied) {
      int& height = heights[static_cast<std::size_t>(other)];
      height = std::max(height, heights[at] + 1);
      enter(other);
    }
    elimination.order.push_back(node);
    elimination.behind.push_back(std::move(tied));
  }
  return elimination;
}

/// Removes the node and ties its neighbours to each other.
void EliminationGraph::join(int node, const std::vector<int>& tied) {
  const Word* const together = row(node);
  for (const int other : tied) {
    Word* const ties = row(other);
    for (std::size_t w = 0; w < words_; ++w) ties[w] |= together[w];
    clear(other, other);
    clear(other, node);
  }
}

int EliminationGraph::degree(int node) {
  int ties = 0;
  for (std::size_t w = 0; w < words_; ++w) ties += std::popcount(row(node)[w]);
  return ties;
}

std::vector<int> EliminationGraph::tied_to(int node) {
  std::vector<int> tied;
  for (std::size_t w = 0; w < words_; ++w)
    for (Word ties = row(node)[w]; ties != 0; ties &= ties - 1)
      tied.push_back(static_cast<int>(w * kBits) + std::countr_zero(ties));
  return tied;
}

namespace {

constexpr int kSmallFront_rows = 16;
constexpr std::size_t kZerosOfSmallFront = 3;  // number of nodes in the front that a node is not tied to
// A front of one pose eliminates three columns but passes on hundreds of numbers. Several poses share a front at the
// cost of some more zeros.
constexpr int kMostTogether_rows = 18;
constexpr double kZerosTogether = 0.2;  // share of the front's rows

int rows_of(std::span<const int> nodes, std::span<const int> sizes) {
  int rows = 0;
  for (const int node : nodes) rows += sizes[static_cast<std::size_t>(node)];
  return rows;
}

/// Whether a node with the later neighbours `behind` should join the front `above`, which eliminates the first of them,
/// rather than get a front of its own.
bool goes_well_with(const FrontDraft& above, std::span<const int> behind, std::span<const int> sizes) {
  const std::size_t zeros = above.eliminated.size() + above.behind.size() - behind.size();
  if (zeros == 0) return true;
  const int eliminated = rows_of(above.eliminated, sizes), rows = eliminated + rows_of(above.behind, sizes);
  if (rows < kSmallFront_rows) return zeros <= kZerosOfSmallFront;
  return eliminated < kMostTogether_rows && rows - rows_of(behind, sizes) <= kZerosTogether * rows;
}

}  // namespace

/// Goes backwards through the order: each node joins the front of its first later neighbour, or starts a front below
/// that front.
std::vector<FrontDraft> group_into_fronts(const Elimination& elimination, std::span<const int> sizes) {
  const std::size_t count = elimination.order.size();
  std::vector<std::size_t> turns(count);  // position of each node in the order
  for (std::size_t turn = 0; turn < count; ++turn) turns[static_cast<std::size_t>(elimination.order[turn])] = turn;
  const auto by_turn = [&turns](int node) { return turns[static_cast<std::size_t>(node)]; };

  std::vector<FrontDraft> fronts;
  std::vector<int> front_of(count);
  for (std::size_t turn = count; turn-- > 0;) {
    const int node = elimination.order[turn];
    const std::vector<int>& behind = elimination.behind[turn];
    int& mine = front_of[static_cast<std::size_t>(node)];
    int parent = FrontDraft::kRoot;
    if (!behind.empty()) {
      parent = front_of[static_cast<std::size_t>(*std::ranges::min_element(behind, {}, by_turn))];
      FrontDraft& above = fronts[static_cast<std::size_t>(parent)];
      if (goes_well_with(above, behind, sizes)) {
        above.eliminated.push_back(node);  // in reverse order, corrected below
        mine = parent;
        continue;
      }
    }
    mine = static_cast<int>(fronts.size());
    fronts.push_back({{node}, behind, parent});
    std::ranges::sort(fronts.back().behind, {}, by_turn);
  }
  for (FrontDraft& front : fronts) std::ranges::reverse(front.eliminated);
  return fronts;
}

}  // namespace azimuth
