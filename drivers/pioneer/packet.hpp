#pragma once
// Framing of the Pioneer protocol, the same in both directions:
//
//   0xFA 0xFB  N  data[0 .. N-3]  checksum high, checksum low        N counts what follows it
//
// data[0] is a command's number or a packet's id. Fields inside data are little-endian.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace azimuth::pioneer {

/// Arrival times are CLOCK_MONOTONIC.
using Clock = std::chrono::steady_clock;
using ByteView = std::span<const std::uint8_t>;

inline constexpr std::size_t kMaxDataSize = 253;
inline constexpr std::size_t kFrameOverhead = 5;  ///< two header bytes, N, two checksum bytes
inline constexpr std::size_t kMaxFrameSize = kMaxDataSize + kFrameOverhead;

/// Sum of the big-endian 16-bit words of `data`; an odd last byte is xored in.
std::uint16_t checksum(ByteView data);

/// A whole packet as it goes over the wire.
struct Frame {
  std::array<std::uint8_t, kMaxFrameSize> bytes{};
  std::size_t size = 0;
  ByteView view() const { return {bytes.data(), size}; }
};

/// Frames `data`, of 1 to kMaxDataSize bytes.
Frame encode_frame(ByteView data);

/// A packet found in the stream. Borrows from the scanner until its next add() or next().
struct Packet {
  ByteView data;                      ///< id first; never empty
  Clock::time_point first_byte_at{};  ///< when the first header byte came, at the latest
  bool verified = true;               ///< false: the checksum is wrong and the scanner was told to believe it anyway
  std::uint8_t id() const { return data.front(); }
};

/// Finds packets in a stream of bytes that may begin anywhere, lose bytes and carry noise.
///
/// Of a packet with a wrong checksum only the first byte is given up, so a header that noise made up hides no packet
/// behind it; neither does one whose announced length keeps it waiting for bytes: a good packet that lies whole inside
/// it is believed instead. (A good packet nested in another good one may therefore win when it arrives in pieces.)
///
/// Fixed storage; never allocates. Thread contract: thread-bound.
class PacketScanner {
 public:
  /// Whether data with a wrong checksum is believed nevertheless.
  using Believe = bool (*)(ByteView data);
  explicit PacketScanner(Believe believe = nullptr) : believe_(believe) {}

  /// Takes bytes in, as many as there is room for, and says how many. After next() has returned nothing there is room
  /// for at least kRoom. The last of `bytes` arrived by `arrival`, each before it `byte_time` earlier than the next.
  std::size_t add(ByteView bytes, Clock::time_point arrival, Clock::duration byte_time = {});
  static constexpr std::size_t kRoom = 512;

  /// The next packet that is whole; nothing: more bytes are needed.
  std::optional<Packet> next();

  /// Forgets the bytes in hand, which count as skipped.
  void clear();

  std::uint64_t bad_checksums() const { return bad_checksums_; }  ///< packets given up for their checksum, or believed
  std::uint64_t skipped_bytes() const { return skipped_bytes_; }  ///< bytes that belonged to no packet

 private:
  std::size_t size() const { return end_ - begin_; }
  ByteView rest() const { return {bytes_.data() + begin_, size()}; }
  void skip(std::size_t count);
  void skip_to_header();
  bool skip_to_packet_inside();
  Packet consume(std::size_t frame_size, bool verified);

  static constexpr std::size_t kCapacity = kMaxFrameSize + kRoom;
  Believe believe_;
  std::array<std::uint8_t, kCapacity> bytes_{};
  std::array<Clock::time_point, kCapacity> arrivals_{};
  std::size_t begin_ = 0, end_ = 0;
  std::uint64_t bad_checksums_ = 0, skipped_bytes_ = 0;
};

}  // namespace azimuth::pioneer
