#pragma once
// The meaning of the texts in IidcSettings. Any text is safe. Thread contract: reentrant.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/iidc/iidc_settings.hpp"

namespace azimuth::iidc {

/// The requested state of a feature.
struct FeatureWish {
  enum class Kind {
    keep,  // leave the camera's setting
    automatic,
    off,
    value,    // value of the register
    pair,     // white balance: two registers
    absolute  // in the feature's unit
  };
  Kind kind = Kind::keep;
  std::uint32_t value = 0;         ///< register value, or blue (U) of a pair
  std::uint32_t second_value = 0;  ///< red (V) of a pair
  double absolute = 0.0;           ///< in s, dB or EV
  friend bool operator==(const FeatureWish&, const FeatureWish&) = default;
};

/// The unit of an absolute value of a feature.
enum class FeatureUnit { none, second, decibel, exposure_value };

/// Registers have 12 bits.
inline constexpr std::uint32_t kMaxFeatureValue = 4095;

/// Parses the text of a feature. None for an invalid text, or for a unit that the feature does not have. Units: s, ms,
/// us; dB; EV.
std::optional<FeatureWish> parse_feature(std::string_view text, FeatureUnit unit);
std::optional<FeatureWish> parse_white_balance(std::string_view text);

/// A GUID of 1 to 16 hexadecimal digits, with or without 0x. None for any other text, including the empty one.
std::optional<std::uint64_t> parse_guid(std::string_view text);
/// The GUID with all 16 digits.
std::string guid_text(std::uint64_t guid);

/// A feature in IidcSettings.
struct FeatureText {
  std::string_view name;  ///< its name in the settings
  std::string IidcSettings::*text;
  FeatureUnit unit;
  bool is_pair;
};
/// The parsed text of a feature; none for an invalid one.
std::optional<FeatureWish> parse(const FeatureText& feature, const IidcSettings& settings);

/// All features, in the same order as in iidc_features.cpp.
inline constexpr FeatureText kFeatureTexts[] = {
    {"brightness", &IidcSettings::brightness, FeatureUnit::none, false},
    {"exposure", &IidcSettings::exposure, FeatureUnit::exposure_value, false},
    {"shutter", &IidcSettings::shutter, FeatureUnit::second, false},
    {"gain", &IidcSettings::gain, FeatureUnit::decibel, false},
    {"focus", &IidcSettings::focus, FeatureUnit::none, false},
    {"white_balance", &IidcSettings::white_balance, FeatureUnit::none, true},
    {"gamma", &IidcSettings::gamma, FeatureUnit::none, false},
    {"sharpness", &IidcSettings::sharpness, FeatureUnit::none, false},
};

/// An error in a setting that is invalid for every camera.
struct IidcSettingProblem {
  std::string_view key;  ///< key of the setting
  std::string text;      ///< continues the key: "is "blue", must be ..."
};
/// The first error; none when all settings are valid.
std::optional<IidcSettingProblem> problem_of(const IidcSettings& settings);

}  // namespace azimuth::iidc
