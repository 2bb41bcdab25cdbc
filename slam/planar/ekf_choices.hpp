#pragma once
#include <optional>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/estimator/restartable_estimator.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/planar/ekf_settings.hpp"

namespace azimuth {

// Settings of the planar EKF that depend on the rig. Thread contract: reentrant.

/// Whether features are told apart by their descriptors.
bool names_by_looks(const Rig& rig);
/// Whether landmarks have names, from the sensor or from descriptors. Otherwise data association goes by position.
bool names_landmarks(const Rig& rig);

/// Resolves the settings that depend on the rig, and applies the settings for features where the rig uses features.
EkfSettings settings_for(const Rig& rig, EkfSettings settings);

/// How landmarks are initialised: as the settings say, within what the rig allows.
Initialisation chosen_initialisation(const Rig& rig, const EkfSettings& settings);

/// Expected density of bearings of unmapped landmarks, per radian and bearing.
double chosen_new_density_per_rad(const Rig& rig, const EkfSettings& settings);

/// Settings of the filter itself; `again` holds the known camera errors when the filter is started a second time.
BearingEkfSettings filter_settings(const Rig& rig, const EkfSettings& settings,
                                   const std::optional<Restart>& again = {});

}  // namespace azimuth
