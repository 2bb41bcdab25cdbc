#pragma once
#include <array>
#include <chrono>
#include <linux/can.h>
#include <sys/socket.h>
#include <vector>

#include "base/unique_fd.hpp"
#include "drivers/can/can_link.hpp"
#include "drivers/device/device_clock.hpp"

namespace azimuth {

/// Converts the kernel's receive stamps, which are on the wall clock, to CLOCK_MONOTONIC.
///
/// The wall clock may be set between the arrival of a frame and its reading. The stamp is then wrong by that step, so
/// the difference of the two clocks before the step is tried as well. A stamp that fits neither is replaced by the
/// current time.
///
/// Thread contract: thread-bound; never allocates.
class WallClockStamps {
 public:
  using Wall = std::chrono::nanoseconds;  ///< since the Unix epoch

  /// Takes both clocks, read together, before frames are read.
  void look(Wall wall_now, DeviceClock::time_point now);
  /// To be called when all frames that arrived before `now` have been read, so that later frames are younger.
  void note_empty(DeviceClock::time_point now) { empty_at_ = now; }

  /// The time of arrival of a frame, by the clocks of the last look(). Never later than that look.
  DeviceClock::time_point monotonic(Wall stamp);
  std::uint64_t replaced() const { return replaced_; }  ///< implausible stamps

 private:
  bool can_be(DeviceClock::time_point at) const;

  DeviceClock::time_point now_{}, empty_at_{};
  std::chrono::nanoseconds monotonic_minus_wall_{}, before_{};
  std::uint64_t replaced_ = 0;
};

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
