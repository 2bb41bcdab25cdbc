#pragma once
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "daemon/config/device_sections.hpp"
#include "daemon/keep/map_settings.hpp"
#include "daemon/pipeline/thread_settings.hpp"
#include "daemon/publish/publish_settings.hpp"
#include "daemon/record/record_settings.hpp"
#include "drivers/can/can_settings.hpp"
#include "drivers/fifo/fifo_odometer.hpp"
#include "drivers/lcm/lcm_settings.hpp"
#include "drivers/pioneer/pioneer_settings.hpp"
#include "settings/section.hpp"

namespace azimuth {

enum class LogLevel { debug, info, warning, error };

/// The source that plays a recording.
struct PlaySettings {
  std::string run;     ///< run folder or LCM log; empty: none configured
  double speed = 1.0;  ///< multiple of the recording's own pace; 0: as fast as possible
  bool hold = false;   ///< keep running after the end of the recording
};

enum class OdometerKind { none, pioneer, can, lcm, fifo };
enum class CameraKind { none, shared, v4l2, iidc, lcm };

/// How USB hotplug and USB resets are used for cameras and serial adapters.
struct UsbSettings {
  bool hotplug = true;  ///< wake sources when a device is plugged in, instead of at their next attempt
  bool reset = true;    ///< reset the port of a hanging device, at most once a minute
  /// A serial adapter that is silent for this long counts as hanging. Cameras have a setting of their own.
  double reset_after_s = 10.0;
};

/// The robot's own sensors. Used when no recording is played.
struct LiveSettings {
  OdometerKind odometer = OdometerKind::none;
  CameraKind camera = CameraKind::none;
  std::string camera_socket = "/run/azimuth/camera.sock";  ///< socket of a shared camera
  /// A shared camera that sends nothing for this long is reported as silent.
  double camera_silent_s = 1.0;
  OwnCameraSettings own_camera;  ///< not used for a shared camera
  V4l2Settings v4l2;
  IidcSettings iidc;
  PioneerSettings pioneer;
  UsbSettings usb;
  CanSettings can;
  LcmSourceSettings lcm;
  FifoSettings fifo;
};

/// The daemon's own settings: the tables under [daemon].
struct DaemonSettings {
  std::string rig;  ///< path of rig.toml; empty: the recording's own rig
  LiveSettings live;
  PlaySettings play;
  RecordSettings record;
  MapSettings map;
  PublishSettings publish;
  PictureSettings picture;
  ThreadSettings threads;
  bool lock_memory = false;  ///< keep all pages of the process in memory
  LogLevel log_level = LogLevel::info;
};

/// The tables of azimuth.toml under [daemon], bound to `settings`, which must outlive them.
std::vector<Section> daemon_sections(DaemonSettings& settings);

/// Errors that the range of a single key cannot find, such as an unknown LCM provider or a prefix that makes channel
/// names too long.
FileErrors check(const DaemonSettings& settings);

}  // namespace azimuth
