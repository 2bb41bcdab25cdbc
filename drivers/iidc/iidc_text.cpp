#include "drivers/iidc/iidc_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "drivers/iidc/iidc_modes.hpp"

namespace azimuth::iidc {
namespace {

constexpr std::size_t kGuidDigits = 16;
constexpr int kHexadecimal = 16;

std::string_view without_spaces_around(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::optional<std::uint32_t> parse_register(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value > kMaxFeatureValue) return std::nullopt;
  return value;
}

struct UnitName {
  std::string_view name;
  FeatureUnit unit;
  double scale;
};
constexpr std::array kUnits{
    UnitName{"s", FeatureUnit::second, 1.0},          UnitName{"ms", FeatureUnit::second, 1e-3},
    UnitName{"us", FeatureUnit::second, 1e-6},        UnitName{"dB", FeatureUnit::decibel, 1.0},
    UnitName{"EV", FeatureUnit::exposure_value, 1.0},
};

std::optional<double> parse_absolute(std::string_view text, FeatureUnit unit) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  const std::string_view name = without_spaces_around(text.substr(static_cast<std::size_t>(end - text.data())));
  for (const UnitName& known : kUnits)
    if (known.name == name && known.unit == unit) return value * known.scale;
  return std::nullopt;
}

/// The words that every feature accepts.
std::optional<FeatureWish> parse_word(std::string_view text) {
  using Kind = FeatureWish::Kind;
  if (text == "keep") return FeatureWish{Kind::keep};
  if (text == "auto") return FeatureWish{Kind::automatic};
  if (text == "off") return FeatureWish{Kind::off};
  return std::nullopt;
}

std::string quoted(const std::string& text, std::string_view rest) {
  return "is \"" + text + "\", " + std::string(rest);
}

std::string_view help_of(const FeatureText& feature) {
  if (feature.is_pair) return "must be keep, auto, off or two numbers from 0 to 4095, blue and red";
  switch (feature.unit) {
    case FeatureUnit::second:
      return "must be keep, auto, off, a whole number from 0 to 4095 or a time such as \"4 ms\"";
    case FeatureUnit::decibel:
      return "must be keep, auto, off, a whole number from 0 to 4095 or such as \"6 dB\"";
    case FeatureUnit::exposure_value:
      return "must be keep, auto, off, a whole number from 0 to 4095 or such as \"0.5 EV\"";
    case FeatureUnit::none:
      break;
  }
  return "must be keep, auto, off or a whole number from 0 to 4095";
}

}  // namespace

std::optional<FeatureWish> parse_feature(std::string_view text, FeatureUnit unit) {
  text = without_spaces_around(text);
  if (const auto word = parse_word(text)) return word;
  FeatureWish wish;
  if (const auto value = parse_register(text)) {
    wish.kind = FeatureWish::Kind::value;
    wish.value = *value;
  } else if (const auto absolute = parse_absolute(text, unit)) {
    wish.kind = FeatureWish::Kind::absolute;
    wish.absolute = *absolute;
  } else {
    return std::nullopt;
  }
  return wish;
}

std::optional<FeatureWish> parse_white_balance(std::string_view text) {
  text = without_spaces_around(text);
  if (const auto word = parse_word(text)) return word;
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos) return std::nullopt;
  const auto blue = parse_register(text.substr(0, space));
  const auto red = parse_register(without_spaces_around(text.substr(space)));
  if (!blue || !red) return std::nullopt;
  FeatureWish wish;
  wish.kind = FeatureWish::Kind::pair;
  wish.value = *blue;
  wish.second_value = *red;
  return wish;
}

std::optional<std::uint64_t> parse_guid(std::string_view text) {
  if (text.starts_with("0x") || text.starts_with("0X")) text.remove_prefix(2);
  if (text.empty() || text.size() > kGuidDigits) return std::nullopt;
  std::uint64_t guid = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), guid, kHexadecimal);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return guid;
}

std::string guid_text(std::uint64_t guid) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(kGuidDigits, '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, guid /= kHexadecimal)
    *digit = kDigits[guid % kHexadecimal];
  return text;
}

std::optional<FeatureWish> parse(const FeatureText& feature, const IidcSettings& settings) {
  const std::string& text = settings.*feature.text;
  return feature.is_pair ? parse_white_balance(text) : parse_feature(text, feature.unit);
}

std::optional<IidcSettingProblem> problem_of(const IidcSettings& settings) {
  if (!settings.guid.empty() && !parse_guid(settings.guid))
    return IidcSettingProblem{"guid", quoted(settings.guid, "must be empty or up to 16 hexadecimal digits")};
  if (settings.mode != "auto" && !mode_named(settings.mode))
    return IidcSettingProblem{
        "mode", quoted(settings.mode, "must be auto or a mode of IIDC such as 640x480_mono8 or format7_0")};
  if (settings.colour_coding != "auto" &&
      !is_readable(coding_named(settings.colour_coding).value_or(DC1394_COLOR_CODING_RAW16)))
    return IidcSettingProblem{"colour_coding",
                              quoted(settings.colour_coding, "must be auto, mono8, yuv422, rgb8 or raw8")};
  for (const int speed : {0, 100, 200, 400, 800}) {
    if (settings.iso_speed_mbps == speed) break;
    if (speed == 800) return IidcSettingProblem{"iso_speed_mbps", "must be 0, 100, 200, 400 or 800"};
  }
  for (const FeatureText& feature : kFeatureTexts)
    if (!parse(feature, settings))
      return IidcSettingProblem{feature.name, quoted(settings.*feature.text, help_of(feature))};
  return std::nullopt;
}

}  // namespace azimuth::iidc
