#pragma once
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "daemon/config/camera_sections.hpp"
#include "daemon/config/iidc_section.hpp"
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
  double speed = 1.0;  ///< times the recording's own pace; 0: as fast as possible
  bool hold = false;   ///< keep running when the recording has ended
};

enum class OdometerKind { none, pioneer, can, lcm, fifo };
enum class CameraKind { none, shared, v4l2, iidc, lcm };

/// What USB may do for cameras and serial adapters.
struct UsbSettings {
  bool hotplug = true;          ///< wake sources when something is plugged in, instead of at their next try
  bool reset = true;            ///< reset the port of a device that hangs, at most once a minute
  double reset_after_s = 10.0;  ///< silence of a serial adapter that counts as hanging; cameras have their own
};

/// The robot's own sensors, used when nothing is played.
struct LiveSettings {
  OdometerKind odometer = OdometerKind::none;
  CameraKind camera = CameraKind::none;
  std::string camera_socket = "/run/azimuth/camera.sock";  ///< of a shared camera
  double camera_silent_s = 1.0;                            ///< one that sends nothing for so long is in trouble
  OwnCameraSettings own_camera;                            ///< not for a shared one
  V4l2Settings v4l2;
  IidcSettings iidc;
  PioneerSettings pioneer;
  UsbSettings usb;
  CanSettings can;
  LcmSourceSettings lcm;
  FifoSettings fifo;
};

/// What the daemon is told beside the estimator's configuration: the tables under [daemon].
struct DaemonSettings {
  std::string rig;  ///< rig.toml; empty: the recording's own
  LiveSettings live;
  PlaySettings play;
  RecordSettings record;
  MapSettings map;
  PublishSettings publish;
  PictureSettings picture;
  ThreadSettings threads;
  bool lock_memory = false;  ///< no page of the process is ever swapped out
  LogLevel log_level = LogLevel::info;
};

/// The tables of azimuth.toml under [daemon], bound to `settings`, which must outlive them.
std::vector<Section> daemon_sections(DaemonSettings& settings);

/// What no single key's range can tell: an LCM provider that does not exist, a prefix that makes channels too long.
FileErrors check(const DaemonSettings& settings);

}  // namespace azimuth
