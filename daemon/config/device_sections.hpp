#pragma once
// The tables of the devices that the daemon opens itself, and of samples over LCM.

#include <vector>

#include "base/file_result.hpp"
#include "daemon/publish/publish_settings.hpp"
#include "drivers/camera/camera_driver.hpp"
#include "drivers/can/can_settings.hpp"
#include "drivers/iidc/iidc_settings.hpp"
#include "drivers/lcm/lcm_settings.hpp"
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

/// [daemon.iidc]
Section iidc_section(IidcSettings& iidc);

/// Errors in texts that are not valid for any camera.
FileErrors check(const IidcSettings& iidc);

/// The tables of a robot base on a CAN bus, bound to `can`, which must outlive them.
std::vector<Section> can_sections(CanSettings& can);

/// The table [daemon.lcm_source].
Section lcm_source_section(LcmSourceSettings& source);

/// Errors: an address that cannot be listened to, invalid channel names, and channels on which the daemon itself sends.
FileErrors check(const LcmSourceSettings& source, const PublishSettings& publish);

}  // namespace azimuth
