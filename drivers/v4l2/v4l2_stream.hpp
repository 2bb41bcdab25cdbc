#pragma once
#include <memory>

#include "drivers/camera/image_stream.hpp"
#include "drivers/v4l2/v4l2_calls.hpp"
#include "drivers/v4l2/v4l2_settings.hpp"

namespace azimuth {

/// Opens a camera of the kernel's video interface, negotiates a format, configures and starts it.
///
/// Its images are leases on the driver's mapped buffers, which stay mapped as long as a lease lives, even after the end
/// of the stream or the device. Stamps are the kernel's own. When a driver stamps by another clock than
/// CLOCK_MONOTONIC, the time of dequeueing is used instead, and the description says so. Sequence numbers are the
/// driver's, unwrapped.
///
/// `calls` must outlive the stream and its frames.
OpenedStream open_v4l2(const V4l2Settings& settings, v4l2::Calls& calls = v4l2::kernel_calls());

}  // namespace azimuth
