#pragma once
// The controls of an emulated UVC camera: gain, white balance, exposure, focus, brightness.

#include <array>
#include <cstdint>
#include <span>

#include "tests/equipment/usb_camera/usb_request.hpp"

namespace azimuth::sim {

// Entities of the camera's function.
inline constexpr std::uint8_t kCameraTerminal = 1, kOutputTerminal = 2, kProcessingUnit = 3;

/// One control. Numbers are in two's complement with `bytes` bytes.
struct UvcControl {
  std::uint8_t entity, selector, bytes;
  std::uint8_t map_bit;  ///< In the descriptor of its entity
  std::int32_t minimum, maximum, step, initial;
  /// Selector of the switch that makes this control automatic, and the value at which it is manual; 0: no such switch.
  std::uint8_t automatic;
  std::int32_t manual;
  bool is_mask;  ///< `step` has a bit for each permitted value
};

std::span<const UvcControl> uvc_controls();

/// The bits of an entity's controls, for its descriptor.
std::uint32_t uvc_control_map(std::uint8_t entity);

/// Reasons of a refusal, by the UVC specification.
enum class UvcRefusal : std::uint8_t {
  none = 0,
  wrong_state = 2,  ///< The control is automatic at present
  out_of_range = 4,
  invalid_unit = 5,
  invalid_control = 6,
  invalid_request = 7
};

/// Stores the values that the host sets, and refuses those that a real camera would refuse.
///
/// Thread contract: thread-bound.
class UvcControlBank {
 public:
  UvcControlBank() { reset(); }
  void reset();

  /// Handles a request to an entity of the control interface or to the interface itself (entity 0), which asks for the
  /// reason of the last refusal.
  ControlAnswer request(const ControlRequest& request, OctetSpan data);
  std::int32_t value(std::uint8_t entity, std::uint8_t selector) const;

 private:
  static constexpr std::size_t kMostControls = 16;

  ControlAnswer refuse(UvcRefusal why);
  ControlAnswer get(std::size_t index, std::uint8_t request);
  ControlAnswer set(std::size_t index, OctetSpan data);
  bool is_automatic(const UvcControl& control) const;

  std::array<std::int32_t, kMostControls> values_{};
  UvcRefusal refusal_ = UvcRefusal::none;
};

}  // namespace azimuth::sim
