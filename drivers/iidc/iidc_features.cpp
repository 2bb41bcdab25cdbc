#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>

#include "drivers/iidc/iidc_setup.hpp"
#include "drivers/iidc/iidc_text.hpp"

namespace azimuth::iidc {
namespace {

constexpr std::array kFeatureIds{DC1394_FEATURE_BRIGHTNESS, DC1394_FEATURE_EXPOSURE, DC1394_FEATURE_SHUTTER,
                                 DC1394_FEATURE_GAIN,       DC1394_FEATURE_FOCUS,    DC1394_FEATURE_WHITE_BALANCE,
                                 DC1394_FEATURE_GAMMA,      DC1394_FEATURE_SHARPNESS};
static_assert(kFeatureIds.size() == std::size(kFeatureTexts));

/// Relative tolerance, because the camera may round an absolute value to one that the sensor supports.
constexpr double kSameAbsolute = 0.05;

using Refusal = std::optional<std::string>;  // a sentence about the feature; none: success

/// One feature of one camera. Each step returns what went wrong; none: success.
class Feature {
 public:
  Feature(dc1394camera_t* camera, dc1394feature_t id) : camera_(camera), id_(id) {}

  Refusal set(const FeatureWish& wish) {
    info_ = {};
    info_.id = id_;
    if (const auto error = dc1394_feature_get(camera_, &info_); error != DC1394_SUCCESS)
      return failed("ask for", error);
    if (info_.available == DC1394_FALSE) return "the camera does not have it";
    if (wish.kind == FeatureWish::Kind::off) return switch_off();
    if (const Refusal refusal = switch_on()) return refusal;
    switch (wish.kind) {
      case FeatureWish::Kind::automatic:
        return set_mode(DC1394_FEATURE_MODE_AUTO, "the camera cannot do it automatically");
      case FeatureWish::Kind::value:
        return set_value(wish.value);
      case FeatureWish::Kind::pair:
        return set_pair(wish.value, wish.second_value);
      case FeatureWish::Kind::absolute:
        return set_absolute(wish.absolute);
      case FeatureWish::Kind::keep:
      case FeatureWish::Kind::off:
        break;
    }
    return {};
  }

 private:
  static Refusal failed(std::string_view what, dc1394error_t error) {
    const char* const reason = dc1394_error_get_string(error);
    return "cannot " + std::string(what) + " it: " + (reason != nullptr ? reason : "unknown error");
  }

  Refusal switch_off() {
    if (info_.on_off_capable == DC1394_FALSE) return "the camera cannot switch it off";
    return power(DC1394_OFF, "it stays on");
  }
  Refusal switch_on() {
    if (info_.on_off_capable == DC1394_FALSE || info_.is_on == DC1394_ON) return {};
    return power(DC1394_ON, "it stays off");
  }
  Refusal power(dc1394switch_t wish, const char* otherwise) {
    if (const auto error = dc1394_feature_set_power(camera_, id_, wish); error != DC1394_SUCCESS)
      return failed("switch", error);
    dc1394switch_t is = wish;
    if (const auto error = dc1394_feature_get_power(camera_, id_, &is); error != DC1394_SUCCESS)
      return failed("read", error);
    return is == wish ? Refusal{} : otherwise;
  }

  Refusal set_mode(dc1394feature_mode_t wish, const char* otherwise) {
    const std::span modes(info_.modes.modes, std::min<std::size_t>(info_.modes.num, DC1394_FEATURE_MODE_NUM));
    if (std::ranges::find(modes, wish) == modes.end()) return otherwise;
    if (const auto error = dc1394_feature_set_mode(camera_, id_, wish); error != DC1394_SUCCESS)
      return failed("set", error);
    dc1394feature_mode_t is = wish;
    if (const auto error = dc1394_feature_get_mode(camera_, id_, &is); error != DC1394_SUCCESS)
      return failed("read", error);
    return is == wish ? Refusal{} : otherwise;
  }
  Refusal set_manual() { return set_mode(DC1394_FEATURE_MODE_MANUAL, "the camera does not let it be set"); }

  Refusal use_absolute(dc1394switch_t wish) {
    if (info_.absolute_capable == DC1394_FALSE) return {};
    const auto error = dc1394_feature_set_absolute_control(camera_, id_, wish);
    return error == DC1394_SUCCESS ? Refusal{} : failed("switch the kind of value of", error);
  }

  Refusal set_value(std::uint32_t wish) {
    if (const Refusal refusal = set_manual()) return refusal;
    if (const Refusal refusal = use_absolute(DC1394_OFF)) return refusal;
    const std::uint32_t possible = std::max(info_.min, std::min(wish, info_.max));
    if (const auto error = dc1394_feature_set_value(camera_, id_, possible); error != DC1394_SUCCESS)
      return failed("set", error);
    std::uint32_t is = possible;
    if (const auto error = dc1394_feature_get_value(camera_, id_, &is); error != DC1394_SUCCESS)
      return failed("read", error);
    if (is == wish) return {};
    return "is " + std::to_string(is) + "; the camera has " + std::to_string(info_.min) + " to " +
           std::to_string(info_.max);
  }

  Refusal set_pair(std::uint32_t blue, std::uint32_t red) {
    if (const Refusal refusal = set_manual()) return refusal;
    if (const Refusal refusal = use_absolute(DC1394_OFF)) return refusal;
    const auto possible = [&](std::uint32_t wish) { return std::max(info_.min, std::min(wish, info_.max)); };
    const auto error = dc1394_feature_whitebalance_set_value(camera_, possible(blue), possible(red));
    if (error != DC1394_SUCCESS) return failed("set", error);
    std::uint32_t blue_is = blue, red_is = red;
    const auto read_error = dc1394_feature_whitebalance_get_value(camera_, &blue_is, &red_is);
    if (read_error != DC1394_SUCCESS) return failed("read", read_error);
    if (blue_is == blue && red_is == red) return {};
    return "is " + std::to_string(blue_is) + " " + std::to_string(red_is);
  }

  Refusal set_absolute(double wish) {
    if (info_.absolute_capable == DC1394_FALSE) return "the camera has no absolute values for it, only its register's";
    if (const Refusal refusal = set_manual()) return refusal;
    if (const Refusal refusal = use_absolute(DC1394_ON)) return refusal;
    const auto low = static_cast<double>(info_.abs_min), high = static_cast<double>(info_.abs_max);
    const auto possible = static_cast<float>(std::max(low, std::min(wish, high)));
    if (const auto error = dc1394_feature_set_absolute_value(camera_, id_, possible); error != DC1394_SUCCESS)
      return failed("set", error);
    float is = possible;
    if (const auto error = dc1394_feature_get_absolute_value(camera_, id_, &is); error != DC1394_SUCCESS)
      return failed("read", error);
    if (std::abs(static_cast<double>(is) - wish) <= kSameAbsolute * std::max(std::abs(wish), 1e-6)) return {};
    return "is " + short_number(static_cast<double>(is)) + "; the camera has " + short_number(low) + " to " +
           short_number(high);
  }

  dc1394camera_t* camera_;
  dc1394feature_t id_;
  dc1394feature_info_t info_{};
};

}  // namespace

void set_features(const OpenCamera& camera, const IidcSettings& settings, std::vector<std::string>& refused) {
  for (std::size_t i = 0; i < kFeatureIds.size(); ++i) {
    const FeatureText& feature = kFeatureTexts[i];
    const std::optional<FeatureWish> wish = parse(feature, settings);
    if (!wish || wish->kind == FeatureWish::Kind::keep) continue;
    if (const Refusal refusal = Feature(camera.get(), kFeatureIds[i]).set(*wish))
      refused.push_back(std::string(feature.name) + " \"" + settings.*feature.text + "\": " + *refusal);
  }
}

}  // namespace azimuth::iidc
