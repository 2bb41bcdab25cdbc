#pragma once
// Internal to drivers/v4l2: format, size and rate.

#include <tl/expected.hpp>

#include "drivers/v4l2/v4l2_format.hpp"
#include "drivers/v4l2/v4l2_handle.hpp"
#include "drivers/v4l2/v4l2_settings.hpp"

namespace azimuth::v4l2 {

/// What camera and settings agree on.
struct Agreement {
  FrameFormat format{};
  double rate_hz = 0.0;  ///< 0: the device does not say
};

/// Sets the first format in order of preference that the device has in exactly the size wanted; those in which it does
/// not reach the rate wanted come last. What it does otherwise than asked goes to `refused`.
tl::expected<Agreement, CameraTrouble> negotiate(const Handle& handle, const Abilities& abilities,
                                                 const V4l2Settings& settings, std::vector<std::string>& refused);

}  // namespace azimuth::v4l2
