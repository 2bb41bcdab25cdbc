#pragma once
// Compares the reports of two program versions, by run and by tag: which figures got worse, and how certain that is.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "tools/compare/inference.hpp"
#include "tools/compare/report_files.hpp"

namespace azimuth {

enum class Trend : std::uint8_t {
  unmeasured,  ///< not measured now and before, or no baseline
  gone,        ///< measured before, but not now
  equal,       ///< bit-identical
  alike,       ///< the change is within the limits, or within the scatter of seeds
  better,
  worse,
  unjudged,  ///< past the limits, but the seeds differ and no run is repeated with several seeds
};
std::string_view to_string(Trend trend);

struct FigureChange {
  double before, after;  ///< means over seeds; NaN if not measured
  double change;         ///< see change_of()
  double chance;         ///< probability of this change by scatter of seeds alone; NaN without repeated seeds
  Trend trend;
  double severity;  ///< ratio of the change to the allowed change
};

/// A run that both versions have, or only the new version.
struct ComparedRun {
  std::string name;
  std::vector<std::string> tags;
  std::vector<std::uint64_t> seeds, seeds_before;  ///< in ascending order
  std::string digest, digest_before;               ///< digests of the first seed
  std::array<FigureChange, kFigures> changes;

  bool has(Trend trend) const;
  double severity() const;  ///< the largest severity; if no figure got worse, the least one
};

/// All runs with a tag. Each run counts once.
struct ComparedGroup {
  struct Mean {
    double before, after;  ///< means over the runs with both values, otherwise over all runs with a new value
    MeanInterval change;   ///< mean change; for figures compared by ratio the geometric mean
    Trend trend;           ///< also `unmeasured` if there are too few runs
  };
  std::string tag;  ///< empty for the group of all runs
  std::size_t runs = 0;
  std::array<Mean, kFigures> means;
};

/// A run that failed or whose recording is incomplete, with the reason.
struct FailedRun {
  std::string name, why;
};

/// Several reports with the same name and seed, of which the first is used.
struct TwiceReported {
  std::string name, used, left_out;  ///< name of the run; file names of the used and the ignored report
};

struct CompareSettings {
  std::array<FigureLimits, kFigures> limits;
  /// Probability that any run is called worse although only seeds differ. All tests share this probability.
  double chance_of_false_alarm = 0.05;
  bool with_costs = true;                                          ///< false ignores computing times and memory
  std::size_t missing = 0, failed = 0, unreadable = 0, twice = 0;  ///< allowed numbers of such reports
};
CompareSettings default_compare_settings();

struct Comparison {
  bool has_baseline = false;
  std::vector<ComparedRun> runs;      ///< the worst change first; without a baseline the least accurate run first
  std::vector<ComparedGroup> groups;  ///< all runs first, then by tag
  std::vector<std::string> missing;   ///< runs that only the baseline has
  std::vector<std::string> added;     ///< runs that the baseline does not have
  std::vector<FailedRun> failed, failed_before;
  std::vector<FailedRun> incomplete;  ///< runs of truncated, damaged or incompatible logs; each run once, by name
  std::vector<TwiceReported> twice;
  FileErrors unreadable;
  std::vector<std::string> older;    ///< report files whose format has neither name nor tags
  std::vector<std::string> made_by;  ///< program versions of the new reports, and of the baseline
  std::vector<std::string> made_by_before;
};

/// `before` may be null. The result then describes the runs without a comparison.
Comparison compare(const Reports& after, const Reports* before, const CompareSettings& settings);

/// One sentence for each value past its limit; empty if there is none.
std::vector<std::string> past_limits(const Comparison& comparison, const CompareSettings& settings);

/// Reads the limits of `azimuth report compare --limits FILE` from TOML text; missing values keep their defaults. All
/// violations are reported; they name `file`.
FileResult<CompareSettings> read_limits(std::string_view text, const std::string& file);

}  // namespace azimuth
