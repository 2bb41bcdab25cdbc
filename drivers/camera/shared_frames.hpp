#pragma once
// The memory that frames are handed over in: a memfd of fixed size that only the server can write. Internal to
// drivers/camera.

#include <cstddef>
#include <memory>
#include <span>

#include "base/unique_fd.hpp"
#include "drivers/camera/frame.hpp"
#include "drivers/camera/link_messages.hpp"

namespace azimuth::camera_link {

/// The server's side: writable, and sealed so that clients can neither resize the memory nor write to it.
class FrameMemory {
 public:
  FrameMemory() = default;
  FrameMemory(FrameMemory&& other) noexcept
      : fd_(std::move(other.fd_)), bytes_(std::exchange(other.bytes_, std::span<std::byte>{})) {}
  FrameMemory(const FrameMemory&) = delete;
  FrameMemory& operator=(FrameMemory&&) = delete;
  FrameMemory& operator=(const FrameMemory&) = delete;
  ~FrameMemory();

  /// All of it is allocated at once, so that no later write can fail. 0 in `error` on success.
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
  /// Refuses (nullptr and EPROTO in `error`) memory that is not of the size said or that could shrink under a reader.
  static std::shared_ptr<MappedFrames> open(const UniqueFd& memory, const Hello& hello, int& error);
  ~MappedFrames() override;

  /// The first `bytes` of a slot; both in bounds.
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
