#pragma once
// What the texts among IidcSettings mean. Any text is safe.
// Thread contract: reentrant.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/iidc/iidc_settings.hpp"

namespace azimuth::iidc {

/// A feature as the settings want it.
struct FeatureWish {
  enum class Kind {
    keep,  // as the camera has it
    automatic,
    off,
    value,    // of the register
    pair,     // of white balance: two registers
    absolute  // in the feature's unit
  };
  Kind kind = Kind::keep;
  std::uint32_t value = 0;         ///< or blue (U) of a pair
  std::uint32_t second_value = 0;  ///< red (V) of a pair
  double absolute = 0.0;           ///< s, dB or EV
  friend bool operator==(const FeatureWish&, const FeatureWish&) = default;
};

/// What a number with a unit may stand for.
enum class FeatureUnit { none, second, decibel, exposure_value };

/// Values of registers have 12 bits.
inline constexpr std::uint32_t kMaxFeatureValue = 4095;

/// Nothing for a text that means none of that, or a unit that is not the feature's. Units: s, ms, us; dB; EV.
std::optional<FeatureWish> parse_feature(std::string_view text, FeatureUnit unit);
std::optional<FeatureWish> parse_white_balance(std::string_view text);

/// Of 1 to 16 hexadecimal digits, with or without 0x. Nothing for any other text, the empty one included.
std::optional<std::uint64_t> parse_guid(std::string_view text);
/// All 16 digits.
std::string guid_text(std::uint64_t guid);

/// One of the features that IidcSettings name.
struct FeatureText {
  std::string_view name;  ///< as the settings have it
  std::string IidcSettings::*text;
  FeatureUnit unit;
  bool is_pair;
};
/// What its text says; nothing for a wrong one.
std::optional<FeatureWish> parse(const FeatureText& feature, const IidcSettings& settings);

/// All of them; the same order as in iidc_features.cpp.
inline constexpr FeatureText kFeatureTexts[] = {
    {"brightness", &IidcSettings::brightness, FeatureUnit::none, false},
    {"exposure", &IidcSettings::exposure, FeatureUnit::exposure_value, false},
    {"shutter", &IidcSettings::shutter, FeatureUnit::second, false},
    {"gain", &IidcSettings::gain, FeatureUnit::decibel, false},
    {"iris", &IidcSettings::iris, FeatureUnit::none, false},
    {"focus", &IidcSettings::focus, FeatureUnit::none, false},
    {"white_balance", &IidcSettings::white_balance, FeatureUnit::none, true},
    {"saturation", &IidcSettings::saturation, FeatureUnit::none, false},
    {"gamma", &IidcSettings::gamma, FeatureUnit::none, false},
    {"sharpness", &IidcSettings::sharpness, FeatureUnit::none, false},
};

/// What is wrong with a setting that no camera could have.
struct IidcSettingProblem {
  std::string_view key;  ///< of the setting
  std::string text;      ///< goes on from the key: "is "blue", must be ..."
};
/// The first that is found; nothing when all is well.
std::optional<IidcSettingProblem> problem_of(const IidcSettings& settings);

}  // namespace azimuth::iidc
