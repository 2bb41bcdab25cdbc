#pragma once
// Framing of the Pioneer protocol, the same in both directions:
//
//   0xFA 0xFB  N  data[0 .. N-3]  checksum high, checksum low        N is the number of bytes after it
//
// data[0] is the number of a command or the id of a packet. Fields inside data are little-endian.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace azimuth::pioneer {

/// The clock of times of arrival: CLOCK_MONOTONIC.
using Clock = std::chrono::steady_clock;
using ByteView = std::span<const std::uint8_t>;

inline constexpr std::size_t kMaxDataSize = 253;
inline constexpr std::size_t kFrameOverhead = 5;  ///< two header bytes, N, two checksum bytes
inline constexpr std::size_t kMaxFrameSize = kMaxDataSize + kFrameOverhead;

/// Sum of the big-endian 16-bit words of `data`; an odd last byte is combined by exclusive or.
std::uint16_t checksum(ByteView data);

/// A complete packet as sent over the wire.
struct Frame {
  std::array<std::uint8_t, kMaxFrameSize> bytes{};
  std::size_t size = 0;
  ByteView view() const { return {bytes.data(), size}; }
};

/// Frames `data`, which has 1 to kMaxDataSize bytes.
Frame encode_frame(ByteView data);

/// A packet found in the stream. It borrows from the scanner until the scanner's next add() or next().
struct Packet {
  ByteView data;                      ///< id first; never empty
  Clock::time_point first_byte_at{};  ///< upper bound for the time at which the first header byte arrived
  bool verified = true;               ///< false: the checksum is wrong, but the scanner's `believe` accepted the data
  std::uint8_t id() const { return data.front(); }
};

/// Finds packets in a stream of bytes that may start anywhere, lose bytes and contain noise.
///
/// After a wrong checksum only the first byte of the packet is skipped, so a header made up by noise hides no packet
/// behind it. A false header whose announced length makes the scanner wait hides none either: a correct packet that
/// lies completely inside is taken instead. (So a correct packet nested in another one may be taken when the outer one
/// arrives in pieces.)
///
/// Fixed storage; never allocates. Thread contract: thread-bound.
class PacketScanner {
 public:
  /// True: data with a wrong checksum are accepted.
  using Believe = bool (*)(ByteView data);
  explicit PacketScanner(Believe believe = nullptr) : believe_(believe) {}

  /// Takes as many bytes as there is room for, and returns their number. After next() has returned none, there is room
  /// for at least kRoom bytes. The last of `bytes` arrived at `arrival`, and each earlier byte `byte_time` before its
  /// successor.
  std::size_t add(ByteView bytes, Clock::time_point arrival, Clock::duration byte_time = {});
  static constexpr std::size_t kRoom = 512;

  /// The next complete packet; none: more bytes are needed.
  std::optional<Packet> next();

  /// Discards the buffered bytes, which count as skipped.
  void clear();

  /// Packets with a wrong checksum, including accepted ones.
  std::uint64_t bad_checksums() const { return bad_checksums_; }
  /// Bytes that belong to no packet.
  std::uint64_t skipped_bytes() const { return skipped_bytes_; }

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
