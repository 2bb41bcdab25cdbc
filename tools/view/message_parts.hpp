#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/lcm/lcm_sink.hpp"

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

}  // namespace azimuth
