#pragma once
// Reliability of a run: the estimator's health over time, and the distance driven without bearings.

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

/// Health that the estimator reports at one step.
struct StepHealth {
  Stamp stamp{};
  Health health = Health::starting;
  std::string_view reason;  ///< static text
  bool used_bearing = false;
};

/// Distance that odometry has driven up to an instant.
struct DrivenBy {
  Stamp stamp{};
  double path_m = 0.0;
};

/// Statistics of one health state.
struct HealthTime {
  double seconds = 0.0;
  double share = 0.0;                       ///< share of the run's duration
  std::string first_reason;                 ///< reason of the first step in this state that has a reason
  double first_reason_at_s = kNotMeasured;  ///< time of that step since the start of the run
};

/// Driving on odometry alone. A gap is a period in which no step used a bearing. It lasts at least one second and more
/// than three times the usual interval between steps. Periods at the start and end of the run count.
struct BlindReport {
  double driven_m = kNotMeasured;  ///< distance driven in all gaps
  double path_m = kNotMeasured;    ///< distance driven in the whole run
  std::size_t gaps = 0;
  double longest_s = kNotMeasured;  ///< longest period between two used bearings, whether it is a gap or not
};

struct HealthReport {
  std::array<HealthTime, kHealths.size()> times;  ///< in the order of kHealths
  std::size_t times_lost = 0;
  std::size_t times_found = 0;  ///< number of successful relocalisations after being lost
  BlindReport blind;

  const HealthTime& of(Health health) const { return times[static_cast<std::size_t>(health)]; }
};

/// A health state lasts until the next step; before the first step it is `starting`. `steps` and `driven` are sorted by
/// stamp. Without steps, all values are kNotMeasured.
HealthReport health_report(std::span<const StepHealth> steps, std::span<const DrivenBy> driven);

}  // namespace azimuth
