#pragma once
// An open camera of this process, of any kind. CameraDriver (camera_driver.hpp) opens it, and reopens it when it fails.

#include <functional>
#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "drivers/camera/frame.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Why a camera cannot be opened or used any longer.
struct CameraTrouble {
  std::string text;      ///< device, failed operation and cause: "/dev/omnicam: VIDIOC_DQBUF: No such device"
  int error_number = 0;  ///< errno; 0: none applies
};

/// The properties of an open camera.
struct StreamDescription {
  std::string device;                ///< the opened device: a node or a GUID
  std::string name;                  ///< the camera's own name
  FrameFormat format{};              ///< the format of every frame
  double rate_hz = 0.0;              ///< agreed frame rate; 0: unknown
  std::string usb_port;              ///< USB port as named by sysfs ("1-2.3"); empty: not on USB
  std::vector<std::string> refused;  ///< requested settings that were refused, one sentence each, for the log
};

/// A camera that is streaming.
///
/// Frames are leases on the driver's own buffers, with the kernel's time of the image on CLOCK_MONOTONIC and the
/// device's own sequence number. read() hands returned buffers to the device again.
///
/// Thread contract: thread-bound; frames may be destroyed on any thread, and later than the stream. Only destruction
/// blocks, and nothing allocates per frame.
class ImageStream {
 public:
  enum class Read {
    image,  ///< `into` holds the oldest unread image
    /// A damaged or truncated image was dropped. The damaged image consumes a sequence number.
    corrupt,
    nothing,  ///< there is no image
    failed    ///< the stream can no longer be used; trouble() tells why
  };

  virtual ~ImageStream() = default;

  /// The descriptor for poll(2), together with poll_events(). It stays the same for the life of the stream.
  virtual int descriptor() const = 0;
  virtual short poll_events() const = 0;

  /// Takes one image. The buffer of the previous image in `into` is returned to the driver first.
  virtual Read read(Frame& into) = 0;
  virtual const CameraTrouble& trouble() const = 0;

  virtual const StreamDescription& description() const = 0;
};

/// A stream, or why there is none. Null: the camera is still being opened; ask again.
using OpenedStream = tl::expected<std::unique_ptr<ImageStream>, CameraTrouble>;

/// Finds the camera by its stable name, opens, configures and starts it. Blocks for as long as the device takes.
using StreamOpener = std::function<OpenedStream()>;

}  // namespace azimuth
