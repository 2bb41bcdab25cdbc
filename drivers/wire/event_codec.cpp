#include "drivers/wire/event_codec.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <concepts>
#include <cstring>

namespace azimuth {

namespace {

constexpr std::array kSync{std::byte{0xED}, std::byte{0xA1}, std::byte{0xDA}, std::byte{0x01}};

template <std::unsigned_integral Word>
void append_big_endian(std::vector<std::byte>& out, Word word) {
  for (int shift = 8 * (static_cast<int>(sizeof word) - 1); shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::byte>((word >> shift) & 0xFFU));
  }
}

template <std::unsigned_integral Word>
Word big_endian(Bytes bytes) {
  Word word = 0;
  for (std::size_t i = 0; i < sizeof word; ++i) word = (word << 8U) | std::to_integer<Word>(bytes[i]);
  return word;
}

/// True: an event may end here. The end of the log counts like a sync word, and so does a sync word truncated by the
/// end.
bool is_boundary(Bytes log, std::size_t at) {
  const std::size_t length = std::min(kSync.size(), log.size() - at);
  return std::equal(kSync.begin(), kSync.begin() + static_cast<std::ptrdiff_t>(length),
                    log.begin() + static_cast<std::ptrdiff_t>(at));
}

/// The next complete sync word at or after `from`; otherwise the end of the log.
std::size_t find_sync(Bytes log, std::size_t from) {
  const auto found =
      std::search(log.begin() + static_cast<std::ptrdiff_t>(from), log.end(), kSync.begin(), kSync.end());
  return static_cast<std::size_t>(found - log.begin());
}

/// The event that begins at `at`, if its lengths are within the limits and it ends within the log.
std::optional<LogEvent> event_at(Bytes log, std::size_t at) {
  const Bytes rest = log.subspan(at);
  if (rest.size() < kEventHeaderSize || !std::equal(kSync.begin(), kSync.end(), rest.begin())) return std::nullopt;
  const std::size_t channel_length = big_endian<std::uint32_t>(rest.subspan(20));
  const std::size_t data_length = big_endian<std::uint32_t>(rest.subspan(24));
  if (channel_length == 0 || channel_length > kMaxChannelLength || data_length > kMaxEventData) return std::nullopt;
  if (channel_length + data_length > rest.size() - kEventHeaderSize) return std::nullopt;
  const Bytes channel = rest.subspan(kEventHeaderSize, channel_length);
  return LogEvent{.number = static_cast<std::int64_t>(big_endian<std::uint64_t>(rest.subspan(4))),
                  .utime_us = static_cast<std::int64_t>(big_endian<std::uint64_t>(rest.subspan(12))),
                  .channel = {reinterpret_cast<const char*>(channel.data()), channel.size()},
                  .data = rest.subspan(kEventHeaderSize + channel_length, data_length)};
}

std::size_t encoded_size(const LogEvent& event) { return kEventHeaderSize + event.channel.size() + event.data.size(); }

}  // namespace

void append_event(std::vector<std::byte>& out, const LogEvent& event) {
  assert(!event.channel.empty() && event.channel.size() <= kMaxChannelLength && event.data.size() <= kMaxEventData);
  out.insert(out.end(), kSync.begin(), kSync.end());
  append_big_endian(out, static_cast<std::uint64_t>(event.number));
  append_big_endian(out, static_cast<std::uint64_t>(event.utime_us));
  append_big_endian(out, static_cast<std::uint32_t>(event.channel.size()));
  append_big_endian(out, static_cast<std::uint32_t>(event.data.size()));
  const Bytes channel = std::as_bytes(std::span(event.channel));
  out.insert(out.end(), channel.begin(), channel.end());
  out.insert(out.end(), event.data.begin(), event.data.end());
}

std::optional<LogEvent> EventScanner::event_at(std::size_t at) {
  ++headers_read_;
  return azimuth::event_at(log_, at);
}

/// The position in [from, before) of an event that is followed by a boundary; `before` if there is none.
std::size_t EventScanner::find_bounded_event(std::size_t from, std::size_t before) {
  for (std::size_t at = find_sync(log_, from); at < before; at = find_sync(log_, at + 1)) {
    const auto event = event_at(at);
    if (event && is_boundary(log_, at + encoded_size(*event))) return at;
  }
  return before;
}

std::optional<LogEvent> EventScanner::next() {
  while (position_ < log_.size()) {
    const std::optional<LogEvent> event = event_at(position_);
    const std::size_t end = event ? position_ + encoded_size(*event) : position_;
    const bool followed = event && is_boundary(log_, end);
    const std::size_t inside = event && !followed ? find_bounded_event(position_ + 1, end) : end;
    if (event && inside == end) {
      position_ = end;
      return event;
    }
    skip_to(event ? inside : find_sync(log_, position_ + 1));
  }
  return std::nullopt;
}

void EventScanner::skip_to(std::size_t position) {
  damaged_bytes_ += position - position_;
  position_ = position;
}

}  // namespace azimuth
