#pragma once
// Sorts out records with jumping stamps. Thread contract: reentrant.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace azimuth {

/// Removes as few records as possible so that `stamp` strictly increases, and returns their number. After one wild
/// stamp only that record is removed, not all that follow. Of records with equal stamps the first is kept. O(n log n),
/// or O(n) when nothing has to be removed.
template <class Record>
std::uint64_t keep_in_order(std::vector<Record>& records) {
  const auto not_after = [](const Record& a, const Record& b) { return b.stamp <= a.stamp; };
  if (std::ranges::adjacent_find(records, not_after) == records.end()) return 0;

  // Longest increasing subsequence: among all increasing sequences of k + 1 records, ends[k] is the last record of the
  // one that ends with the earliest stamp.
  constexpr auto kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> ends, before(records.size(), kNone);
  const auto stamp_of = [&records](std::size_t i) { return records[i].stamp; };
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto place = std::ranges::lower_bound(ends, records[i].stamp, {}, stamp_of);
    if (place != ends.begin()) before[i] = *(place - 1);
    if (place == ends.end()) {
      ends.push_back(i);
    } else if (records[i].stamp < stamp_of(*place)) {
      *place = i;
    }
  }

  std::vector<Record> kept;
  kept.reserve(ends.size());
  for (std::size_t i = ends.back(); i != kNone; i = before[i]) kept.push_back(std::move(records[i]));
  std::ranges::reverse(kept);
  records.swap(kept);
  return kept.size() - records.size();
}

}  // namespace azimuth
