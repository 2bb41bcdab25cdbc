#pragma once
// Reports of a version beside those of another, run by run and tag by tag: what got worse, and how sure that is.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tools/compare/inference.hpp"
#include "tools/compare/report_files.hpp"

namespace azimuth {

enum class Trend : std::uint8_t {
  unmeasured,  ///< now and before, or there is nothing before
  gone,        ///< measured before, no longer now
  equal,       ///< to the last bit
  alike,       ///< within the limits, or within what seeds scatter
  better,
  worse,
  unjudged,  ///< past the limits; but seeds differ, and none is repeated
};
std::string_view to_string(Trend trend);

struct FigureChange {
  double before, after;  ///< means over seeds; not a number: not measured
  double change;         ///< see change_of()
  double chance;         ///< that scatter of seeds alone does that; not a number: none is repeated
  Trend trend;
  double severity;  ///< the change over what is allowed; at most as large as the limits are loose
};

/// A run in both, or now only.
struct ComparedRun {
  std::string name;
  std::vector<std::string> tags;
  std::vector<std::uint64_t> seeds, seeds_before;  ///< in order
  std::string digest, digest_before;               ///< of the first seed's
  std::array<FigureChange, kFigures> changes;

  bool has(Trend trend) const;
  double severity() const;  ///< the largest; if nothing got worse, the least
};

/// All runs with a tag, each counting once.
struct ComparedGroup {
  struct Mean {
    double before, after;  ///< of the runs that have both, else of all that have it now
    MeanInterval change;   ///< of their changes; by ratio: the geometric mean
    Trend trend;           ///< unmeasured as well where runs are too few to judge
  };
  std::string tag;  ///< empty: all runs
  std::size_t runs = 0;
  std::array<Mean, kFigures> means;
};

/// A report that says why nothing came of its run, or what of it could not be read.
struct FailedRun {
  std::string name, why;
};

/// Several reports of one name and seed: the first is used.
struct TwiceReported {
  std::string name, used, left_out;  ///< of files
};

struct CompareSettings {
  std::array<FigureLimits, kFigures> limits;
  /// That any is called worse though nothing but seeds differs: shared by all that are tested.
  double chance_of_false_alarm = 0.05;
  bool with_costs = true;                                          ///< false: times and memory are left out
  std::size_t missing = 0, failed = 0, unreadable = 0, twice = 0;  ///< allowed
};
CompareSettings default_compare_settings();

struct Comparison {
  bool has_baseline = false;
  std::vector<ComparedRun> runs;      ///< what got worse first; without a baseline the least accurate
  std::vector<ComparedGroup> groups;  ///< all first, then by tag
  std::vector<std::string> missing;   ///< in the baseline alone
  std::vector<std::string> added;     ///< not in the baseline
  std::vector<FailedRun> failed, failed_before;
  std::vector<FailedRun> incomplete;  ///< of logs that are cut, damaged or of other versions; each run once, by name
  std::vector<TwiceReported> twice;
  FileErrors unreadable;
  std::vector<std::string> older;    ///< files of versions that wrote neither name nor tags
  std::vector<std::string> made_by;  ///< versions, and those before
  std::vector<std::string> made_by_before;
};

/// `before` may be null: there is nothing to compare with, and runs are told as they are.
Comparison compare(const Reports& after, const Reports* before, const CompareSettings& settings);

/// What is past its limit, a sentence each; empty: nothing.
std::vector<std::string> past_limits(const Comparison& comparison, const CompareSettings& settings);

}  // namespace azimuth
