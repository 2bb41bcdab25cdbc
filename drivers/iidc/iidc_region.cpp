#include <algorithm>
#include <cerrno>
#include <cmath>
#include <span>

#include "drivers/iidc/iidc_modes.hpp"
#include "drivers/iidc/iidc_setup.hpp"

namespace azimuth::iidc {
namespace {

constexpr double kPacketsPerSecond = 8000.0;

class RegionSetter {
 public:
  RegionSetter(SetupWork& work, dc1394video_mode_t mode) : work_(work), mode_(mode) {}

  bool set() {
    dc1394color_coding_t coding = DC1394_COLOR_CODING_MONO8;
    Region region;
    if (!choose_coding(coding)) return false;
    // The coding is set first, because in some cameras the largest size and the units depend on it.
    if (!work_.check(dc1394_format7_set_color_coding(work_.handle(), mode_, coding), "setting its colour coding"))
      return false;
    if (!choose_region(coding, region)) return false;
    const auto as_int = [](std::uint32_t value) { return static_cast<std::int32_t>(value); };
    const std::int32_t packet = work_.settings.packet_bytes > 0 ? work_.settings.packet_bytes : DC1394_USE_RECOMMENDED;
    if (!work_.check(dc1394_format7_set_roi(work_.handle(), mode_, coding, packet, as_int(region.left),
                                            as_int(region.top), as_int(region.width), as_int(region.height)),
                     "setting its region of interest"))
      return false;
    if (!read_back_region(coding, region)) return false;
    return set_scalable_rate() && read_interval();
  }

 private:
  struct Region {
    std::uint32_t left = 0, top = 0, width = 0, height = 0;
    friend bool operator==(const Region&, const Region&) = default;
  };
  static std::string text(const Region& region) {
    return std::to_string(region.width) + "x" + std::to_string(region.height) + " at " + std::to_string(region.left) +
           ", " + std::to_string(region.top);
  }

  bool choose_coding(dc1394color_coding_t& coding) {
    dc1394color_codings_t codings{};
    if (!work_.check(dc1394_format7_get_color_codings(work_.handle(), mode_, &codings),
                     "asking for its colour codings"))
      return false;
    const std::span all(codings.codings, std::min<std::size_t>(codings.num, DC1394_COLOR_CODING_NUM));
    const auto wish = coding_named(work_.settings.colour_coding);  // none for "auto"
    const auto by_preference = [this](auto one) { return preference(one, work_.settings.wants_colour); };
    const auto chosen = wish ? std::ranges::find(all, *wish) : std::ranges::max_element(all, {}, by_preference);
    if (chosen != all.end() && is_readable(*chosen)) {
      coding = *chosen;
      return true;
    }
    std::string names;
    for (const dc1394color_coding_t one : all) names += (names.empty() ? "" : ", ") + coding_name(one);
    return work_.refuse(
        "mode " + mode_name(mode_) + " has no colour coding that fits; it has " + (names.empty() ? "none" : names),
        ENOTSUP);
  }

  /// Rounds the requested region to the camera's units.
  bool choose_region(dc1394color_coding_t coding, Region& region) {
    std::uint32_t max_width = 0, max_height = 0, unit_width = 0, unit_height = 0, unit_left = 0, unit_top = 0;
    if (!work_.check(dc1394_format7_get_max_image_size(work_.handle(), mode_, &max_width, &max_height),
                     "asking for its size"))
      return false;
    if (!work_.check(dc1394_format7_get_unit_size(work_.handle(), mode_, &unit_width, &unit_height),
                     "asking for its units"))
      return false;
    if (!work_.check(dc1394_format7_get_unit_position(work_.handle(), mode_, &unit_left, &unit_top),
                     "asking for its units"))
      return false;
    // The region must start at an even pixel, or the filter's colours would be exchanged.
    if (coding == DC1394_COLOR_CODING_RAW8) {
      unit_left = std::max(unit_left, 1U) * (unit_left % 2 + 1);
      unit_top = std::max(unit_top, 1U) * (unit_top % 2 + 1);
    }
    const IidcSettings& wish = work_.settings;
    const AxisChoice across = choose_axis(wish.width_px, wish.left_px, {max_width, unit_width, unit_left});
    const AxisChoice down = choose_axis(wish.height_px, wish.top_px, {max_height, unit_height, unit_top});
    region = {across.place, down.place, across.size, down.size};
    return true;
  }

  bool read_back_region(dc1394color_coding_t wished_coding, const Region& wished) {
    dc1394color_coding_t coding = wished_coding;
    Region is;
    std::uint32_t packet_bytes = 0;
    if (!work_.check(dc1394_format7_get_roi(work_.handle(), mode_, &coding, &packet_bytes, &is.left, &is.top, &is.width,
                                            &is.height),
                     "asking for its region of interest"))
      return false;
    if (coding != wished_coding) return work_.refuse("does not keep colour coding " + coding_name(wished_coding), EIO);
    if (is.width > kMaxFrameSide_px || is.height > kMaxFrameSide_px)
      return work_.refuse("gives images that cannot be: " + text(is), EINVAL);
    const auto pixels = pixels_in_region(coding);
    if (!pixels) return false;
    work_.setup.format = packed_format(*pixels, static_cast<int>(is.width), static_cast<int>(is.height));
    tell_region(wished, is);
    if (work_.settings.packet_bytes > 0 && packet_bytes != static_cast<std::uint32_t>(work_.settings.packet_bytes))
      work_.tell("packet_bytes " + std::to_string(work_.settings.packet_bytes) + ": is " +
                 std::to_string(packet_bytes));
    return true;
  }
  void tell_region(const Region& wished, const Region& is) {
    const auto differs = [](int setting, std::uint32_t value) {
      return setting > 0 && static_cast<std::uint32_t>(setting) != value;
    };
    if (is != wished || differs(work_.settings.width_px, is.width) || differs(work_.settings.height_px, is.height) ||
        differs(work_.settings.left_px, is.left) || differs(work_.settings.top_px, is.top))
      work_.tell("region of interest: is " + text(is));
  }

  std::optional<PixelFormat> pixels_in_region(dc1394color_coding_t coding) {
    if (coding != DC1394_COLOR_CODING_RAW8) return pixels_of(coding);
    dc1394color_filter_t filter{};
    if (!work_.check(dc1394_format7_get_color_filter(work_.handle(), mode_, &filter), "asking for its colour filter"))
      return std::nullopt;
    const auto pixels = pixels_of(filter);
    if (!pixels) work_.refuse("does not say which colour filter it has", ENOTSUP);
    return pixels;
  }

  /// Sets the rate by the camera's own feature if it has one, otherwise by the size of packets, which are sent at a
  /// fixed rate.
  bool set_scalable_rate() {
    if (work_.settings.rate_hz <= 0) return true;
    dc1394feature_info_t info{};
    info.id = DC1394_FEATURE_FRAME_RATE;
    if (dc1394_feature_get(work_.handle(), &info) == DC1394_SUCCESS && info.available != DC1394_FALSE &&
        info.absolute_capable != DC1394_FALSE && set_rate_feature())
      return true;
    // The rate is compared once the interval is known.
    if (work_.settings.packet_bytes > 0 || work_.camera.on_usb) return true;
    std::uint32_t unit_bytes = 0, max_bytes = 0;
    if (!work_.check(dc1394_format7_get_packet_parameters(work_.handle(), mode_, &unit_bytes, &max_bytes),
                     "asking for its packets"))
      return false;
    const std::uint32_t bytes =
        packet_bytes_for(work_.settings.rate_hz, work_.setup.format.bytes(), unit_bytes, max_bytes);
    return work_.check(dc1394_format7_set_packet_size(work_.handle(), mode_, bytes), "setting its packets");
  }
  bool set_rate_feature() {
    dc1394camera_t* const camera = work_.handle();
    float is_hz = 0.0F;
    if (dc1394_feature_set_power(camera, DC1394_FEATURE_FRAME_RATE, DC1394_ON) != DC1394_SUCCESS) return false;
    if (dc1394_feature_set_mode(camera, DC1394_FEATURE_FRAME_RATE, DC1394_FEATURE_MODE_MANUAL) != DC1394_SUCCESS ||
        dc1394_feature_set_absolute_control(camera, DC1394_FEATURE_FRAME_RATE, DC1394_ON) != DC1394_SUCCESS ||
        dc1394_feature_set_absolute_value(camera, DC1394_FEATURE_FRAME_RATE,
                                          static_cast<float>(work_.settings.rate_hz)) != DC1394_SUCCESS ||
        dc1394_feature_get_absolute_value(camera, DC1394_FEATURE_FRAME_RATE, &is_hz) != DC1394_SUCCESS)
      return false;
    work_.setup.rate_hz = static_cast<double>(is_hz);
    return true;
  }

  bool read_interval() {
    float interval_s = 0.0F;
    std::uint32_t packets = 0;
    if (work_.setup.rate_hz <= 0 && !work_.camera.on_usb &&
        dc1394_format7_get_packets_per_frame(work_.handle(), mode_, &packets) == DC1394_SUCCESS && packets > 0)
      work_.setup.rate_hz = kPacketsPerSecond / packets;
    // The interval that the camera reports includes its exposure time.
    if (dc1394_format7_get_frame_interval(work_.handle(), mode_, &interval_s) == DC1394_SUCCESS && interval_s > 0.0F &&
        std::isfinite(interval_s))
      work_.setup.rate_hz = 1.0 / static_cast<double>(interval_s);
    if (!std::isfinite(work_.setup.rate_hz) || work_.setup.rate_hz < 0) work_.setup.rate_hz = 0.0;
    work_.compare_rate();
    return true;
  }

  SetupWork& work_;
  dc1394video_mode_t mode_;
};

}  // namespace

bool set_up_region(SetupWork& work, dc1394video_mode_t mode) { return RegionSetter(work, mode).set(); }

AxisChoice choose_axis(int size_px, int place_px, const AxisLimits& limits) {
  const std::uint32_t unit = std::max(limits.size_unit, 1U), place_unit = std::max(limits.place_unit, 1U);
  const auto rounded = [](std::uint32_t value, std::uint32_t step) { return value - value % step; };
  const auto wish = [](int setting_px) { return static_cast<std::uint32_t>(std::max(setting_px, 0)); };
  AxisChoice choice;
  if (size_px > 0)
    choice.size = rounded(std::clamp(wish(size_px), std::min(unit, limits.largest), limits.largest), unit);
  // A requested size takes precedence over the place. Without one, the size is what the place leaves, at least one
  // unit.
  const std::uint32_t taken = std::min(limits.largest, std::max(choice.size, unit));
  choice.place = rounded(std::min(wish(place_px), limits.largest - taken), place_unit);
  if (size_px <= 0) choice.size = rounded(limits.largest - choice.place, unit);
  return choice;
}

std::uint32_t packet_bytes_for(double rate_hz, std::uint64_t image_bytes, std::uint32_t unit_bytes,
                               std::uint32_t max_bytes) {
  const double unit = std::max(unit_bytes, 1U);
  const double packets = std::max(1.0, std::floor(kPacketsPerSecond / rate_hz));
  const double units = std::ceil(std::ceil(static_cast<double>(image_bytes) / packets) / unit);
  const double most = std::max(1.0, std::floor(max_bytes / unit));
  return static_cast<std::uint32_t>(std::clamp(units, 1.0, most) * unit);
}

}  // namespace azimuth::iidc
