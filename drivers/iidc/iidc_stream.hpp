#pragma once
#include "drivers/camera/image_stream.hpp"
#include "drivers/iidc/iidc_settings.hpp"

namespace azimuth {

/// Opens an IIDC camera on FireWire or USB, configures and starts it. Blocks for some tenths of a second, and for
/// seconds if the camera is present but does not answer. For CameraDriver.
///
/// - Frames are leases on the driver's own buffers. Images are copied into them when they are taken off libdc1394's
///   ring, for two reasons. Stopping libdc1394 frees the ring and must not wait for holders of frames, because it also
///   returns the bandwidth or the USB interface that reopening needs. And the ring takes its frames back only in the
///   order in which it gave them. An image that arrives while every buffer is leased is lost and shows as a gap.
/// - Stamps are the time at which the transfer of the frame was complete (on FireWire, when it began). They are
///   computed from libdc1394's wall-clock stamp and the clocks at the time of reading (StampClock in iidc_stamps.hpp).
/// - Sequence numbers count the frames that the camera must have sent according to their stamps (FrameCounter in
///   iidc_stamps.hpp), because libdc1394 delivers no number.
/// - A bus reset ends the stream, because the camera's channel may have changed. Any error that libdc1394 reports when
///   a frame is taken off or given back ends it as well.
///
/// The stream is thread-bound like every ImageStream; for a camera on USB, libdc1394 runs a thread of its own.
OpenedStream open_iidc(const IidcSettings& settings);

}  // namespace azimuth
