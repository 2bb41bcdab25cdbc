#pragma once
// The counter of one wheel and the range in which it wraps. Internal to tools/import.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slam/sample/odometry_steps.hpp"

namespace azimuth {

/// Thread contract: reentrant.
class WheelCounter {
 public:
  /// `counts`: at least one recorded count. One count corresponds to `count_m` metres.
  WheelCounter(std::vector<Stamp> stamps, std::vector<double> counts, double count_m);

  /// The range after which the counter restarts: a common one, such as a full turn, 8, 16 or 32 bits, or another one on
  /// which at least three wraps agree. Nothing if the counter does not wrap or no range fits.
  std::optional<double> range() const;

  /// A range that contains all counts and in which the steps are so large that their direction is ambiguous; nothing if
  /// there is none.
  std::optional<double> range_too_narrow() const;

  /// Makes the counts continuous over wraps. Returns the number of wraps.
  std::size_t unwrap(double range);

  /// A step that no wheel can make, and the index of the reading after the step.
  struct Jump {
    std::size_t index = 0;
    OdometryJump jump;
  };
  std::vector<Jump> jumps() const;

  /// True if the step to the reading is at least half of the whole span of counts.
  bool is_most_of_all(std::size_t index) const { return 2.0 * std::abs(step(index)) > span_; }

  double rolled_m(std::size_t index) const { return count_m_ * counts_[index]; }
  double step(std::size_t index) const { return counts_[index] - counts_[index - 1]; }  ///< step to the reading

 private:
  bool may_be(double range) const;
  bool fits(double range) const;
  double misfit(double range) const;
  std::optional<double> agreed_range() const;
  double elapsed_s(std::size_t index) const;
  double wrapped(std::size_t index, double range) const;
  double speed_near(std::size_t index, double longest, bool fastest) const;

  std::vector<Stamp> stamps_;
  std::vector<double> counts_;
  double count_m_;
  double span_ = 0.0, longest_step_ = 0.0;
  bool are_whole_ = false;
};

/// Examples: "65536 (16 bits)", "a full turn".
std::string range_text(double range);

}  // namespace azimuth
