#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace azimuth {

/// The setting of a control that a camera can also set automatically: "auto", "keep" (unchanged), or a number in the
/// device's own units.
struct ControlChoice {
  enum class Mode { keep, automatic, fixed };
  Mode mode = Mode::keep;
  int value = 0;
  friend bool operator==(const ControlChoice&, const ControlChoice&) = default;
};

/// None: the text is neither one of these words nor a number.
std::optional<ControlChoice> parse_control_choice(std::string_view text);

enum class PowerLine { keep, off, hz50, hz60, automatic };

/// A camera of the kernel's video interface, and its settings. A setting that the camera does not support is reported
/// and ignored; only a different format or size makes the camera refused.
struct V4l2Settings {
  /// A path ("/dev/v4l/by-id/...", "/dev/omnicam"), or an identification that does not depend on the node:
  /// "serial:XYZ", "usb:VVVV:PPPP" or "usb:VVVV:PPPP:SERIAL" (hexadecimal as printed by lsusb), "card:NAME" (the
  /// driver's name), or "first".
  std::string device = "first";
  int width_px = 0;      ///< with height_px; 0: unchanged, in the daemon as the rig says
  int height_px = 0;     ///< with width_px; 0: unchanged, in the daemon as the rig says
  double rate_hz = 0.0;  ///< images per second; 0: unchanged
  /// Codes in order of preference, e.g. "YUYV,MJPG"; auto: the supported format with the lowest cost of reading.
  std::string formats = "auto";
  bool wants_colour = false;               ///< for auto
  int buffers = 6;                         ///< images that the kernel may hold, 3 to 32
  std::string exposure = "auto";           ///< a ControlChoice; a number is in units of 0.1 ms
  std::string gain = "auto";               ///< a ControlChoice
  std::string white_balance = "auto";      ///< a ControlChoice; a number is in kelvin
  std::string focus = "keep";              ///< a ControlChoice
  PowerLine power_line = PowerLine::keep;  ///< against flicker of lamps
  /// Allows an automatic exposure to lower the rate in the dark.
  bool exposure_may_lower_rate = false;
};

/// The key of a setting, and an error text about its value.
struct V4l2Problem {
  const char* key = "";
  std::string text;
};

/// All errors that the range of a single number cannot find.
std::vector<V4l2Problem> problems(const V4l2Settings& settings);

}  // namespace azimuth
