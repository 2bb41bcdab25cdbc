#pragma once
// How far a run could be relied on: its health over time, and what was driven without seeing anything.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slam/estimator/estimate.hpp"
#include "slam/sample/stamp.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth {

inline constexpr std::array kHealths{Health::starting, Health::tracking, Health::degraded, Health::lost};

/// What a step says of itself.
struct StepHealth {
  Stamp stamp{};
  Health health = Health::starting;
  std::string_view reason;  ///< static text
  bool used_bearing = false;
};

/// How far the odometer had driven by then.
struct DrivenBy {
  Stamp stamp{};
  double path_m = 0.0;
};

/// Of one health.
struct HealthTime {
  double seconds = 0.0;
  double share = 0.0;                       ///< of the run
  std::string first_reason;                 ///< of the first of its steps with one
  double first_reason_at_s = kNotMeasured;  ///< since the start of the run
};

/// Driven on odometry alone. A gap is a time without a step that used a bearing, of a second at least and longer than
/// three times the usual one between steps; starts and ends of runs count.
struct BlindReport {
  double driven_m = kNotMeasured;  ///< in all gaps
  double path_m = kNotMeasured;    ///< of the whole run
  std::size_t gaps = 0;
  double longest_s = kNotMeasured;  ///< from one used bearing to the next, whether a gap or not
};

struct HealthReport {
  std::array<HealthTime, kHealths.size()> times;  ///< in the order of kHealths
  std::size_t times_lost = 0;
  std::size_t times_found = 0;  ///< again, after having been lost
  BlindReport blind;

  const HealthTime& of(Health health) const { return times[static_cast<std::size_t>(health)]; }
};

/// A health holds until the next step; before the first one the run is starting. Both are in the order of their stamps.
/// Without a step: nothing is measured.
HealthReport health_report(std::span<const StepHealth> steps, std::span<const DrivenBy> driven);

}  // namespace azimuth
