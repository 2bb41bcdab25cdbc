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
  std::string trouble;          ///< why the socket is not open; empty: it is open
  std::uint64_t datagrams = 0;  ///< datagrams received on all channels
  std::uint64_t malformed = 0;  ///< of these, the ones that are not LCM datagrams
  /// Datagrams dropped by the kernel for lack of room: this thread was slow, or rmem_max is small.
  std::uint64_t kernel_dropped = 0;
  std::size_t kernel_room_bytes = 0;  ///< buffer size granted by the kernel
};

/// Receives the datagrams of an LCM multicast group, for a thread that polls. Every sender to the group is trusted, so
/// use it only on trusted networks; invalid datagrams are safe nevertheless (see LcmPacket).
///
/// The group is joined again when nothing arrives for a while, because the network interface may have disappeared, and
/// the membership with it.
///
/// Thread contract: thread-bound. Nothing blocks; allocates only to report trouble.
class LcmReceiver {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr int kMaxDatagramsPerTurn = 256;  ///< so that a flood does not keep the thread from its other work

  /// Stamps on arrival are CLOCK_MONOTONIC plus `epoch_minus_monotonic`. Does not open the socket yet.
  LcmReceiver(const LcmAddress& address, Duration epoch_minus_monotonic);

  int descriptor() const { return socket_.get(); }  ///< to be polled; -1: none. It may change with every turn.
  /// When turn() is needed without any event.
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
  std::uint32_t dropped_before_ = 0;  // dropped datagrams counted by this socket so far
  LcmReceiverState state_;
};

}  // namespace azimuth
