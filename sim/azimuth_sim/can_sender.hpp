#pragma once
#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "base/file_result.hpp"
#include "base/unique_fd.hpp"
#include "drivers/can/can_frame.hpp"

namespace azimuth::sim {

/// Sends frames to a CAN interface. Frames that the interface does not accept are lost, as on a bus. If the interface
/// disappears, the sender tries from time to time to open it again by its name.
///
/// Thread contract: thread-bound; never blocks.
class CanSender {
 public:
  explicit CanSender(std::string interface) : interface_(std::move(interface)) {}

  FileResult<void> open();
  void send(std::span<const CanFrame> frames);
  std::uint64_t lost() const { return lost_; }
  const std::string& interface() const { return interface_; }

 private:
  bool send_one(const CanFrame& frame);

  std::string interface_;
  UniqueFd fd_;
  std::chrono::steady_clock::time_point retry_at_{};
  std::uint64_t lost_ = 0;
};

}  // namespace azimuth::sim
