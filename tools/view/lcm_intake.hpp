#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "drivers/lcm/lcm_sink.hpp"
#include "tools/view/live_view.hpp"
#include "tools/view/message_parts.hpp"

namespace azimuth {

/// Message counts since the start.
struct IntakeCounts {
  std::uint64_t messages = 0;                                   ///< accepted messages
  std::map<std::string, std::uint64_t, std::less<>> malformed;  ///< by channel: wrong type or implausible content
  std::uint64_t other_senders = 0;                              ///< messages of a second daemon on the same channels
};

/// Receives the LCM datagrams of one daemon and of a sender of truth. Any content on any channel is safe. Receipts have
/// the unmodified time of CLOCK_MONOTONIC.
///
/// Thread contract: thread-bound. Borrows the view.
class LcmIntake final : public LcmSink {
 public:
  LcmIntake(LiveView& view, std::string channel_prefix);

  void accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) override;

  const IntakeCounts& counts() const { return counts_; }

 private:
  bool take(std::string_view channel, Bytes data, const Reception& heard);
  bool take_picture(Bytes data, const Reception& heard);
  bool take_document(Bytes data, const Reception& heard);
  bool is_of_the_daemon(std::string_view channel, LcmPeer sender, const LcmReceipt& receipt, const Reception& heard);

  LiveView& view_;
  std::string prefix_;
  MessageParts parts_;
  LcmSenderChoice daemon_, painter_, truth_;
  IntakeCounts counts_;
};

}  // namespace azimuth
