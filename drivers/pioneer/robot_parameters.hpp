#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "drivers/pioneer/pioneer_settings.hpp"

namespace azimuth::pioneer {

/// How one kind of robot counts.
struct RobotParameters {
  double distance_m_per_unit = 0.001;  ///< of x and y in the standard SIP
  double velocity_m_s_per_unit = 0.001;
  double heading_units_per_turn = 4096.0;
  double gyro_scale = 1.626;  ///< of the analog gyro
  friend bool operator==(const RobotParameters&, const RobotParameters&) = default;
};

/// Parameters of a subclass as the robot names it in its answer to SYNC2 (case does not matter), e.g. "p3dx-sh". All
/// "-sh" controllers count in millimetres ("p3at-sh-lms500" too). Nothing for a subclass that is not known: guessing
/// would scale the odometry wrongly and silently.
std::optional<RobotParameters> find_robot_parameters(std::string_view subclass);

/// The same for a robot that calls itself `subclass`, as far as the settings do not say otherwise. An unknown kind is
/// accepted when the settings name a known one, or its distance conversion.
std::optional<RobotParameters> robot_parameters(const PioneerSettings& settings, std::string_view subclass);

/// The subclasses with an entry of their own, for error messages.
std::string known_subclasses();

}  // namespace azimuth::pioneer
