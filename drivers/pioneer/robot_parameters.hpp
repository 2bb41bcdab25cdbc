#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "drivers/pioneer/pioneer_settings.hpp"

namespace azimuth::pioneer {

/// The units of one kind of robot.
struct RobotParameters {
  double distance_m_per_unit = 0.001;  ///< for x and y in the standard SIP
  double velocity_m_s_per_unit = 0.001;
  double heading_units_per_turn = 4096.0;
  double gyro_scale = 1.626;  ///< for the analog gyro
  friend bool operator==(const RobotParameters&, const RobotParameters&) = default;
};

/// Parameters of a subclass as the robot reports it in its answer to SYNC2, e.g. "p3dx-sh" (case does not matter). All
/// "-sh" controllers count in millimetres (including "p3at-sh-lms500"). None for an unknown subclass: a guess would
/// silently scale the odometry wrongly.
std::optional<RobotParameters> find_robot_parameters(std::string_view subclass);

/// The parameters of a robot with this subclass, unless the settings override them. An unknown kind is accepted when
/// the settings name a known one, or give its distance conversion.
std::optional<RobotParameters> robot_parameters(const PioneerSettings& settings, std::string_view subclass);

/// The subclasses with their own entry, for error messages.
std::string known_subclasses();

}  // namespace azimuth::pioneer
