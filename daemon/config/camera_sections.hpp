#pragma once
// The tables of cameras that belong to the daemon.

#include "base/file_result.hpp"
#include "drivers/camera/camera_driver.hpp"
#include "drivers/v4l2/v4l2_settings.hpp"
#include "settings/section.hpp"

namespace azimuth {

/// What is the same for every kind of camera of the daemon's own.
struct OwnCameraSettings {
  CameraDriverSettings driver;
  double latency_s = 0.0;  ///< from the middle of the exposure to the device's stamp
};

/// [daemon.camera]
Section own_camera_section(OwnCameraSettings& camera);
/// [daemon.v4l2]
Section v4l2_section(V4l2Settings& v4l2);

/// What no single key's range can tell.
FileErrors check(const V4l2Settings& v4l2);

}  // namespace azimuth
