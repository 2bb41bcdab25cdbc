#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "base/unique_fd.hpp"
#include "drivers/device/back_off.hpp"
#include "drivers/lcm/lcm_address.hpp"
#include "drivers/lcm/lcm_sink.hpp"

namespace azimuth {

struct LcmReceiverState {
  bool open = false;
  std::string trouble;                ///< why not; empty when it is
  std::uint64_t datagrams = 0;        ///< received, on all channels
  std::uint64_t malformed = 0;        ///< of them, those that are none of LCM
  std::uint64_t kernel_dropped = 0;   ///< the kernel had no room for: this thread was slow, or rmem_max is small
  std::size_t kernel_room_bytes = 0;  ///< that the kernel granted
};

/// Receives what is sent to an LCM multicast group, for a thread that polls. Whoever may send to the group is believed:
/// for trusted networks only. Anything may be sent; see LcmPacket.
///
/// The group is joined anew when nothing comes for a while: the network interface may have gone, and the membership
/// with it.
///
/// Thread contract: thread-bound. Nothing blocks; allocates only to tell of trouble.
class LcmReceiver {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr int kMaxDatagramsPerTurn = 256;  ///< a flood must not keep the thread from its other work

  /// Samples are dated CLOCK_MONOTONIC plus `epoch_minus_monotonic`. Opens nothing yet.
  LcmReceiver(const LcmAddress& address, Duration epoch_minus_monotonic);

  int descriptor() const { return socket_.get(); }  ///< -1: none at present. May change with every turn
  /// When turn() is wanted without any event.
  Clock::time_point next_turn() const { return next_turn_; }
  void turn(Clock::time_point now, LcmSink& sink);

  const LcmReceiverState& state() const { return state_; }

 private:
  struct Buffer;
  void open(Clock::time_point now);
  bool fail(const char* what, Clock::time_point now);
  bool receive(Clock::time_point now, LcmSink& sink);
  LcmReceipt receipt(Duration wall);
  Stamp now_stamp() const;

  LcmAddress address_;
  Duration epoch_minus_monotonic_;
  UniqueFd socket_;
  std::shared_ptr<Buffer> buffer_;
  Clock::time_point next_turn_{};
  BackOff back_off_;
  LcmWallLead wall_lead_;
  std::uint32_t dropped_before_ = 0;  // as this socket counts
  LcmReceiverState state_;
};

}  // namespace azimuth
