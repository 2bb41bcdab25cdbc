#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "drivers/camera/frame.hpp"
#include "drivers/camera/jpeg.hpp"
#include "drivers/camera/shared_camera.hpp"
#include "tests/equipment/usb_camera/wire_image.hpp"

namespace azimuth::sim {

/// A source of images.
///
/// Thread contract: thread-bound.
class ImageFeed {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~ImageFeed() = default;
  /// Readable if turn() has work; -1: images are made on demand, paced by a clock.
  virtual int descriptor() const { return -1; }
  virtual Clock::time_point next_turn() const { return Clock::time_point::max(); }
  /// Returns true if an image has arrived, which fill() then gives.
  virtual bool turn(Clock::time_point) { return false; }
  /// Writes image `number` in `shape`; returns false if there is none.
  virtual bool fill(const WireShape& shape, std::uint32_t number, Octets& into) = 0;
  /// For the bench's status: " name=value", or an empty string.
  virtual std::string status() const { return {}; }
};

/// Test images. As JPEG they are grey and carry their number in a comment, which is all that can be checked.
class PatternFeed : public ImageFeed {
 public:
  bool fill(const WireShape& shape, std::uint32_t number, Octets& into) override;

 private:
  Octets grey_;
  JpegEncoder encoder_;
};

/// A file of raw images in the requested layout, repeated without end.
class FileFeed : public ImageFeed {
 public:
  /// Throws std::system_error if the file cannot be opened.
  explicit FileFeed(const std::filesystem::path& file);
  bool fill(const WireShape& shape, std::uint32_t number, Octets& into) override;

 private:
  std::ifstream file_;
};

/// Live images of another process (azimuth-sim's camera), as they arrive. A real camera stamps an image at its exposure
/// and is not delayed by its host, so an image that arrives too late because the machine was busy is dropped.
class LinkFeed : public ImageFeed {
 public:
  explicit LinkFeed(std::filesystem::path socket) : camera_(std::move(socket)) {}
  int descriptor() const override { return camera_.descriptor(); }
  Clock::time_point next_turn() const override { return camera_.next_turn(); }
  bool turn(Clock::time_point now) override;
  bool fill(const WireShape& shape, std::uint32_t number, Octets& into) override;
  std::string status() const override;

 private:
  SharedCamera camera_;
  Frame newest_;
  JpegEncoder encoder_;
  Clock::duration oldest_{};
  std::uint64_t stale_ = 0;
  bool connected_ = false, complained_ = false;
};

}  // namespace azimuth::sim
