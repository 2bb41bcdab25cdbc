#pragma once
// One open camera that belongs to this process, whatever its kind. CameraDriver (camera_driver.hpp) opens it, and opens
// it anew when it fails.

#include <functional>
#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "drivers/camera/frame.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Why a camera cannot be opened, or is of no more use.
struct CameraTrouble {
  std::string text;      ///< device, what failed and why: "/dev/omnicam: VIDIOC_DQBUF: No such device"
  int error_number = 0;  ///< errno; 0: none fits
};

/// What a camera turned out to be, once it is open.
struct StreamDescription {
  std::string device;                ///< what was opened: a node, a GUID
  std::string name;                  ///< as the camera calls itself
  FrameFormat format{};              ///< of every frame
  double rate_hz = 0.0;              ///< frames per second that were agreed; 0: unknown
  std::string usb_port;              ///< where it is plugged in, as sysfs names it ("1-2.3"); empty: not by USB
  std::vector<std::string> refused;  ///< settings asked for and not had, one sentence each, for the log
};

/// A camera that is streaming.
///
/// Frames are leases on the driver's own buffers, stamped on CLOCK_MONOTONIC with the kernel's time of the image and
/// numbered with the device's own sequence number. Frames given back are handed to the device again by read().
///
/// Thread contract: thread-bound; frames may die elsewhere and later than the stream. Nothing blocks but destruction,
/// and nothing allocates per frame.
class ImageStream {
 public:
  enum class Read {
    image,    ///< `into` holds the oldest unread image
    corrupt,  ///< one was taken off and dropped: damaged, or cut short. It takes up a sequence number as well
    nothing,  ///< none is there
    failed    ///< the stream is of no more use; trouble() says why
  };

  virtual ~ImageStream() = default;

  /// For poll(2) together with poll_events(); the same for the life of the stream.
  virtual int descriptor() const = 0;
  virtual short poll_events() const = 0;

  /// Takes one image off. What `into` held is given back first.
  virtual Read read(Frame& into) = 0;
  virtual const CameraTrouble& trouble() const = 0;

  virtual const StreamDescription& description() const = 0;
};

/// A stream, or why there is none. Null: it is still being opened, ask again.
using OpenedStream = tl::expected<std::unique_ptr<ImageStream>, CameraTrouble>;

/// Finds the camera by its stable name, opens it, sets it up and starts it; blocks for as long as the device takes.
using StreamOpener = std::function<OpenedStream()>;

}  // namespace azimuth
