#pragma once
// Computes odometry from the counters of two wheels. Wrapping counters are unwrapped; restarts are bridged.
//
// Thread contract: reentrant.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/sample/odometry_steps.hpp"

namespace azimuth {

/// The counter of one wheel and the range in which it wraps.
///
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

/// Distances that both wheels have rolled at one instant.
struct WheelReading {
  Stamp stamp{};
  double left_m = 0.0, right_m = 0.0;
};

/// Metres per recorded unit (radian or tick) of each wheel.
struct WheelCounts {
  double left_m = 1.0, right_m = 1.0;
};

/// Computes poses for a wheel track of `track_m`. `readings` are sorted by stamp; the first one is the origin. A
/// counter with an unambiguous range (it contains all readings, and some steps span nearly all of it) is unwrapped, and
/// `notes` says so. If both counters restart at zero, or if a wheel occasionally makes an impossible step, the pose
/// continues with another origin and with the uncertainty of the unknown motion. Fails, with time and size of a step,
/// if the counts make large steps without an unambiguous range. Errors name `file`.
FileResult<std::vector<OdometryReading>> wheel_odometry(std::vector<WheelReading> readings, const WheelCounts& counts,
                                                        double track_m, const std::string& file,
                                                        std::vector<std::string>& notes);

}  // namespace azimuth
