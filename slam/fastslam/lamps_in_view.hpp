#pragma once

namespace azimuth {

/// Which lamps an image should show.
struct LampsInView {
  double detection_probability = 0.0;  ///< of a lamp in view, at most 0.95; 0: by rig, else 0.85
  double max_zenith_rad = 0.0;         ///< lamps are in view up to here; 0: by rig, else as the estimator has it
  double inner_margin = 0.1;           ///< share of that angle at its rim in which nothing counts as missed

  friend bool operator==(const LampsInView&, const LampsInView&) = default;
};

}  // namespace azimuth
