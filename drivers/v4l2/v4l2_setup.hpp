#pragma once
// Internal to drivers/v4l2: negotiation of format, size and rate; exposure, gain and other controls.

#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "drivers/v4l2/v4l2_format.hpp"
#include "drivers/v4l2/v4l2_handle.hpp"
#include "drivers/v4l2/v4l2_settings.hpp"

namespace azimuth::v4l2 {

/// Sets the requested controls and reads them back. Each difference becomes a sentence in `refused`. A missing control
/// is not reported if it was to be automatic.
void apply_controls(const Handle& handle, const V4l2Settings& settings, std::vector<std::string>& refused);

/// The agreed format and rate.
struct Agreement {
  FrameFormat format{};
  double rate_hz = 0.0;  ///< 0: the device does not report it
};

/// Sets the first format in order of preference that the device has in exactly the requested size. Formats that do not
/// reach the requested rate come last. Each difference from the request becomes a sentence in `refused`.
tl::expected<Agreement, CameraTrouble> negotiate(const Handle& handle, const Abilities& abilities,
                                                 const V4l2Settings& settings, std::vector<std::string>& refused);

}  // namespace azimuth::v4l2
