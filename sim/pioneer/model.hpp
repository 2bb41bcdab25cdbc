#pragma once
// What one kind of Pioneer controller knows about itself.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace azimuth::sim {

/// How a controller moves its robot. Clients change the present ones, up to those of the robot's kind.
struct MotionLimits {
  int speed_mm_per_s = 0, acceleration_mm_per_s2 = 0, deceleration_mm_per_s2 = 0;
  int turn_rate_deg_per_s = 0, turn_acceleration_deg_per_s2 = 0, turn_deceleration_deg_per_s2 = 0;
  friend bool operator==(const MotionLimits&, const MotionLimits&) = default;
};

/// Constants of a controller: what it tells in SYNC2 and CONFIGpac, and how it measures.
struct PioneerModel {
  std::string name = "Azimuth_sim";
  std::string type = "Pioneer";
  std::string subclass = "p3dx-sh";
  std::string serial_number = "SIM_0001";
  std::string firmware_version = "2.6";

  double mm_per_unit = 1.0;        ///< DistConvFactor: position units to mm
  double velocity_mm_per_s = 1.0;  ///< VelConvFactor: velocity units to mm/s
  int position_bits = 16;          ///< XPOS and YPOS count modulo 2 to this
  double track_mm = 2.0 / 0.0056;  ///< distance between the wheels that DiffConvFactor stands for
  int ticks_per_mm = 128;
  int rev_count = 16570;  ///< as told in CONFIGpac; 1/4 of the difference of the wheels' ticks after half a turn

  int sip_cycle_ms = 100;
  int watchdog_ms = 2000;
  int sonar_cycle_ms = 40;
  int sonars = 16;
  int start_baud = 9600;    ///< at power-up, and after each session if baud_resets
  bool baud_resets = true;  ///< AUTOBAUD 2: the controller falls back to its start baud by itself
  bool has_gyro = false;    ///< an analog gyro, sent on as it is
  double battery_v = 12.8;

  MotionLimits top{1000, 2000, 2000, 360, 300, 300};  ///< no client gets beyond
  MotionLimits usual{1000, 300, 300, 360, 100, 100};  ///< at the beginning of each session
};

/// Counts per turn of THPOS.
inline constexpr int kHeadingCounts = 4096;

/// By subclass; nothing for one that is not simulated.
std::optional<PioneerModel> pioneer_model(std::string_view subclass);

/// The subclasses pioneer_model() knows, separated by commas.
std::string known_subclasses();

}  // namespace azimuth::sim
