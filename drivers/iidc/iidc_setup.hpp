#pragma once
// Internal to drivers/iidc: applies the settings of image, exposure, gain and other features to a camera before it
// starts. Thread contract: reentrant, for different cameras.

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
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

// The state shared by the steps that set up a camera.

/// A number in short form, e.g. "7.5" or "29.97".
inline std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

/// A camera during its setup. The steps return false when it cannot be used; `trouble` then tells why.
struct SetupWork {
  static constexpr double kSameRate = 0.02;

  const OpenCamera& camera;
  const IidcSettings& settings;
  CameraTrouble& trouble;
  ImageSetup setup{};

  dc1394camera_t* handle() const { return camera.get(); }
  bool check(dc1394error_t error, const std::string& what) const {
    if (error == DC1394_SUCCESS) return true;
    trouble = trouble_of(camera, what, error);
    return false;
  }
  bool refuse(const std::string& why, int error_number) const {
    trouble = {"IIDC camera " + camera.guid + ": " + why, error_number};
    return false;
  }
  void tell(std::string sentence) { setup.refused.push_back(std::move(sentence)); }

  /// Reports a difference between the agreed rate and the requested one.
  void compare_rate() {
    if (settings.rate_hz <= 0 || std::abs(setup.rate_hz - settings.rate_hz) <= kSameRate * settings.rate_hz) return;
    tell("rate_hz " + short_number(settings.rate_hz) + ": is " +
         (setup.rate_hz > 0 ? short_number(setup.rate_hz) : std::string("what the camera makes of it")));
  }
};

/// Sets the colour coding, region of interest and rate of a Format 7 mode that is already selected.
bool set_up_region(SetupWork& work, dc1394video_mode_t mode);

}  // namespace azimuth::iidc
