#pragma once
// The figures of a report that are compared, with their names, units and limits.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace azimuth {

enum class Better : std::uint8_t {
  lower,
  higher,           ///< for shares, which are at most 1
  nearer_to_three,  ///< for the ANEES, whose ideal value is 3
};

/// Limits that decide whether a change counts. They apply to the badness of a figure: see badness(). A run is worse if
/// its badness exceeds the limits `relative`, `absolute` and `good_enough` all together.
struct FigureLimits {
  double relative = 0.1;     ///< limit of the growth relative to the previous badness; infinite: no limit
  double absolute = 0.0;     ///< limit of the growth
  double good_enough = 0.0;  ///< limit of the new badness: smaller values are never worse
  double mean = 0.02;        ///< limit of the mean change over runs, in terms of change_of()
  /// Limit of the new value, independent of the previous value. NaN: no limit.
  double worst = std::numeric_limits<double>::quiet_NaN();
};

struct Figure {
  std::string_view key;    ///< name in limits and tables; ends in the unit of the report
  std::string_view label;  ///< name for the user
  std::string_view unit;   ///< unit of displayed values
  double shown_factor;     ///< conversion factor from the report's unit to `unit`
  int decimals;
  Better better;
  std::array<std::string_view, 3> path;   ///< JSON path of the value in a report; unused elements are empty
  std::array<std::string_view, 3> total;  ///< JSON path of the value to divide by; empty if none
  bool by_ratio;                          ///< true: compared by ratio; false: compared by difference
  bool is_cost;                           ///< time or memory, which differ between any two replays
  FigureLimits limits;
};

/// All figures, in the order of the tables. Reentrant, as all of tools/compare.
std::span<const Figure> figures();

inline constexpr std::size_t kFigures = 17;

/// A measure that grows as the figure gets worse: the value itself, the difference of a share from 1, or the factor
/// between ANEES and 3 in either direction. NaN if the value is NaN.
double badness(const Figure& figure, double value);

/// Change of badness: relative growth for figures compared by ratio, otherwise the difference. 0 if both are equal; NaN
/// if the change is undefined.
double change_of(const Figure& figure, double badness_before, double badness_after);

}  // namespace azimuth
