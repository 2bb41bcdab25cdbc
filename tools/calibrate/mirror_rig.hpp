#pragma once
#include <string>

#include "slam/estimator/rig.hpp"
#include "slam/perception/calibration/mirror_finder.hpp"

namespace azimuth {

/// What images do not say about a camera with a mirror.
struct MirrorModel {
  std::string model = "radial";  ///< "radial", "hyperbolic_mirror" or "parabolic_mirror"
  FrontEnd front_end = FrontEnd::sift;
  std::optional<double> mirror_a_mm, mirror_b_mm, focal_length_px, horizon_radius_px;
};

/// The rig of a robot whose camera's mirror was found in images of this size; everything else as by default, the
/// heading up in the image.
Rig mirror_rig(const MirrorCircle& mirror, const FrameFormat& format, const MirrorModel& model);

/// The rig.toml, with what remains to be checked by hand before it is used. `why_front_end`: that it is this one;
/// empty: it was asked for.
std::string mirror_rig_text(const Rig& rig, int images, const std::string& why_front_end = {});

/// Of a robot of which nothing is known: (1.8 degrees)^2 for each metre. A filter that trusts a heading which drifts
/// takes its drift for an error of the image's centre, and loses both; one that trusts it too little only learns more
/// slowly.
inline constexpr double kUnknownDrift_rad2_per_m = 1e-3;

/// The mask keeps this far from the rim and from the inner disc: their edges are as blurred.
inline constexpr double kMaskMargin_px = 2.0;

}  // namespace azimuth
