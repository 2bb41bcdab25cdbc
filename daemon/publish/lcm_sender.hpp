#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/device/back_off.hpp"

struct _lcm_t;  // NOLINT(bugprone-reserved-identifier): the name is LCM's

namespace azimuth {

/// Sends LCM messages. It never subscribes, so no data from the network are decoded.
///
/// A missing network is an expected state. Messages that cannot be sent are counted. The log gets one line when sending
/// fails and one when it works again. A handle that could not be made is tried again at growing intervals, up to 30 s.
///
/// Thread contract: thread-bound; not for real-time threads (it allocates and makes system calls).
class LcmSender {
 public:
  /// `prefix` is put before every channel name.
  LcmSender(std::string url, std::string prefix);
  ~LcmSender();
  LcmSender(LcmSender&& other) noexcept;
  LcmSender& operator=(LcmSender&&) = delete;
  LcmSender(const LcmSender&) = delete;
  LcmSender& operator=(const LcmSender&) = delete;

  /// Sends one message of a generated type.
  template <class Message>
  void send(std::string_view channel, const Message& message) {
    const int size = message.getEncodedSize();
    buffer_.resize(static_cast<std::size_t>(size));
    message.encode(buffer_.data(), 0, size);
    send_bytes(channel);
  }

  /// The encoded message of the last send(), even if it could not be sent.
  std::span<const std::byte> last() const { return buffer_; }

  std::uint64_t failures() const { return failures_; }

 private:
  void send_bytes(std::string_view channel);
  bool connect();
  void note_working();
  void note_trouble(const char* what, int error);

  std::string url_, prefix_, channel_;
  _lcm_t* lcm_ = nullptr;
  std::vector<std::byte> buffer_;
  std::uint64_t failures_ = 0;
  bool failing_ = false;
  BackOff back_off_;
};

}  // namespace azimuth
