#pragma once
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay_page/step_log.hpp"

namespace azimuth {

/// A number of every step.
struct PageColumn {
  std::string_view name;
  double unit = 0.0;         ///< written in whole multiples of this; 0: to five significant digits
  bool keeps_peaks = false;  ///< thinned so that its extremes stay
  std::vector<double> values;
};

/// The run over its steps, one value a step in each column, NaN where there is none. Frames and meaning:
///
/// - `t`: seconds since the first step. `x`, `y`, `heading`: the estimate, in the map; `xx`, `xy`, `yy`: covariance of
///   its position [m^2]; `odometry_x` and so on: odometry alone, from the first estimate on; `truth_x` and so on: truth
///   laid over the map by the report's alignment.
/// - `error_x`, `error_y`, `error_heading`: as ANEES judges them, both relative to the first step with truth, in its
///   robot's frame; without truth there are none. `two_sigma_x` and so on: beside these; without truth, in the map.
/// - `off`: distance from the truth after the alignment. `nees`: normalised error squared; `anees`: its mean so far.
/// - `nis`: mean normalised innovation squared of the step's compared bearings; `nis_low`, `nis_high`: where 95 % of
///   such means are if bearings are independent; `nis_recent`: mean of the bearings of the last ten seconds.
/// - `accepted`, `rejected`, `ambiguous`, `thinned`, `created`: counted since the start. `seen`: bearings of the step.
/// - `step_us`: microseconds from samples to estimate.
std::vector<PageColumn> page_series(const Run& run, const ReplayResult& result, const Report& report,
                                    std::span<const PageStep> steps);

}  // namespace azimuth
