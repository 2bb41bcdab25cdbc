#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace azimuth {

/// The identifier of a frame on the bus, with 11 bits, or 29 in an extended frame. Both kinds may use the same number
/// for different frames.
struct CanId {
  std::uint32_t number = 0;
  bool extended = false;
  friend bool operator==(const CanId&, const CanId&) = default;
  friend bool operator<(const CanId& a, const CanId& b) {
    return a.extended != b.extended ? b.extended : a.number < b.number;
  }
};

/// The largest number of an identifier.
constexpr std::uint32_t largest_can_id(bool extended) { return extended ? 0x1FFFFFFFU : 0x7FFU; }

/// A frame as the kernel delivers it.
struct CanFrame {
  enum class Kind : std::uint8_t {
    data,
    remote,  ///< requests data from another node, carries none
    /// Made by the controller's driver: `id.number` holds the classes of error, the data their details.
    error
  };
  static constexpr std::size_t kMostBytes = 64;  ///< for CAN FD; classic frames have at most 8

  CanId id;
  Kind kind = Kind::data;
  bool fd = false;
  std::uint8_t size = 0;
  std::array<std::uint8_t, kMostBytes> data{};

  std::span<const std::uint8_t> bytes() const { return {data.data(), size}; }
  friend bool operator==(const CanFrame&, const CanFrame&) = default;
};

/// Largest size of a frame on a SocketCAN socket [bytes] (CANFD_MTU).
inline constexpr std::size_t kMostCanSocketBytes = 72;

/// Decodes a datagram of a SocketCAN socket: `struct can_frame` or `struct canfd_frame`. None when it is neither, or
/// when its length exceeds the capacity of such a frame.
std::optional<CanFrame> decode_can_frame(std::span<const std::uint8_t> datagram);

/// Encodes a frame, and returns the number of bytes used. A frame of more than 8 bytes must be a CAN FD frame.
std::size_t encode_can_frame(const CanFrame& frame, std::span<std::uint8_t, kMostCanSocketBytes> datagram);

}  // namespace azimuth
