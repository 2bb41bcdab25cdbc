#include "drivers/v4l2/v4l2_settings.hpp"

#include <array>
#include <charconv>
#include <utility>

#include "drivers/v4l2/v4l2_finder.hpp"
#include "drivers/v4l2/v4l2_format.hpp"

namespace azimuth {

std::optional<ControlChoice> parse_control_choice(std::string_view text) {
  if (text == "keep") return ControlChoice{};
  if (text == "auto") return ControlChoice{ControlChoice::Mode::automatic, 0};
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return ControlChoice{ControlChoice::Mode::fixed, value};
}

std::vector<V4l2Problem> problems(const V4l2Settings& settings) {
  std::vector<V4l2Problem> found;
  const auto is_wrong = [&](const char* key, const std::string& value, const std::string& must) {
    found.push_back({key, "is \"" + value + "\", must be " + must});
  };
  if (!v4l2::parse_name(settings.device))
    is_wrong("device", settings.device, "a path, serial:..., usb:VVVV:PPPP[:SERIAL], card:... or first");
  if ((settings.width_px == 0) != (settings.height_px == 0))
    found.push_back({settings.width_px == 0 ? "width_px" : "height_px", "is missing: it goes with the other side"});
  if (!v4l2::parse_formats(settings.formats))
    is_wrong("formats", settings.formats, "auto or some of " + v4l2::known_formats());
  const std::array<std::pair<const char*, const std::string*>, 4> choices{{{"exposure", &settings.exposure},
                                                                           {"gain", &settings.gain},
                                                                           {"white_balance", &settings.white_balance},
                                                                           {"focus", &settings.focus}}};
  for (const auto& [key, text] : choices)
    if (!parse_control_choice(*text)) is_wrong(key, *text, "auto, keep or a number");
  return found;
}

}  // namespace azimuth
