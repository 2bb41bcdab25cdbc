#pragma once
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "drivers/camera/image_stream.hpp"

namespace azimuth {

/// Opens and closes a camera's streams on a thread of its own: a device that hangs lets either wait for seconds, which
/// its source's thread, whose heart beats for the watchdog, cannot afford.
///
/// Streams come wrapped: destroying one hands it to that thread. It closes what it was given before it opens anything,
/// so a camera is never open twice.
///
/// Thread contract: open() and the streams belong to one thread. Destruction waits for the device.
class BackgroundOpener {
 public:
  explicit BackgroundOpener(StreamOpener open);
  BackgroundOpener(const BackgroundOpener&) = delete;
  BackgroundOpener& operator=(const BackgroundOpener&) = delete;
  ~BackgroundOpener();

  /// As CameraDriver expects it: begins an opening, and gives what became of it when that is known. Does not block.
  OpenedStream open();

  /// What the two threads share. Lives as long as any stream.
  struct Desk {
    std::mutex mutex;
    std::condition_variable work;
    bool opening = false;  ///< asked for, and not fetched yet
    bool begun = false;    ///< the thread is at it, or done
    bool quit = false;
    std::optional<OpenedStream> opened;
    std::vector<std::unique_ptr<ImageStream>> to_close;
  };

 private:
  void run();

  StreamOpener open_;
  std::shared_ptr<Desk> desk_ = std::make_shared<Desk>();
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace azimuth
