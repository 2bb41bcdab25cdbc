#pragma once
// LCM's event log format as bytes: sync word, event number, time, two lengths (28 bytes, big-endian), channel, data.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"

namespace azimuth {

/// One event of a log. Borrows channel and data.
struct LogEvent {
  std::int64_t number = 0;    ///< counts events from 0
  std::int64_t utime_us = 0;  ///< time of recording [us since the epoch]
  std::string_view channel;   ///< 1 to kMaxChannelLength bytes
  Bytes data;                 ///< at most kMaxEventData bytes
};

inline constexpr std::size_t kEventHeaderSize = 28;
inline constexpr std::size_t kMaxChannelLength = 63;                   // liblcm's own limit
inline constexpr std::size_t kMaxEventData = std::size_t{256} << 20U;  // the largest message LCM can carry

/// Appends the encoded event. Requires lengths within the limits above.
void append_event(std::vector<std::byte>& out, const LogEvent& event);

/// Reads the events of a log in memory, for any bytes. Bytes that belong to no complete event are skipped and counted.
///
/// An event counts as complete when another event or the end follows it. An event followed by anything else is accepted
/// only if no complete event begins inside it, so that a wrong length or a truncation loses only the damaged event. The
/// time is linear in the size of the log; nothing is allocated. Thread contract: thread-bound.
class EventScanner {
 public:
  explicit EventScanner(Bytes log) : log_(log) {}

  /// The next complete event, which borrows from the log; none at the end.
  std::optional<LogEvent> next();

  /// Number of bytes skipped so far.
  std::uint64_t damaged_bytes() const { return damaged_bytes_; }
  /// Number of positions tested for the beginning of an event, which dominates the run time.
  std::uint64_t headers_read() const { return headers_read_; }

 private:
  std::optional<LogEvent> event_at(std::size_t at);
  std::size_t find_bounded_event(std::size_t from, std::size_t before);
  void skip_to(std::size_t position);

  Bytes log_;
  std::size_t position_ = 0;
  std::uint64_t damaged_bytes_ = 0, headers_read_ = 0;
};

}  // namespace azimuth
