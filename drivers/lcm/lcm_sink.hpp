#pragma once
#include <cstdint>

#include "drivers/lcm/lcm_packet.hpp"
#include "drivers/lcm/lcm_stamps.hpp"

namespace azimuth {

/// Address and port of a sender; each process that sends has its own.
using LcmPeer = std::uint64_t;

/// What a receiver hands its datagrams to: whatever anybody sends to the group, on any channel.
///
/// Thread contract: thread-bound.
class LcmSink {
 public:
  virtual ~LcmSink() = default;
  virtual void accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) = 0;
};

/// Listens to one sender of a channel at a time: samples of two, mixed, would make no sense. Another may take over when
/// the present one has been silent: so one that restarts is heard again.
///
/// Thread contract: thread-bound.
class LcmSenderChoice {
 public:
  explicit LcmSenderChoice(Duration silent_after) : silent_after_(silent_after) {}

  bool would_accept(LcmPeer sender, Stamp now) const {
    return changes_ == 0 || sender == sender_ || now - heard_ >= silent_after_;
  }
  /// Something good came from a sender that would be accepted. True: it is another one than before.
  bool heard(LcmPeer sender, Stamp now) {
    const bool is_new = changes_ == 0 || sender != sender_;
    if (is_new) ++changes_;
    sender_ = sender;
    heard_ = now;
    return is_new;
  }
  /// That sender is the present one; nobody has listened to it since `heard`.
  void resume(LcmPeer sender, Stamp heard) {
    sender_ = sender;
    heard_ = heard;
    changes_ = 1;
  }
  LcmPeer sender() const { return sender_; }          ///< requires changes()
  std::uint64_t changes() const { return changes_; }  ///< the first sender included

 private:
  Duration silent_after_;
  LcmPeer sender_ = 0;
  Stamp heard_{};
  std::uint64_t changes_ = 0;
};

}  // namespace azimuth
