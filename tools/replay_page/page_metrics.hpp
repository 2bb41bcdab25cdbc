#pragma once
// The figures of a run in the comparison table of a page.

#include <string>
#include <string_view>
#include <vector>

#include "tools/evaluate/report.hpp"

namespace azimuth {

struct PageMetric {
  /// Rule for which of two values is better.
  enum class Better { neither, lower, higher, nearer_to_three };

  std::string_view key;    ///< identifier, equal for all runs
  std::string_view label;  ///< name for the user
  std::string_view unit;   ///< empty for a plain number
  double value = kNotMeasured;
  int decimals = 0;
  Better better = Better::neither;
  std::string note = {};  ///< explanation for the user
};

/// The measured figures of the report.
std::vector<PageMetric> page_metrics(const Report& report);

}  // namespace azimuth
