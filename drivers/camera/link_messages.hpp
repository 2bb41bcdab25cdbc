#pragma once
// What a camera server and its client say to each other, on bytes: one message a packet, little-endian.
//
// - hello, by the server, once: kind, "AZCM", layout, pixels, width, height, stride, slot_bytes, slots; with the
//   memory's descriptor if there are slots
// - frame, by the server: kind, slot, sequence, stamp_us, bytes
// - bearings, by the server: kind, count, sequence, stamp_us, then count times azimuth, elevation, identity,
//   sigma, radius, sigma of the elevation, kind
// - release, by the client: kind, slot, sequence
//
// The decoding functions take bytes from anywhere and refuse what is not exactly such a message with values that can be
// true. They never throw; nothing but `into` of decode_bearings() allocates.
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

inline constexpr std::uint32_t kLayout = 3;  ///< of these messages; changes when any of them does
inline constexpr std::size_t kMaxBearings = 1024;
inline constexpr std::size_t kMaxSlotBytes = std::size_t{256} << 20U;
inline constexpr std::size_t kMaxMemory = std::size_t{1} << 30U;  ///< of all slots
inline constexpr std::size_t kMaxMessageBytes = 24 + 52 * kMaxBearings;

enum class MessageKind : std::uint32_t { hello = 1, frame = 2, bearings = 3, release = 4 };

/// How the server lays out its frames. Slot i begins at i * slot_bytes of the shared memory.
struct Hello {
  FrameFormat format{};          ///< all zero when there are no slots
  std::uint32_t slot_bytes = 0;  ///< at least format.bytes()
  std::uint32_t slots = 0;       ///< 0: bearings only
  friend bool operator==(const Hello&, const Hello&) = default;

  std::size_t memory_bytes() const { return std::size_t{slots} * slot_bytes; }
};
bool is_valid(const Hello& hello);

/// A slot has been filled; it is the client's until released.
struct FrameMessage {
  std::uint32_t slot = 0;
  std::uint64_t sequence = 0;
  Stamp stamp{};
  std::uint32_t bytes = 0;  ///< of the image; fewer than the slot's for mjpeg
  friend bool operator==(const FrameMessage&, const FrameMessage&) = default;
};

/// The sequence tells a late release of an old frame from one of the frame now in the slot.
struct Release {
  std::uint32_t slot = 0;
  std::uint64_t sequence = 0;
  friend bool operator==(const Release&, const Release&) = default;
};

// Each replaces the content of `out`, whose storage is meant to be used again.
void encode(const Hello& hello, std::vector<std::byte>& out);
void encode(const FrameMessage& frame, std::vector<std::byte>& out);
void encode(const BearingSet& set, std::vector<std::byte>& out);  ///< at most kMaxBearings
void encode(const Release& release, std::vector<std::byte>& out);

std::optional<MessageKind> kind_of(Bytes message);
std::optional<Hello> decode_hello(Bytes message);
/// `hello` is the valid one that opened the connection.
std::optional<FrameMessage> decode_frame(Bytes message, const Hello& hello);
std::optional<Release> decode_release(Bytes message);
/// On false, `into` is of no use but its storage.
bool decode_bearings(Bytes message, BearingSet& into);

}  // namespace azimuth::camera_link
