#pragma once
// What one wheel has counted, and the range in which it does. Internal to tools/import.

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
  /// `counts`: as they were written, of `count_m` each; at least one.
  WheelCounter(std::vector<Stamp> stamps, std::vector<double> counts, double count_m);

  /// The range at whose end it begins again: a full turn, 8, 16 or 32 bits and the like, or another one that at least
  /// three wraps agree upon. Nothing: it does not wrap, or none fits.
  std::optional<double> range() const;

  /// One that it stays within, stepping through it so fast that nobody can tell which way; nothing: there is none.
  std::optional<double> range_too_narrow() const;

  /// Goes on where it would begin again; how often it did.
  std::size_t unwrap(double range);

  /// Steps that no wheel makes, and the index of the reading after each.
  struct Jump {
    std::size_t index = 0;
    OdometryJump jump;
  };
  std::vector<Jump> jumps() const;

  /// Whether the step to that reading is half of what it ever counted, or more.
  bool is_most_of_all(std::size_t index) const { return 2.0 * std::abs(step(index)) > span_; }

  double rolled_m(std::size_t index) const { return count_m_ * counts_[index]; }
  double step(std::size_t index) const { return counts_[index] - counts_[index - 1]; }  ///< to that reading

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

/// "65536 (16 bits)", "a full turn".
std::string range_text(double range);

}  // namespace azimuth
