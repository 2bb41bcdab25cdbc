#pragma once
// A camera in virtual time, whose streams follow a script.

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "drivers/camera/image_stream.hpp"

namespace azimuth::test {

/// One result of read().
struct FakeImage {
  ImageStream::Read read = ImageStream::Read::image;
  std::uint64_t sequence = 0;
  Stamp stamp{};
};

/// The device behind the streams, of which at most one is open. If opening runs on another thread than reading, access
/// to everything except `images` requires the mutex.
struct FakeCameraDevice {
  std::mutex mutex;
  StreamDescription description{.device = "/dev/omnicam",
                                .name = "Omni",
                                .format = packed_format(PixelFormat::gray8, 4, 3),
                                .rate_hz = 10.0,
                                .usb_port = "1-2",
                                .refused = {}};
  CameraTrouble opening{};     // returned instead of a stream if it has a text
  bool still_opening = false;  // opening is still in progress
  CameraTrouble failure{"/dev/omnicam: VIDIOC_DQBUF: Input/output error", 5};
  std::deque<FakeImage> images;
  int opened = 0, open_now = 0;

  StreamOpener opener();
};

class FakeStream final : public ImageStream {
 public:
  static constexpr int kDescriptor = -2;  // poll(2) ignores it

  explicit FakeStream(FakeCameraDevice& device) : device_(device), description_(device.description) {
    ++device_.opened;
    ++device_.open_now;
  }
  ~FakeStream() override {
    const std::lock_guard lock(device_.mutex);
    --device_.open_now;
  }

  int descriptor() const override { return kDescriptor; }
  short poll_events() const override { return 1; }
  Read read(Frame& into) override {
    into = Frame{};
    if (device_.images.empty()) return Read::nothing;
    const FakeImage image = device_.images.front();
    device_.images.pop_front();
    if (image.read != Read::image) return image.read;
    into = Frame(nullptr, 0, description_.format, kPixels);
    into.sequence = image.sequence;
    into.stamp = image.stamp;
    return Read::image;
  }
  const CameraTrouble& trouble() const override { return device_.failure; }
  const StreamDescription& description() const override { return description_; }

 private:
  static inline const std::vector<std::byte> kPixels = std::vector<std::byte>(12);
  FakeCameraDevice& device_;
  StreamDescription description_;
};

inline StreamOpener FakeCameraDevice::opener() {
  return [this]() -> OpenedStream {
    const std::lock_guard lock(mutex);
    if (still_opening) return {};
    if (!opening.text.empty()) return tl::unexpected(opening);
    return std::make_unique<FakeStream>(*this);
  };
}

}  // namespace azimuth::test
