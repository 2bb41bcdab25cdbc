#pragma once
#include <cstdint>

#include "drivers/lcm/lcm_packet.hpp"
#include "drivers/lcm/lcm_stamps.hpp"

namespace azimuth {

/// Address and port of a sender. Each sending process has its own.
using LcmPeer = std::uint64_t;

/// A receiver of all valid datagrams that are sent to the group, on any channel.
///
/// Thread contract: thread-bound.
class LcmSink {
 public:
  virtual ~LcmSink() = default;
  virtual void accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) = 0;
};

/// Selects one sender of a channel at a time, because mixed samples of two senders make no sense. Another sender may
/// take over when the current one has been silent; so a restarted sender is received again.
///
/// Thread contract: thread-bound.
class LcmSenderChoice {
 public:
  explicit LcmSenderChoice(Duration silent_after) : silent_after_(silent_after) {}

  bool would_accept(LcmPeer sender, Stamp now) const {
    return changes_ == 0 || sender == sender_ || now - heard_ >= silent_after_;
  }
  /// To be called with a valid message of a sender that would_accept() accepts. True: the sender has changed.
  bool heard(LcmPeer sender, Stamp now) {
    const bool is_new = changes_ == 0 || sender != sender_;
    if (is_new) ++changes_;
    sender_ = sender;
    heard_ = now;
    return is_new;
  }
  /// Makes `sender` the current one; its last message was at `heard`.
  void resume(LcmPeer sender, Stamp heard) {
    sender_ = sender;
    heard_ = heard;
    changes_ = 1;
  }
  LcmPeer sender() const { return sender_; }          ///< requires changes()
  std::uint64_t changes() const { return changes_; }  ///< number of senders so far, including the first

 private:
  Duration silent_after_;
  LcmPeer sender_ = 0;
  Stamp heard_{};
  std::uint64_t changes_ = 0;
};

}  // namespace azimuth
