#pragma once
#include <string>

namespace azimuth {

/// Whether to use something the robot may have: `automatic` asks the robot.
enum class PioneerFeature { automatic, on, off };

/// How the Pioneer is reached and read. Zero where it says so means: as the robot's kind or its CONFIGpac has it.
struct PioneerSettings {
  std::string device = "/dev/ttyUSB0";  ///< a tty, or "tcp:HOST:PORT" (an IPv4 address or "localhost")
  int baud = 0;                         ///< start baud rate; 0: search. Without meaning over TCP
  int raised_baud = 115200;             ///< rate to change to where the firmware falls back by itself; 0: stay

  std::string subclass;  ///< kind of robot, e.g. "p3dx-sh"; empty: what the robot says

  // Conversions; 0: by subclass.
  double distance_mm_per_unit = 0.0;
  double heading_units_per_turn = 0.0;
  double ticks_per_mm = 0.0;  ///< of one wheel; 0: by CONFIGpac
  double ticks_per_turn =
      0.0;  ///< difference of the wheels' ticks over 360 deg in place, calibrated; 0: heading by SIP

  PioneerFeature encoder = PioneerFeature::automatic;  ///< wheel ticks instead of whole millimetres
  PioneerFeature gyro = PioneerFeature::automatic;     ///< the analog gyro, unless firmware fuses it itself

  /// On a stop the session is left open for the next start, and the controller counts on; else it is ended for others.
  bool keep_session = true;

  double usb_latency_s = 0.001;  ///< from a byte's end on the wire to its arrival here
  double stale_s = 0.5;          ///< without a SIP for so long: state `stale`
  double lost_s = 2.0;           ///< and for so long: the connection is made anew
  double max_speed_m_s = 2.2;    ///< fastest the robot can be; faster steps are not trusted
  double max_turn_rad_s = 6.3;   ///< likewise turning
};

}  // namespace azimuth
