#pragma once
#include <array>
#include <linux/can.h>
#include <sys/socket.h>
#include <vector>

#include "base/unique_fd.hpp"
#include "drivers/can/can_link.hpp"
#include "drivers/can/wall_clock_stamps.hpp"

namespace azimuth {

/// A raw CAN socket that listens to one interface. The kernel filters and stamps the frames, and counts those it drops.
/// The socket never sends.
///
/// Thread contract: thread-bound; allocates only in order to open and to report errors.
class CanSocket final : public CanLink {
 public:
  /// Looks up the interface's index each time, because an adapter that was plugged in again has another index.
  static OpenedCanLink open(const std::string& interface, std::span<const CanId> ids);
  /// Takes any socket whose datagrams are frames.
  CanSocket(std::string interface, UniqueFd fd, int index);

  int descriptor() const override { return fd_.get(); }
  Received receive(std::span<CanReception> into) override;
  bool is_present() const override;
  Counts counts() const override { return {malformed_, dropped_, stamps_.replaced()}; }
  std::string note() const override { return note_; }

 private:
  static constexpr std::size_t kBatch = 32;
  /// The buffers for a datagram and its control data.
  struct Slot {
    alignas(8) std::array<std::uint8_t, kMostCanSocketBytes> datagram;
    alignas(cmsghdr) std::array<std::uint8_t, 128> control;
    iovec place;
  };

  void look_at_clocks();
  void prepare();
  std::optional<CanReception> reception(const mmsghdr& message, const Slot& slot);
  DeviceClock::time_point read_control(const msghdr& header);
  Received trouble(int error_number) const;

  std::string interface_;
  UniqueFd fd_;
  int index_;
  std::string note_;
  WallClockStamps stamps_;
  DeviceClock::time_point now_{};
  std::array<Slot, kBatch> slots_{};
  std::array<mmsghdr, kBatch> messages_{};
  std::uint64_t malformed_ = 0, dropped_ = 0;
  std::uint32_t last_drops_ = 0;
};

/// Filters that pass data frames with exactly these identifiers.
std::vector<can_filter> can_filters(std::span<const CanId> ids);

}  // namespace azimuth
