#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/lcm/lcm_sink.hpp"
#include "tools/view/live_view.hpp"

namespace azimuth {

/// A complete message. Borrows its bytes.
struct WholeMessage {
  std::string_view channel;
  Bytes data;
};

/// Reassembles fragmented messages, one at a time from each of kSenders senders and at most kMostBytes each. A sender
/// sends its messages one after another, so a new message means that the previous one stays incomplete.
///
/// Thread contract: thread-bound.
class MessageParts {
 public:
  static constexpr std::size_t kSenders = 4, kMostBytes = 8'000'000, kMostParts = 1024;

  /// The message that this packet completes. It is valid until the next call.
  std::optional<WholeMessage> take(const LcmPacket& packet, LcmPeer sender);

 private:
  struct Partial {
    bool used = false;
    LcmPeer sender = 0;
    std::uint32_t message = 0;
    std::string channel;
    std::vector<bool> there;
    std::vector<std::byte> data;
    std::size_t bytes = 0;
    std::uint64_t begun = 0;
  };
  Partial& place_for(LcmPeer sender);
  std::optional<WholeMessage> add(Partial& partial, const LcmPacket& packet);

  std::array<Partial, kSenders> partials_;
  std::uint64_t begun_ = 0;
};

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
