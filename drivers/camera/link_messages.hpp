#pragma once
// The messages between a camera server and its client, as bytes: one message per packet, little-endian.
//
// - hello, from the server, once: kind, "AZCM", layout, pixels, width, height, stride, slot_bytes, slots; with the
//   descriptor of the memory if there are slots
// - frame, from the server: kind, slot, sequence, stamp_us, bytes
// - bearings, from the server: kind, count, sequence, stamp_us, then count times azimuth, elevation, identity,
//   sigma, radius, sigma of the elevation, kind
// - release, from the client: kind, slot, sequence
//
// The decoding functions accept bytes from any origin. They refuse everything that is not exactly such a message with
// plausible values. They never throw, and only `into` of decode_bearings() allocates.
//
// Thread contract: reentrant.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/bytes.hpp"
#include "drivers/camera/frame.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth::camera_link {

inline constexpr std::uint32_t kLayout = 3;  ///< version of these messages; changes when any of them does
inline constexpr std::size_t kMaxBearings = 1024;
inline constexpr std::size_t kMaxSlotBytes = std::size_t{256} << 20U;
inline constexpr std::size_t kMaxMemory = std::size_t{1} << 30U;  ///< largest size of all slots together [bytes]
inline constexpr std::size_t kMaxMessageBytes = 24 + 52 * kMaxBearings;

enum class MessageKind : std::uint32_t { hello = 1, frame = 2, bearings = 3, release = 4 };

/// The layout of the server's frames. Slot i starts at i * slot_bytes of the shared memory.
struct Hello {
  FrameFormat format{};          ///< all zero when there are no slots
  std::uint32_t slot_bytes = 0;  ///< at least format.bytes()
  std::uint32_t slots = 0;       ///< 0: bearings only
  friend bool operator==(const Hello&, const Hello&) = default;

  std::size_t memory_bytes() const { return std::size_t{slots} * slot_bytes; }
};
bool is_valid(const Hello& hello);

/// Tells that a slot has been filled. The slot belongs to the client until the client releases it.
struct FrameMessage {
  std::uint32_t slot = 0;
  std::uint64_t sequence = 0;
  Stamp stamp{};
  std::uint32_t bytes = 0;  ///< size of the image; less than the slot for mjpeg
  friend bool operator==(const FrameMessage&, const FrameMessage&) = default;
};

/// Releases a slot. The sequence number distinguishes a late release of an old frame from one of the current frame.
struct Release {
  std::uint32_t slot = 0;
  std::uint64_t sequence = 0;
  friend bool operator==(const Release&, const Release&) = default;
};

// Each function replaces the contents of `out`, whose storage can be reused.
void encode(const Hello& hello, std::vector<std::byte>& out);
void encode(const FrameMessage& frame, std::vector<std::byte>& out);
void encode(const BearingSet& set, std::vector<std::byte>& out);  ///< at most kMaxBearings bearings
void encode(const Release& release, std::vector<std::byte>& out);

std::optional<MessageKind> kind_of(Bytes message);
std::optional<Hello> decode_hello(Bytes message);
/// `hello` is the valid message that opened the connection.
std::optional<FrameMessage> decode_frame(Bytes message, const Hello& hello);
std::optional<Release> decode_release(Bytes message);
/// On false, the contents of `into` are undefined.
bool decode_bearings(Bytes message, BearingSet& into);

}  // namespace azimuth::camera_link
