#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace azimuth {

/// What is to become of something a camera can also decide by itself: "auto", "keep" (leave it as it is), or a number
/// in the device's own units.
struct ControlChoice {
  enum class Mode { keep, automatic, fixed };
  Mode mode = Mode::keep;
  int value = 0;
  friend bool operator==(const ControlChoice&, const ControlChoice&) = default;
};

/// Nothing: not one of those words.
std::optional<ControlChoice> parse_control_choice(std::string_view text);

enum class PowerLine { keep, off, hz50, hz60, automatic };

/// A camera of the kernel's video interface, and how it is to be set up. What it does not have or do is told and left
/// at that; only another format or size than asked for is refused.
struct V4l2Settings {
  /// A path ("/dev/v4l/by-id/...", "/dev/omnicam"), or what identifies it wherever it turns up: "serial:XYZ",
  /// "usb:VVVV:PPPP" or "usb:VVVV:PPPP:SERIAL" (hexadecimal as lsusb prints them), "card:NAME" (as the driver calls
  /// it), or "first".
  std::string device = "first";
  int width_px = 0;               ///< with height_px; 0: as it is set, in the daemon as the rig says
  int height_px = 0;              ///< likewise
  double rate_hz = 0.0;           ///< images per second; 0: as it is set
  std::string formats = "auto";   ///< codes in order of preference, "YUYV,MJPG"; auto: whatever is read at least cost
  bool wants_colour = false;      ///< for auto
  int buffers = 6;                ///< images the kernel may hold, 3 to 32
  std::string exposure = "auto";  ///< as ControlChoice; fixed in units of 0.1 ms
  std::string gain = "auto";      ///< as ControlChoice
  std::string white_balance = "auto";      ///< as ControlChoice; fixed in kelvin
  std::string focus = "keep";              ///< as ControlChoice
  PowerLine power_line = PowerLine::keep;  ///< against flicker
  bool exposure_may_lower_rate = false;    ///< in the dark, of an automatic exposure
};

/// A setting's name, and what is wrong with its value as text for the user.
struct V4l2Problem {
  const char* key = "";
  std::string text;
};

/// All that no single number's range can tell.
std::vector<V4l2Problem> problems(const V4l2Settings& settings);

}  // namespace azimuth
