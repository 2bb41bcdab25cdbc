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

/// A series with one value per step.
struct PageColumn {
  std::string_view name;
  double unit = 0.0;         ///< values are rounded to multiples of this; 0: to five significant digits
  bool keeps_peaks = false;  ///< thinning keeps the extremes of this column
  std::vector<double> values;
};

/// The series of a run. Each column has one value per step; NaN means no value. Columns:
///
/// - `t`: time since the first step [s]. `x`, `y`, `heading`: estimate in the map frame. `xx`, `xy`, `yy`: covariance
///   of the position [m^2]. `odometry_x` etc.: dead reckoning from the first estimate. `truth_x` etc.: truth in the map
///   frame by the report's alignment.
/// - `error_x`, `error_y`, `error_heading`: errors as used for the ANEES. Estimate and truth are relative to the first
///   step with truth, in the robot's frame at that step; no values without truth. `two_sigma_x` etc.: two standard
///   deviations in the same frame; without truth, in the map frame.
/// - `off`: distance from the truth after alignment. `nees`: normalised estimation error squared. `anees`: mean of
///   `nees` up to the step.
/// - `nis`: mean normalised innovation squared of the step's compared bearings. `nis_low`, `nis_high`: limits of the
///   95 % interval of this mean for independent bearings. `nis_recent`: mean over the bearings of the last ten seconds.
/// - `accepted`, `rejected`, `ambiguous`, `thinned`, `created`: counts since the start. `seen`: bearings of the step.
/// - `step_us`: time from samples to estimate [us].
std::vector<PageColumn> page_series(const Run& run, const ReplayResult& result, const Report& report,
                                    std::span<const PageStep> steps);

}  // namespace azimuth
