#pragma once
// A folder for sockets, and helpers for both ends of the camera link.

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <poll.h>
#include <string>

#include "drivers/camera/shared_camera.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth::test {

class CameraLink : public ::testing::Test {
 protected:
  std::filesystem::path path() const { return folder_ / "camera.sock"; }
  const std::filesystem::path& folder() const { return folder_.path(); }

  /// Virtual time, so that no test waits for a back-off.
  SharedCamera::Clock::time_point now() const { return now_; }
  void pass(std::chrono::milliseconds time) { now_ += time; }

  /// Runs both ends twice, client first, so that each processes the other's messages.
  void settle(CameraServer& server, SharedCamera& camera) {
    camera.turn(now_);
    server.turn();
    camera.turn(now_);
    server.turn();
  }

 private:
  TemporaryFolder folder_;
  SharedCamera::Clock::time_point now_{};
};

inline std::size_t open_descriptors() {
  const std::filesystem::directory_iterator listed("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(listed), end(listed)));
}

inline constexpr FrameFormat kSmallGray = packed_format(PixelFormat::gray8, 64, 48);

inline CameraServer serve(const std::filesystem::path& path, const CameraServer::Offer& offer = {kSmallGray, 4, 0}) {
  FileResult<CameraServer> server = CameraServer::listen(path, offer);
  if (!server) throw std::runtime_error(text(server.error()));
  return *std::move(server);
}

/// Fills a slot with a value and sends it; false: no slot was free and the image is skipped.
inline bool send_filled(CameraServer& server, std::uint8_t value, Stamp stamp = {}) {
  const std::span<std::byte> room = server.next_frame();
  if (room.empty()) return false;
  std::ranges::fill(room, std::byte{value});
  return server.send_frame(stamp);
}

inline BearingSet set_of(std::uint64_t sequence, std::size_t bearings) {
  BearingSet set{
      .stamp = stamp_from_us(1000 * static_cast<std::int64_t>(sequence)), .sequence = sequence, .bearings = {}};
  for (std::size_t i = 0; i < bearings; ++i) {
    set.bearings.push_back({.azimuth_rad = 0.001 * static_cast<double>(i) - 1.0, .identity = static_cast<Identity>(i)});
  }
  return set;
}

inline bool readable(int descriptor) {
  pollfd ready{.fd = descriptor, .events = POLLIN, .revents = 0};
  return ::poll(&ready, 1, 0) == 1;
}

}  // namespace azimuth::test
