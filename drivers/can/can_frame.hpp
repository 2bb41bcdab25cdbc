#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace azimuth {

/// What names a frame on the bus: 11 bits, or 29 of an extended one. The same number may stand for two frames.
struct CanId {
  std::uint32_t number = 0;
  bool extended = false;
  friend bool operator==(const CanId&, const CanId&) = default;
  friend bool operator<(const CanId& a, const CanId& b) {
    return a.extended != b.extended ? b.extended : a.number < b.number;
  }
};

/// The largest number an id may have.
constexpr std::uint32_t largest_can_id(bool extended) { return extended ? 0x1FFFFFFFU : 0x7FFU; }

/// A frame as the kernel hands it over.
struct CanFrame {
  enum class Kind : std::uint8_t {
    data,
    remote,  ///< asks another node for data, carries none
    error    ///< made by the controller's driver: `id.number` holds the classes of error, the data their details
  };
  static constexpr std::size_t kMostBytes = 64;  ///< of CAN FD; classic frames have 8

  CanId id;
  Kind kind = Kind::data;
  bool fd = false;
  std::uint8_t size = 0;
  std::array<std::uint8_t, kMostBytes> data{};

  std::span<const std::uint8_t> bytes() const { return {data.data(), size}; }
  friend bool operator==(const CanFrame&, const CanFrame&) = default;
};

/// The most bytes a frame takes on a SocketCAN socket (CANFD_MTU).
inline constexpr std::size_t kMostCanSocketBytes = 72;

/// A datagram of a SocketCAN socket: `struct can_frame` or `struct canfd_frame`. Nothing when it is neither, or its
/// length is more than such a frame carries.
std::optional<CanFrame> decode_can_frame(std::span<const std::uint8_t> datagram);

/// The reverse. Returns the bytes used. A frame of more than 8 bytes must be one of CAN FD.
std::size_t encode_can_frame(const CanFrame& frame, std::span<std::uint8_t, kMostCanSocketBytes> datagram);

}  // namespace azimuth
