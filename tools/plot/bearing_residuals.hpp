#pragma once
// The picture of bearing residuals before and after a calibration: it shows why a value of the rig was replaced.

#include <string>
#include <vector>

#include "tools/plot/canvas.hpp"

namespace azimuth {

/// The residual of a bearing: measured minus expected azimuth.
struct PlottedResidual {
  double azimuth_rad = 0.0;  ///< measured azimuth in the robot's frame
  double sigmas = 0.0;       ///< residual in standard deviations of the bearing
};

struct BearingResiduals {
  std::string title;
  std::vector<PlottedResidual> before, after;
};

/// Share of the residuals within `most` standard deviations; 0 if there are none.
double share_within(const std::vector<PlottedResidual>& residuals, double most);

/// Draws two diagrams of 1600 pixels width together: on the left the histograms of the residuals and the standard
/// normal density, on the right the residuals over their azimuths, with the median of every 15 degrees. Residuals
/// outside the frame count in the shares, but are not drawn. Of more than two thousand residuals some are left out on
/// the right.
PlotCanvas drawn_residuals(const BearingResiduals& residuals, PlotFormat format);

}  // namespace azimuth
