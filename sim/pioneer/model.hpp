#pragma once
// The constants of one kind of Pioneer controller.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace azimuth::sim {

/// Limits of the robot's motion. Clients change the current limits, up to those of the model.
struct MotionLimits {
  int speed_mm_per_s = 0, acceleration_mm_per_s2 = 0, deceleration_mm_per_s2 = 0;
  int turn_rate_deg_per_s = 0, turn_acceleration_deg_per_s2 = 0, turn_deceleration_deg_per_s2 = 0;
  friend bool operator==(const MotionLimits&, const MotionLimits&) = default;
};

/// Constants of a controller: those it reports in SYNC2 and CONFIGpac, and those of its measurements.
struct PioneerModel {
  std::string name = "Azimuth_sim";
  std::string type = "Pioneer";
  std::string subclass = "p3dx-sh";
  std::string serial_number = "SIM_0001";
  std::string firmware_version = "2.6";

  double mm_per_unit = 1.0;        ///< DistConvFactor: position units to mm
  double velocity_mm_per_s = 1.0;  ///< VelConvFactor: velocity units to mm/s
  int position_bits = 16;          ///< XPOS and YPOS are modulo 2 to this power
  double track_mm = 2.0 / 0.0056;  ///< Distance between the wheels that corresponds to DiffConvFactor
  int ticks_per_mm = 128;
  /// RevCount of CONFIGpac: a quarter of the difference of the wheels' ticks after half a turn.
  int rev_count = 16570;

  int sip_cycle_ms = 100;
  int watchdog_ms = 2000;
  int sonar_cycle_ms = 40;
  int sonars = 16;
  int start_baud = 9600;    ///< Baud rate at power-up, and after each session if baud_resets is set
  bool baud_resets = true;  ///< AUTOBAUD 2: the controller returns to its start baud rate by itself
  bool has_gyro = false;    ///< An analogue gyro whose samples are sent unchanged
  double battery_v = 12.8;

  MotionLimits top{1000, 2000, 2000, 360, 300, 300};  ///< Largest limits that clients can set
  MotionLimits usual{1000, 300, 300, 360, 100, 100};  ///< Limits at the start of each session
};

/// Counts per turn of THPOS.
inline constexpr int kHeadingCounts = 4096;

/// The model of a subclass; nullopt if it is not simulated.
std::optional<PioneerModel> pioneer_model(std::string_view subclass);

/// The subclasses that pioneer_model() knows, separated by commas.
std::string known_subclasses();

}  // namespace azimuth::sim
