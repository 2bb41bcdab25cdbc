#pragma once
#include <Eigen/Core>

namespace azimuth {

// Constants of the rig that a filter considers instead of estimating: true value minus the rig's value.
namespace considered {
inline constexpr int scale_distance = 0, scale_turn = 1;  ///< Relative errors of the odometer's scales
inline constexpr int lag = 2;                             ///< Images are taken this much earlier than stamped [s]
inline constexpr int drift = 3;                           ///< Heading gained per metre driven [rad/m]
inline constexpr int yaw = 4;                             ///< The camera is turned this much farther to the left [rad]
inline constexpr int camera = 5;  ///< Two entries: the camera is this much farther ahead, and to the left [m]
inline constexpr int kCount = 7;
}  // namespace considered

/// One number for each constant: its error, variance or standard deviation.
using Considered = Eigen::Matrix<double, considered::kCount, 1>;

}  // namespace azimuth
