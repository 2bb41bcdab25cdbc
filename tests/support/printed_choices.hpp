#pragma once
// Lets GoogleTest print the enumerations of parameterised tests by name instead of as bytes.

#include <ostream>

#include "slam/ekf/joint_state.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

inline void PrintTo(JointState::Retraction retraction, std::ostream* out) {
  *out << (retraction == JointState::Retraction::additive ? "additive" : "invariant");
}

inline void PrintTo(Initialisation initialisation, std::ostream* out) {
  *out << (initialisation == Initialisation::delayed     ? "delayed"
           : initialisation == Initialisation::undelayed ? "undelayed"
                                                         : "by_rig");
}

inline void PrintTo(FeatureValidation validation, std::ostream* out) {
  *out << (validation == FeatureValidation::geometry   ? "geometry"
           : validation == FeatureValidation::patterns ? "patterns"
                                                       : "combined");
}

inline void PrintTo(MapMode mode, std::ostream* out) { *out << (mode == MapMode::localise ? "localise" : "extend"); }

inline void PrintTo(PixelFormat pixels, std::ostream* out) { *out << name(pixels); }

}  // namespace azimuth
