#pragma once
// What a page says of runs in one table, so that they can be compared.

#include <string>
#include <string_view>
#include <vector>

#include "tools/evaluate/report.hpp"

namespace azimuth {

struct PageMetric {
  /// Which of two values is the better one.
  enum class Better { neither, lower, higher, nearer_to_three };

  std::string_view key;    ///< the same of every run
  std::string_view label;  ///< for people
  std::string_view unit;   ///< empty: a plain number
  double value = kNotMeasured;
  int decimals = 0;
  Better better = Better::neither;
  std::string note = {};  ///< for people: what it is of
};

/// Only what was measured.
std::vector<PageMetric> page_metrics(const Report& report);

}  // namespace azimuth
