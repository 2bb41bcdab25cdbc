#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "drivers/camera/frame.hpp"
#include "drivers/camera/jpeg.hpp"
#include "drivers/camera/shared_camera.hpp"
#include "sim/usb_camera/wire_image.hpp"

namespace azimuth::sim {

/// Where images come from.
///
/// Thread contract: thread-bound.
class ImageFeed {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~ImageFeed() = default;
  /// Readable when turn() has something to do; -1: images are made on demand, whenever a clock says so.
  virtual int descriptor() const { return -1; }
  virtual Clock::time_point next_turn() const { return Clock::time_point::max(); }
  /// True: an image has arrived that fill() will give.
  virtual bool turn(Clock::time_point) { return false; }
  /// Image `number` in `shape`. False: there is none.
  virtual bool fill(const WireShape& shape, std::uint32_t number, Octets& into) = 0;
  /// For the bench's status: " name=value", or nothing.
  virtual std::string status() const { return {}; }
};

/// Test images; as JPEG they are grey, carry their number in a comment, and only that can be checked.
class PatternFeed : public ImageFeed {
 public:
  bool fill(const WireShape& shape, std::uint32_t number, Octets& into) override;

 private:
  Octets grey_;
  JpegEncoder encoder_;
};

/// A file of raw images in the layout asked for, over and over.
class FileFeed : public ImageFeed {
 public:
  /// Throws std::system_error when the file cannot be opened.
  explicit FileFeed(const std::filesystem::path& file);
  bool fill(const WireShape& shape, std::uint32_t number, Octets& into) override;

 private:
  std::ifstream file_;
};

/// Live images of another process, as they arrive: azimuth-sim's camera. A real camera stamps an image when it is
/// exposed and is never kept from it; one that arrives too late, because the machine was busy, is therefore lost.
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
