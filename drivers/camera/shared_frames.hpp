#pragma once
// The shared memory for frames: a memfd of fixed size that only the server can write to. Internal to drivers/camera.

#include <cstddef>
#include <memory>
#include <span>

#include "base/unique_fd.hpp"
#include "drivers/camera/frame.hpp"
#include "drivers/camera/link_messages.hpp"

namespace azimuth::camera_link {

/// The server's side: writable, and sealed so that clients can neither resize nor write to the memory.
class FrameMemory {
 public:
  FrameMemory() = default;
  FrameMemory(FrameMemory&& other) noexcept
      : fd_(std::move(other.fd_)), bytes_(std::exchange(other.bytes_, std::span<std::byte>{})) {}
  FrameMemory(const FrameMemory&) = delete;
  FrameMemory& operator=(FrameMemory&&) = delete;
  FrameMemory& operator=(const FrameMemory&) = delete;
  ~FrameMemory();

  /// All memory is allocated at once, so that no later write can fail. `error` is 0 on success.
  static FrameMemory create(std::size_t bytes, int& error);

  int descriptor() const { return fd_.get(); }
  std::span<std::byte> bytes() const { return bytes_; }

 private:
  UniqueFd fd_;
  std::span<std::byte> bytes_;
};

/// The client's side: a read-only view that leases keep alive.
class MappedFrames : public FramePool {
 public:
  /// Refuses memory of another size than announced, or that could shrink during reading: nullptr, with EPROTO in
  /// `error`.
  static std::shared_ptr<MappedFrames> open(const UniqueFd& memory, const Hello& hello, int& error);
  ~MappedFrames() override;

  /// The first `bytes` bytes of a slot. Both arguments must be in bounds.
  std::span<const std::byte> slot(std::uint32_t index, std::uint32_t bytes) const {
    return bytes_.subspan(std::size_t{index} * slot_bytes_, bytes);
  }

  MappedFrames(UniqueFd bell, std::span<const std::byte> bytes, std::size_t slot_bytes)
      : FramePool(std::move(bell)), bytes_(bytes), slot_bytes_(slot_bytes) {}

 private:
  std::span<const std::byte> bytes_;
  std::size_t slot_bytes_;
};

}  // namespace azimuth::camera_link
