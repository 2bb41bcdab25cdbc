#pragma once

namespace azimuth {

/// Which lamps an image should show.
struct LampsInView {
  double detection_probability = 0.0;  ///< For a lamp in the field of view, at most 0.95; 0: the rig's value, else 0.85
  double max_zenith_rad = 0.0;         ///< Limit of the field of view; 0: the rig's value, else the estimator's default
  double inner_margin = 0.1;           ///< Share of max_zenith_rad, at the rim, in which no lamp counts as missed

  friend bool operator==(const LampsInView&, const LampsInView&) = default;
};

}  // namespace azimuth
