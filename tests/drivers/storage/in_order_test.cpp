#include "drivers/storage/in_order.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "drivers/storage/run.hpp"

namespace azimuth {
namespace {

struct Record {
  int stamp = 0;
  char label = ' ';
};

std::vector<Record> records(const std::vector<int>& stamps) {
  std::vector<Record> out;
  out.reserve(stamps.size());
  for (const int stamp : stamps) out.push_back({stamp, static_cast<char>('a' + out.size())});
  return out;
}

std::string labels(const std::vector<Record>& kept) {
  std::string out;
  for (const Record& record : kept) out += record.label;
  return out;
}

std::string kept_of(const std::vector<int>& stamps) {
  auto all = records(stamps);
  const auto removed = keep_in_order(all);
  EXPECT_EQ(removed + all.size(), stamps.size());
  return labels(all);
}

TEST(KeepInOrder, LeavesOrderedRecordsAlone) {
  EXPECT_EQ(kept_of({}), "");
  EXPECT_EQ(kept_of({5}), "a");
  EXPECT_EQ(kept_of({1, 2, 9}), "abc");
}

TEST(KeepInOrder, OneWildStampCostsOneRecord) {
  EXPECT_EQ(kept_of({1, 2, 1000, 3, 4}), "abde");
  EXPECT_EQ(kept_of({1, 2, -1000, 3, 4}), "abde");
  EXPECT_EQ(kept_of({1000, 1, 2, 3}), "bcd");
}

TEST(KeepInOrder, FirstOfEqualStampsStays) { EXPECT_EQ(kept_of({1, 1, 2, 2, 2, 3}), "acf"); }

TEST(KeepInOrder, ClockSetBackKeepsTheLongerPart) { EXPECT_EQ(kept_of({10, 11, 12, 1, 2, 3, 4}), "defg"); }

/// O(n^2) reference: the length of the longest strictly increasing subsequence.
std::size_t longest_increasing(const std::vector<int>& stamps) {
  std::vector<std::size_t> length(stamps.size(), 1);
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (stamps[j] < stamps[i]) length[i] = std::max(length[i], length[j] + 1);
    }
  }
  return stamps.empty() ? 0 : std::ranges::max(length);
}

RC_GTEST_PROP(KeepInOrder, RemovesAsFewAsPossible, (const std::vector<signed char>& bytes)) {
  const std::vector<int> stamps(bytes.begin(), bytes.end());
  auto all = records(stamps);
  keep_in_order(all);
  RC_ASSERT(all.size() == longest_increasing(stamps));
  RC_ASSERT(std::ranges::adjacent_find(all, std::greater_equal{}, &Record::stamp) == all.end());
}

}  // namespace
}  // namespace azimuth
