#pragma once
#include <optional>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/estimator/begins_twice.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/planar/ekf_settings.hpp"

namespace azimuth {

// What the planar EKF leaves to the rig. Thread contract: reentrant.

/// Features are told apart by their looks.
bool names_by_looks(const Rig& rig);
/// By the sensor or by their looks: else which bearing is of which landmark is found out by where they are.
bool names_landmarks(const Rig& rig);

/// With what follows from the rig, and what applies to features where there are some.
EkfSettings settings_for(const Rig& rig, EkfSettings settings);

/// How a landmark enters the map: as the settings say, or as the rig allows.
Initialisation chosen_initialisation(const Rig& rig, const EkfSettings& settings);

/// How often a bearing is of something unmapped, per radian and bearing.
double chosen_new_density_per_rad(const Rig& rig, const EkfSettings& settings);

/// The filter itself; where it begins again, with what is known of the image's centre.
BearingEkfSettings filter_settings(const Rig& rig, const EkfSettings& settings,
                                   const std::optional<SecondBeginning>& again = {});

}  // namespace azimuth
