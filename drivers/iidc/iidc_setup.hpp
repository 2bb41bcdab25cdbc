#pragma once
// Internal to drivers/iidc: applies the settings of image, exposure, gain and other features to a camera before it
// starts. Thread contract: reentrant, for different cameras.

#include <optional>
#include <string>
#include <vector>

#include "drivers/iidc/iidc_camera.hpp"
#include "slam/sample/image.hpp"

namespace azimuth::iidc {

/// Sets every feature that the settings name, and reads it back. Each difference becomes a sentence in `refused`; it
/// never makes the camera unusable. Thread contract: reentrant, for different cameras.
void set_features(const OpenCamera& camera, const IidcSettings& settings, std::vector<std::string>& refused);

/// The result of applying the settings.
struct ImageSetup {
  FrameFormat format{};
  double rate_hz = 0.0;              ///< 0: unknown
  std::vector<std::string> refused;  ///< settings that were refused, one sentence each
};

/// Sets the mode, region of interest, rate and bus speed. Stops a transmission that an earlier program left running.
/// None: it is not possible, and `trouble` tells why.
std::optional<ImageSetup> set_up_image(const OpenCamera& camera, const IidcSettings& settings, CameraTrouble& trouble);

/// The limits of a Format 7 mode along one axis, in pixels. A unit of 0 counts as 1.
struct AxisLimits {
  std::uint32_t largest = 0;
  std::uint32_t size_unit = 1;
  std::uint32_t place_unit = 1;
};
/// A place and a size along one axis. Both are multiples of their units, and their sum is at most `largest`.
struct AxisChoice {
  std::uint32_t place = 0;
  std::uint32_t size = 0;
};
/// Rounds the requested values down to possible ones. Size 0: as large as the place allows.
AxisChoice choose_axis(int size_px, int place_px, const AxisLimits& limits);

/// Bytes of a packet for `rate_hz` images of `image_bytes` per second, at 8000 packets per second. The result is a
/// multiple of `unit_bytes`, at most `max_bytes`.
std::uint32_t packet_bytes_for(double rate_hz, std::uint64_t image_bytes, std::uint32_t unit_bytes,
                               std::uint32_t max_bytes);

}  // namespace azimuth::iidc
