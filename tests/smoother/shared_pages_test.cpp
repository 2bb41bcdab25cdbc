#include "slam/smoother/shared_pages.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace azimuth {
namespace {

using Pages = SharedPages<int, 4>;

TEST(SharedPages, ACopySharesWhatNeitherHasChanged) {
  Pages list;
  for (int i = 0; i < 10; ++i) list.push_back(i);
  Pages copy = list;
  EXPECT_EQ(&copy[5], &list[5]);
  copy.edit(5) = 50;
  EXPECT_EQ(list[5], 5);
  EXPECT_EQ(copy[5], 50);
  EXPECT_EQ(&copy[9], &list[9]);  // in another page
}

RC_GTEST_PROP(SharedPagesProperty, CopiesAreLikeCopiesOfVectors,
              (const std::vector<std::tuple<bool, int, int>>& steps)) {
  // Two lists and two vectors to compare with. Each step appends, changes an element, or copies one list to the other.
  std::array<Pages, 2> lists;
  std::array<std::vector<int>, 2> plain;
  for (const auto& [which, what, value] : steps) {
    const std::size_t at = which ? 1 : 0;
    if (what % 7 == 0) {
      lists[1 - at] = lists[at];
      plain[1 - at] = plain[at];
    } else if (what % 2 == 0 || plain[at].empty()) {
      lists[at].push_back(value);
      plain[at].push_back(value);
    } else {
      const std::size_t entry = static_cast<std::size_t>(std::abs(static_cast<long>(what))) % plain[at].size();
      lists[at].edit(static_cast<int>(entry)) = value;
      plain[at][entry] = value;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      RC_ASSERT(static_cast<std::size_t>(lists[i].size()) == plain[i].size());
      for (int k = 0; k < lists[i].size(); ++k) RC_ASSERT(lists[i][k] == plain[i][static_cast<std::size_t>(k)]);
    }
  }
}

}  // namespace
}  // namespace azimuth
