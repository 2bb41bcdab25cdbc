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
  EXPECT_EQ(fill(elimination), 4u);  // none is filled in
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
  EliminationGraph graph(70);  // more than a word of bits
  const std::vector<int> all{0, 1, 65, 69};
  graph.tie_all(all);
  graph.tie(3, 3);
  const Elimination elimination = graph.eliminate(std::vector<std::uint8_t>(70, 0));
  EXPECT_EQ(fill(elimination), 6u);
  EXPECT_EQ(elimination.order.size(), 70u);
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
  for (std::size_t i = 0; i < elimination.order.size(); ++i) {
    const int node = elimination.order[i];
    const std::set<int> mine = tied[static_cast<std::size_t>(node)];
    RC_ASSERT(std::vector<int>(mine.begin(), mine.end()) == elimination.behind[i]);
    for (std::size_t k = i + 1; k < elimination.order.size(); ++k) {
      const auto other = static_cast<std::size_t>(elimination.order[k]);
      RC_ASSERT(ranks[static_cast<std::size_t>(node)] <= ranks[other]);
      // Of those that may go, none had fewer ties.
      if (ranks[static_cast<std::size_t>(node)] == ranks[other]) RC_ASSERT(tied[other].size() >= mine.size());
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
