#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "drivers/lcm/lcm_sink.hpp"
#include "tools/view/live_view.hpp"
#include "tools/view/message_parts.hpp"

namespace azimuth {

/// What was not shown, since the start.
struct IntakeCounts {
  std::uint64_t messages = 0;                                   ///< shown
  std::map<std::string, std::uint64_t, std::less<>> malformed;  ///< none of their channel's type, or cannot be true
  std::uint64_t other_senders = 0;                              ///< of a second daemon on the same channels
};

/// Takes LCM's datagrams of one daemon, and of whoever sends truth; anything may be sent on any channel. Receipts are
/// dated CLOCK_MONOTONIC, with nothing added.
///
/// Thread contract: thread-bound. Borrows the view.
class LcmIntake final : public LcmSink {
 public:
  LcmIntake(LiveView& view, std::string channel_prefix);

  void accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) override;

  const IntakeCounts& counts() const { return counts_; }

 private:
  bool take(std::string_view channel, Bytes data, const Heard& heard);
  bool take_picture(Bytes data, const Heard& heard);
  bool take_document(Bytes data, const Heard& heard);
  bool is_of_the_daemon(std::string_view channel, LcmPeer sender, const LcmReceipt& receipt, const Heard& heard);

  LiveView& view_;
  std::string prefix_;
  MessageParts parts_;
  LcmSenderChoice daemon_, painter_, truth_;
  IntakeCounts counts_;
};

}  // namespace azimuth
