#pragma once
// The state shared by the steps that set up a camera. Internal to drivers/iidc.

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "drivers/iidc/iidc_camera.hpp"
#include "drivers/iidc/iidc_setup.hpp"

namespace azimuth::iidc {

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
