#pragma once
// The tables of cameras that the daemon opens itself.

#include "base/file_result.hpp"
#include "drivers/camera/camera_driver.hpp"
#include "drivers/v4l2/v4l2_settings.hpp"
#include "settings/section.hpp"

namespace azimuth {

/// The settings that are the same for every kind of camera that the daemon opens itself.
struct OwnCameraSettings {
  CameraDriverSettings driver;
  double latency_s = 0.0;  ///< from the middle of the exposure to the device's stamp
};

/// [daemon.camera]
Section own_camera_section(OwnCameraSettings& camera);
/// [daemon.v4l2]
Section v4l2_section(V4l2Settings& v4l2);

/// Errors that the range of a single key cannot find.
FileErrors check(const V4l2Settings& v4l2);

}  // namespace azimuth
