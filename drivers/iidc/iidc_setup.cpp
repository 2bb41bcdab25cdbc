#include "drivers/iidc/iidc_setup.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <span>
#include <tuple>

#include "drivers/iidc/iidc_modes.hpp"

namespace azimuth::iidc {
namespace {

constexpr int kFastestLegacy_mbps = 400;

/// Performs the steps in order.
class ImageSetter {
 public:
  explicit ImageSetter(SetupWork work) : work_(std::move(work)) {}

  std::optional<ImageSetup> set() {
    if (!stop_transmission() || !set_speed() || !list_modes() || !choose_mode()) return std::nullopt;
    if (!work_.check(dc1394_video_set_mode(work_.handle(), mode_), "setting mode " + mode_name(mode_)))
      return std::nullopt;
    if (!(is_format7(mode_) ? set_up_region(work_, mode_) : use_fixed_mode())) return std::nullopt;
    if (!is_valid(work_.setup.format))
      return work_.refuse("gives images that cannot be: " + size_text(), EINVAL), std::nullopt;
    return std::move(work_.setup);
  }

 private:
  std::string size_text() const {
    return std::to_string(work_.setup.format.width_px) + "x" + std::to_string(work_.setup.format.height_px);
  }

  /// Stops the transmission. A camera continues to send after the program that started it has crashed, and accepts no
  /// settings meanwhile.
  bool stop_transmission() {
    dc1394switch_t sending = DC1394_OFF;
    if (!work_.check(dc1394_video_get_transmission(work_.handle(), &sending), "asking whether it sends")) return false;
    return sending == DC1394_OFF ||
           work_.check(dc1394_video_set_transmission(work_.handle(), DC1394_OFF), "stopping it");
  }

  /// Sets the bus speed. A failure is reported, but does not keep the camera from being used.
  bool set_speed() {
    const int wish_mbps = work_.settings.iso_speed_mbps;
    if (work_.camera.on_usb || wish_mbps == 0) return true;
    const bool legacy = wish_mbps <= kFastestLegacy_mbps;
    dc1394error_t error = DC1394_SUCCESS;
    if (work_.handle()->bmode_capable != DC1394_FALSE)
      error = dc1394_video_set_operation_mode(work_.handle(),
                                              legacy ? DC1394_OPERATION_MODE_LEGACY : DC1394_OPERATION_MODE_1394B);
    else if (!legacy)
      error = DC1394_FUNCTION_NOT_SUPPORTED;
    const int power = static_cast<int>(std::lround(std::log2(wish_mbps / 100.0)));
    if (error == DC1394_SUCCESS)
      error = dc1394_video_set_iso_speed(work_.handle(), static_cast<dc1394speed_t>(DC1394_ISO_SPEED_MIN + power));
    if (error != DC1394_SUCCESS)
      work_.tell("iso_speed_mbps " + std::to_string(wish_mbps) + ": " + dc1394_error_get_string(error));
    return true;
  }

  bool list_modes() {
    if (!work_.check(dc1394_video_get_supported_modes(work_.handle(), &modes_), "asking for its modes")) return false;
    modes_.num = std::min<std::uint32_t>(modes_.num, DC1394_VIDEO_MODE_NUM);
    return true;
  }
  std::span<const dc1394video_mode_t> modes() const { return {modes_.modes, modes_.num}; }
  std::string mode_names() const {
    std::string names;
    for (const dc1394video_mode_t mode : modes())
      if (!mode_name(mode).empty()) names += (names.empty() ? "" : ", ") + mode_name(mode);
    return names.empty() ? "none" : names;
  }

  bool choose_mode() {
    if (work_.settings.mode == "auto") return choose_best_mode();
    const auto wish = mode_named(work_.settings.mode);
    if (!wish || std::ranges::find(modes(), *wish) == modes().end())
      return work_.refuse("does not have mode " + work_.settings.mode + ", but " + mode_names(), EINVAL);
    const auto fixed = fixed_mode(*wish);
    if (fixed && !is_readable(fixed->coding))
      return work_.refuse("mode " + work_.settings.mode + " has pixels that we cannot read", ENOTSUP);
    mode_ = *wish;
    return true;
  }

  /// Prefers modes of fixed size to Format 7, because they have a rate. The first mode of Format 7 covers the whole
  /// sensor.
  bool choose_best_mode() {
    using Merit = std::tuple<bool, int, int>;  // fast enough, pixels, preference of the coding
    std::optional<Merit> best;
    for (const dc1394video_mode_t mode : modes()) {
      const auto fixed = wants_region() ? std::nullopt : fixed_mode(mode);
      if (!fixed || !is_readable(fixed->coding) || !is_wished_size(*fixed)) continue;
      const Merit candidate{reaches_rate(mode), fixed->width_px * fixed->height_px,
                            preference(fixed->coding, work_.settings.wants_colour)};
      if (best && candidate <= *best) continue;
      best = candidate;
      mode_ = mode;
    }
    if (best) return true;
    const auto format7 = std::ranges::find_if(modes(), is_format7);
    if (format7 == modes().end()) return work_.refuse("has no mode that fits; it has " + mode_names(), EINVAL);
    mode_ = *format7;
    return true;
  }
  bool wants_region() const {
    return work_.settings.left_px > 0 || work_.settings.top_px > 0 || work_.settings.colour_coding != "auto";
  }
  bool is_wished_size(const FixedMode& mode) const {
    return (work_.settings.width_px == 0 || work_.settings.width_px == mode.width_px) &&
           (work_.settings.height_px == 0 || work_.settings.height_px == mode.height_px);
  }
  bool reaches_rate(dc1394video_mode_t mode) const {
    dc1394framerates_t rates{};
    if (dc1394_video_get_supported_framerates(work_.handle(), mode, &rates) != DC1394_SUCCESS) return false;
    const std::span all(rates.framerates, std::min<std::size_t>(rates.num, DC1394_FRAMERATE_NUM));
    return std::ranges::any_of(
        all, [&](auto rate) { return rate_hz_of(rate) >= work_.settings.rate_hz * (1 - SetupWork::kSameRate); });
  }

  bool use_fixed_mode() {
    const FixedMode fixed = *fixed_mode(mode_);
    work_.setup.format = packed_format(*pixels_of(fixed.coding), fixed.width_px, fixed.height_px);
    if (!is_wished_size(fixed))
      work_.tell("width_px and height_px: mode " + mode_name(mode_) + " has " + size_text() + " only");
    if (wants_region()) work_.tell("left_px, top_px and colour_coding: only Format 7 has them");
    return set_fixed_rate();
  }

  /// Sets the mode's rate that is nearest to the requested one, or the fastest.
  bool set_fixed_rate() {
    dc1394framerates_t rates{};
    if (!work_.check(dc1394_video_get_supported_framerates(work_.handle(), mode_, &rates), "asking for its rates"))
      return false;
    const std::span all(rates.framerates, std::min<std::size_t>(rates.num, DC1394_FRAMERATE_NUM));
    const double wish_hz = work_.settings.rate_hz > 0 ? work_.settings.rate_hz : rate_hz_of(DC1394_FRAMERATE_MAX);
    const auto nearest =
        std::ranges::min_element(all, {}, [&](auto rate) { return std::abs(rate_hz_of(rate) - wish_hz); });
    if (nearest == all.end()) return work_.refuse("has no rate for mode " + mode_name(mode_), EINVAL);
    if (!work_.check(dc1394_video_set_framerate(work_.handle(), *nearest), "setting its rate")) return false;
    dc1394framerate_t is = *nearest;
    if (!work_.check(dc1394_video_get_framerate(work_.handle(), &is), "asking for its rate")) return false;
    work_.setup.rate_hz = rate_hz_of(is);
    work_.compare_rate();
    return true;
  }

  SetupWork work_;
  dc1394video_modes_t modes_{};
  dc1394video_mode_t mode_ = DC1394_VIDEO_MODE_MIN;
};

}  // namespace

std::optional<ImageSetup> set_up_image(const OpenCamera& camera, const IidcSettings& settings, CameraTrouble& trouble) {
  return ImageSetter({camera, settings, trouble}).set();
}

}  // namespace azimuth::iidc
