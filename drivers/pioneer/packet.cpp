#include "drivers/pioneer/packet.hpp"

#include <algorithm>
#include <cassert>

namespace azimuth::pioneer {
namespace {

constexpr std::uint8_t kHeader0 = 0xFA, kHeader1 = 0xFB;
constexpr std::size_t kHeaderSize = 3;  // including N
constexpr std::uint8_t kMinLength = 3;  // an id and the checksum

/// Size of the frame at the beginning of `bytes`; 0: there is no frame. Requires kHeaderSize bytes.
std::size_t frame_size(ByteView bytes) {
  const bool is_header = bytes[0] == kHeader0 && bytes[1] == kHeader1 && bytes[2] >= kMinLength;
  return is_header ? kHeaderSize + bytes[2] : 0;
}

ByteView data_of(ByteView frame) { return frame.subspan(kHeaderSize, frame.size() - kFrameOverhead); }

bool checksum_matches(ByteView frame) {
  const auto end = frame.last(2);
  return checksum(data_of(frame)) == ((end[0] << 8) | end[1]);
}

}  // namespace

std::uint16_t checksum(ByteView data) {
  unsigned sum = 0;
  std::size_t i = 0;
  for (; i + 1 < data.size(); i += 2) sum += (static_cast<unsigned>(data[i]) << 8U) | data[i + 1];
  if (i < data.size()) sum ^= data[i];
  return static_cast<std::uint16_t>(sum);
}

Frame encode_frame(ByteView data) {
  assert(!data.empty() && data.size() <= kMaxDataSize);
  Frame frame;
  frame.bytes[0] = kHeader0;
  frame.bytes[1] = kHeader1;
  frame.bytes[2] = static_cast<std::uint8_t>(data.size() + 2);
  std::ranges::copy(data, frame.bytes.begin() + kHeaderSize);
  const std::uint16_t sum = checksum(data);
  frame.bytes[kHeaderSize + data.size()] = static_cast<std::uint8_t>(sum >> 8U);
  frame.bytes[kHeaderSize + data.size() + 1] = static_cast<std::uint8_t>(sum);
  frame.size = data.size() + kFrameOverhead;
  return frame;
}

std::size_t PacketScanner::add(ByteView bytes, Clock::time_point arrival, Clock::duration byte_time) {
  std::move(bytes_.begin() + static_cast<std::ptrdiff_t>(begin_), bytes_.begin() + static_cast<std::ptrdiff_t>(end_),
            bytes_.begin());
  std::move(arrivals_.begin() + static_cast<std::ptrdiff_t>(begin_),
            arrivals_.begin() + static_cast<std::ptrdiff_t>(end_), arrivals_.begin());
  end_ -= begin_;
  begin_ = 0;
  const std::size_t taken = std::min(bytes.size(), kCapacity - end_);
  for (std::size_t i = 0; i < taken; ++i, ++end_) {
    bytes_[end_] = bytes[i];
    arrivals_[end_] = arrival - byte_time * static_cast<Clock::rep>(bytes.size() - 1 - i);
  }
  return taken;
}

std::optional<Packet> PacketScanner::next() {
  while (true) {
    skip_to_header();
    if (size() < kHeaderSize) return std::nullopt;
    const std::size_t whole = frame_size(rest());
    if (whole == 0) {
      skip(1);
    } else if (size() < whole) {
      if (!skip_to_packet_inside()) return std::nullopt;
    } else if (checksum_matches(rest().first(whole))) {
      return consume(whole, true);
    } else {
      ++bad_checksums_;
      if (believe_ && believe_(data_of(rest().first(whole)))) return consume(whole, false);
      skip(1);
    }
  }
}

void PacketScanner::clear() { skip(size()); }

void PacketScanner::skip(std::size_t count) {
  skipped_bytes_ += count;
  begin_ += count;
}

/// Skips to the first byte that may begin a header.
void PacketScanner::skip_to_header() {
  const ByteView bytes = rest();
  skip(static_cast<std::size_t>(std::ranges::find(bytes, kHeader0) - bytes.begin()));
}

/// Skips from an incomplete packet to a correct one inside it, if there is one.
bool PacketScanner::skip_to_packet_inside() {
  for (std::size_t at = 1; at + kHeaderSize <= size(); ++at) {
    const ByteView bytes = rest().subspan(at);
    const std::size_t whole = frame_size(bytes);
    if (whole == 0 || bytes.size() < whole || !checksum_matches(bytes.first(whole))) continue;
    skip(at);
    return true;
  }
  return false;
}

Packet PacketScanner::consume(std::size_t frame_size, bool verified) {
  const Packet packet{data_of(rest().first(frame_size)), arrivals_[begin_], verified};
  begin_ += frame_size;
  return packet;
}

}  // namespace azimuth::pioneer
