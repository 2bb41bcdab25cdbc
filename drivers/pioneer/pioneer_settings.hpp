#pragma once
#include <string>

namespace azimuth {

/// Whether to use an optional feature of the robot; `automatic` asks the robot.
enum class PioneerFeature { automatic, on, off };

/// The connection to the Pioneer and its parameters. Where a comment says so, zero means: the value of the robot's
/// kind, or of its CONFIGpac.
struct PioneerSettings {
  std::string device = "/dev/ttyUSB0";  ///< a tty, or "tcp:HOST:PORT" (an IPv4 address or "localhost")
  int baud = 0;                         ///< start baud rate; 0: search. Not used over TCP
  /// Rate to change to if the firmware returns from it by itself; 0: no change.
  int raised_baud = 115200;

  std::string subclass;  ///< kind of robot, e.g. "p3dx-sh"; empty: as the robot reports

  // Conversions; 0: by subclass.
  double distance_mm_per_unit = 0.0;
  double heading_units_per_turn = 0.0;
  double ticks_per_mm = 0.0;  ///< resolution of one wheel; 0: from CONFIGpac
  /// Calibrated difference of the wheels' ticks over a turn of 360 deg in place; 0: the heading is that of the SIP.
  double ticks_per_turn = 0.0;

  PioneerFeature encoder = PioneerFeature::automatic;  ///< use wheel ticks instead of whole millimetres
  PioneerFeature gyro = PioneerFeature::automatic;     ///< use the analog gyro, unless the firmware uses it itself

  /// True: a stop leaves the session open for the next start, and the controller continues to count. False: a stop ends
  /// the session, for other programs.
  bool keep_session = true;

  double usb_latency_s = 0.001;  ///< from the end of a byte on the wire to its arrival in this process
  double stale_s = 0.5;          ///< without a SIP for this long the connection counts as silent
  double lost_s = 2.0;           ///< without a SIP for this long the connection is made again
  double max_speed_m_s = 2.2;    ///< largest speed of the robot; faster steps are not trusted
  double max_turn_rad_s = 6.3;   ///< largest turn rate of the robot; faster turns are not trusted
};

}  // namespace azimuth
