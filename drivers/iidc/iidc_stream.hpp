#pragma once
#include "drivers/camera/image_stream.hpp"
#include "drivers/iidc/iidc_settings.hpp"

namespace azimuth {

/// Opens an IIDC camera, on FireWire or USB, sets it up and starts it; blocks for some tenths of a second, and for
/// seconds if the camera is there but does not answer. For CameraDriver.
///
/// - Frames are leases on buffers of our own, into which images are copied when they are taken off libdc1394's ring:
///   stopping libdc1394 frees the ring, and must not wait for whoever still looks at a frame, because it also gives
///   back the bandwidth or the USB interface that opening the camera anew needs; besides, the ring takes its frames
///   back only in the order in which it gave them. An image that comes while every buffer is leased is lost and shows
///   as a gap.
/// - Stamps are the time at which the transfer of the frame was complete (on FireWire, when it began), by libdc1394's
///   wall-clock stamp and the clocks at the time of reading (StampClock in iidc_stamps.hpp).
/// - Sequence numbers count the frames that the camera must have sent, by their stamps (FrameCounter there), since
///   libdc1394 hands on no number.
/// - A bus reset ends the stream: its channel may be another one's now. So does whatever libdc1394 reports when a frame
///   is taken off or given back.
///
/// The stream, if there is one, is thread-bound as every ImageStream; libdc1394 runs a thread of its own behind a
/// camera on USB.
OpenedStream open_iidc(const IidcSettings& settings);

}  // namespace azimuth
