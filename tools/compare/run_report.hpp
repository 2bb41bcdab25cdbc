#pragma once
// One report of `azimuth replay`, as far as it is compared.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "tools/compare/figure.hpp"

namespace azimuth {

struct RunReport {
  std::string file;  ///< as given to the reader
  std::string name;  ///< what pairs it with others: that of `replay --name`, else its run's
  std::vector<std::string> tags;
  std::vector<std::string> overrides;  ///< what `--set` changed
  std::string estimator, made_by;      ///< may be empty
  std::string digest;                  ///< of the estimates; empty: unknown
  std::uint64_t seed = 0;
  bool is_older = false;                  ///< of a version that wrote neither name nor tags
  std::string incomplete;                 ///< what of the recording could not be read; empty: nothing
  std::string failure;                    ///< why nothing came of the run; empty: something did
  std::array<double, kFigures> values{};  ///< in the reports' units, of figures(); not a number: not measured
};

/// Reads the text of a report, or of what stands in its place where a replay failed: an object with `name` and
/// `failure`. `file` is what an error names. Throws nothing but std::bad_alloc, whatever the text.
FileResult<RunReport> read_report(std::string_view text, const std::string& file);

}  // namespace azimuth
