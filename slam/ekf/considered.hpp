#pragma once
#include <Eigen/Core>

namespace azimuth {

// What a rig says that a filter takes for exact and considers: by how much the true value is more than the rig's.
namespace considered {
inline constexpr int scale_distance = 0, scale_turn = 1;  ///< relative errors of the odometer's scales
inline constexpr int lag = 2;                             ///< images are taken so much earlier than stamped [s]
inline constexpr int drift = 3;                           ///< heading gained for each metre driven [rad/m]
inline constexpr int yaw = 4;                             ///< the camera is turned so much farther to the left [rad]
inline constexpr int camera = 5;  ///< from here two: it stands so much farther ahead, to the left [m]
inline constexpr int kCount = 7;
}  // namespace considered

/// One number for each of them: an error, or what is unknown of it.
using Considered = Eigen::Matrix<double, considered::kCount, 1>;

}  // namespace azimuth
