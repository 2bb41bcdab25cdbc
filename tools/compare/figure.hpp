#pragma once
// What of a report is compared: its numbers by name, and which way each is better.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace azimuth {

enum class Better : std::uint8_t {
  lower,
  higher,           ///< a share, 1 at most
  nearer_to_three,  ///< ANEES
};

/// When a change counts. A figure's badness is what is compared: see badness().
struct FigureLimits {
  double relative = 0.1;     ///< grown by more than this part of what it was; infinite: never
  double absolute = 0.0;     ///< and by more than this
  double good_enough = 0.0;  ///< and more than this now: whatever is no more is no trouble
  double mean = 0.02;        ///< on the average of runs: more than this, as change_of() measures it
  double worst = std::numeric_limits<double>::quiet_NaN();  ///< a value beyond which none may be, whatever it was
                                                            ///< before; not a number: any may
};

struct Figure {
  std::string_view key;    ///< as limits and tables name it; ends in its unit
  std::string_view label;  ///< for people
  std::string_view unit;   ///< of what is shown
  double shown_factor;     ///< from the report's unit to that
  int decimals;
  Better better;
  std::array<std::string_view, 3> path;   ///< where a report has it; unused: empty
  std::array<std::string_view, 3> total;  ///< what it is a share of; empty: nothing
  bool by_ratio;                          ///< compared by how many times it is; else by the difference
  bool is_cost;                           ///< of time or memory, which no two replays share
  FigureLimits limits;
};

/// In the order in which tables show them. Reentrant, as all of tools/compare.
std::span<const Figure> figures();

/// Their number.
inline constexpr std::size_t kFigures = 17;

/// The more, the worse: the value, what a share lacks of 1, the factor by which ANEES is off 3 either way. Not a
/// number: neither is the value.
double badness(const Figure& figure, double value);

/// How much worse, in badness: the part by which it has grown, or the difference. 0 where both are the same; not a
/// number where that says nothing.
double change_of(const Figure& figure, double badness_before, double badness_after);

}  // namespace azimuth
