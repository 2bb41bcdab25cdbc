#include "slam/smoother/elimination.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>
#include <set>

#include "slam/geometry/random.hpp"

namespace azimuth {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::size_t fill(const Elimination& elimination) {
  std::size_t ties = 0;
  for (const auto& behind : elimination.behind) ties += behind.size();
  return ties;
}

TEST(Elimination, AStarsMiddleGoesLast) {
  EliminationGraph graph(5);
  for (int leaf = 1; leaf < 5; ++leaf) graph.tie(0, leaf);
  const Elimination elimination = graph.eliminate(std::vector<std::uint8_t>(5, 0));
  EXPECT_EQ(fill(elimination), 4u);  // no fill-in
  EXPECT_GE(std::ranges::find(elimination.order, 0) - elimination.order.begin(), 3);
}

TEST(Elimination, RankComesBeforeDegree) {
  EliminationGraph graph(4);
  for (int leaf = 1; leaf < 4; ++leaf) graph.tie(0, leaf);
  const Elimination elimination = graph.eliminate(std::vector<std::uint8_t>{0, 1, 1, 2});
  EXPECT_THAT(elimination.order, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(elimination.behind[0], ElementsAre(1, 2, 3));
  EXPECT_THAT(elimination.behind[1], ElementsAre(2, 3));
  EXPECT_THAT(elimination.behind[3], IsEmpty());
}

TEST(Elimination, NothingIsTiedToItself) {
  EliminationGraph graph(70);  // more than one word of the bit set
  const std::vector<int> all{0, 1, 65, 69};
  graph.tie_all(all);
  graph.tie(3, 3);
  const Elimination elimination = graph.eliminate(std::vector<std::uint8_t>(70, 0));
  EXPECT_EQ(fill(elimination), 6u);
  EXPECT_EQ(elimination.order.size(), 70u);
}

/// For each node: the length of the longest chain of dependent eliminations before it.
std::vector<int> heights(const Elimination& elimination) {
  std::vector<int> heights(elimination.order.size());
  for (std::size_t turn = 0; turn < elimination.order.size(); ++turn)
    for (const int later : elimination.behind[turn]) {
      int& height = heights[static_cast<std::size_t>(later)];
      height = std::max(height, heights[static_cast<std::size_t>(elimination.order[turn])] + 1);
    }
  return heights;
}

/// A drive among landmarks visible from everywhere: a chain of nodes, all tied to the same landmark nodes, which are
/// eliminated last.
constexpr int kChain = 256, kSeenFromEverywhere = 10;

Elimination chain_eliminated() {
  EliminationGraph graph(kChain + kSeenFromEverywhere);
  for (int node = 0; node < kChain; ++node) {
    if (node > 0) graph.tie(node - 1, node);
    for (int landmark = 0; landmark < kSeenFromEverywhere; ++landmark) graph.tie(node, kChain + landmark);
  }
  std::vector<std::uint8_t> ranks(kChain, 0);
  ranks.resize(kChain + kSeenFromEverywhere, 1);
  return graph.eliminate(ranks);
}

TEST(Elimination, AChainIsHalvedAgainAndAgain) {
  const Elimination elimination = chain_eliminated();
  // THEN no node of the chain has many dependent eliminations before it
  const std::vector<int> all = heights(elimination);
  EXPECT_LT(*std::max_element(all.begin(), all.begin() + kChain), 16);
  // AND there is little fill-in: each node has at most two later nodes of the chain
  EXPECT_LE(fill(elimination), (2u + kSeenFromEverywhere) * kChain + kSeenFromEverywhere * kSeenFromEverywhere);
}

TEST(Elimination, SeveralOfAChainShareAFront) {
  const Elimination elimination = chain_eliminated();
  const std::vector<FrontDraft> fronts = group_into_fronts(elimination, std::vector<int>(elimination.order.size(), 3));
  EXPECT_LT(fronts.size(), kChain / 2u);
  std::vector<int> times(elimination.order.size());
  for (const FrontDraft& front : fronts) {
    std::set<int> nodes(front.behind.begin(), front.behind.end());
    for (const int node : front.eliminated) {
      ++times[static_cast<std::size_t>(node)];
      nodes.insert(node);
    }
    // The front contains all ties that a node has when it is eliminated.
    for (const int node : front.eliminated) {
      const auto turn =
          static_cast<std::size_t>(std::ranges::find(elimination.order, node) - elimination.order.begin());
      EXPECT_TRUE(std::ranges::all_of(elimination.behind[turn], [&](int other) { return nodes.contains(other); }));
    }
    if (front.parent == FrontDraft::kRoot) continue;
    // AND the parent front contains all remaining nodes of this front.
    const FrontDraft& above = fronts[static_cast<std::size_t>(front.parent)];
    std::set<int> there(above.behind.begin(), above.behind.end());
    there.insert(above.eliminated.begin(), above.eliminated.end());
    EXPECT_TRUE(std::ranges::all_of(front.behind, [&](int other) { return there.contains(other); }));
  }
  EXPECT_THAT(times, testing::Each(1));
}

RC_GTEST_PROP(EliminationProperty, TiesAreThoseOfEliminationByHand, (std::uint64_t seed)) {
  RandomNumbers<SplitMix> numbers{SplitMix(seed)};
  const int nodes = 2 + static_cast<int>(90 * numbers.uniform());
  EliminationGraph graph(static_cast<std::size_t>(nodes));
  std::vector<std::set<int>> tied(static_cast<std::size_t>(nodes));
  for (int i = 0; i < 2 * nodes; ++i) {
    const int a = static_cast<int>(nodes * numbers.uniform()), b = static_cast<int>(nodes * numbers.uniform());
    graph.tie(a, b);
    if (a == b) continue;
    tied[static_cast<std::size_t>(a)].insert(b);
    tied[static_cast<std::size_t>(b)].insert(a);
  }
  std::vector<std::uint8_t> ranks;
  for (int i = 0; i < nodes; ++i) ranks.push_back(numbers.uniform() < 0.2 ? 1 : 0);
  const Elimination elimination = graph.eliminate(ranks);
  RC_ASSERT(elimination.order.size() == static_cast<std::size_t>(nodes));
  std::vector<int> waited(static_cast<std::size_t>(nodes));
  for (std::size_t i = 0; i < elimination.order.size(); ++i) {
    const int node = elimination.order[i];
    const std::set<int> mine = tied[static_cast<std::size_t>(node)];
    RC_ASSERT(std::vector<int>(mine.begin(), mine.end()) == elimination.behind[i]);
    for (std::size_t k = i + 1; k < elimination.order.size(); ++k) {
      const auto other = static_cast<std::size_t>(elimination.order[k]);
      RC_ASSERT(ranks[static_cast<std::size_t>(node)] <= ranks[other]);
      // Among the admissible nodes none is cheaper, counting its ties and its depth in the elimination tree.
      const auto cost = [&](std::size_t which, std::size_t ties) {
        return EliminationGraph::kLevelsForATie * static_cast<int>(ties) + waited[which];
      };
      if (ranks[static_cast<std::size_t>(node)] == ranks[other])
        RC_ASSERT(cost(other, tied[other].size()) >= cost(static_cast<std::size_t>(node), mine.size()));
    }
    for (const int later : mine) {
      int& height = waited[static_cast<std::size_t>(later)];
      height = std::max(height, waited[static_cast<std::size_t>(node)] + 1);
    }
    for (const int a : mine) {
      tied[static_cast<std::size_t>(a)].erase(node);
      for (const int b : mine)
        if (a != b) tied[static_cast<std::size_t>(a)].insert(b);
    }
  }
}

}  // namespace
}  // namespace azimuth
