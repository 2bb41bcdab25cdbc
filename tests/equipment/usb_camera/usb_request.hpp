#pragma once
#include <cstdint>
#include <optional>

#include "tests/equipment/usb_camera/octets.hpp"

namespace azimuth::sim {

/// The setup packet of a control transfer.
struct ControlRequest {
  std::uint8_t type = 0;  ///< Direction, kind and recipient
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  std::uint16_t index = 0;
  std::uint16_t length = 0;  ///< Number of bytes that follow, or that are requested at most

  bool to_host() const { return (type & 0x80U) != 0; }
  std::uint8_t value_high() const { return static_cast<std::uint8_t>(value >> 8U); }
  std::uint8_t value_low() const { return static_cast<std::uint8_t>(value); }
  std::uint8_t index_high() const { return static_cast<std::uint8_t>(index >> 8U); }
  std::uint8_t index_low() const { return static_cast<std::uint8_t>(index); }
};

inline constexpr std::size_t kSetupBytes = 8;

/// Returns nullopt unless there are kSetupBytes bytes.
std::optional<ControlRequest> parse_setup(OctetSpan setup);

/// A device's answer to a control request; nullopt: a stall, by which USB rejects a request. Empty for requests without
/// data to the host.
using ControlAnswer = std::optional<Octets>;

}  // namespace azimuth::sim
