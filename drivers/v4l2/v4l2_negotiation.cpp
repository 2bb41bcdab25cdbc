#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <optional>

#include "drivers/v4l2/v4l2_setup.hpp"

namespace azimuth::v4l2 {
namespace {

/// Relative difference up to which two rates count as equal.
constexpr double kSameRate = 0.02;
/// Limits the loop for drivers that never end their list. No device has more entries.
constexpr std::uint32_t kMostListed = 256;

std::string size_text(const ImageLayout& layout) {
  return code_text(layout.code) + ' ' + std::to_string(layout.width_px) + 'x' + std::to_string(layout.height_px);
}

std::string rate_text(double rate_hz) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g Hz", rate_hz);
  return text.data();
}

/// The codes that the device lists, in the device's order.
std::vector<std::uint32_t> listed_formats(const Handle& handle, std::uint32_t buffer_type) {
  std::vector<std::uint32_t> codes;
  for (std::uint32_t i = 0; i < kMostListed; ++i) {
    v4l2_fmtdesc entry{};
    entry.index = i;
    entry.type = buffer_type;
    if (handle.call(VIDIOC_ENUM_FMT, entry) != 0) break;
    codes.push_back(entry.pixelformat);
  }
  return codes;
}

double rate_of(const v4l2_fract& interval) {
  return interval.numerator == 0 ? 0.0 : static_cast<double>(interval.denominator) / interval.numerator;
}

/// The fastest rate that the device lists; 0: it lists none.
double fastest_rate(const Handle& handle, std::uint32_t code, int width_px, int height_px) {
  double fastest = 0.0;
  for (std::uint32_t i = 0; i < kMostListed; ++i) {
    v4l2_frmivalenum entry{};
    entry.index = i;
    entry.pixel_format = code;
    entry.width = static_cast<std::uint32_t>(width_px);
    entry.height = static_cast<std::uint32_t>(height_px);
    if (handle.call(VIDIOC_ENUM_FRAMEINTERVALS, entry) != 0) break;
    if (entry.type != V4L2_FRMIVAL_TYPE_DISCRETE) return rate_of(entry.stepwise.min);
    fastest = std::max(fastest, rate_of(entry.discrete));
  }
  return fastest;
}

/// The supported formats of the device, best first.
std::vector<std::uint32_t> candidates(const Handle& handle, std::uint32_t buffer_type, const V4l2Settings& settings,
                                      const ImageLayout& wanted) {
  std::vector<std::uint32_t> codes = parse_formats(settings.formats).value_or(std::vector<std::uint32_t>{});
  if (codes.empty()) codes = preferred_formats(settings.wants_colour);
  const std::vector<std::uint32_t> listed = listed_formats(handle, buffer_type);
  std::erase_if(codes, [&](std::uint32_t code) { return std::ranges::find(listed, code) == listed.end(); });
  if (settings.rate_hz > 0.0) {
    // std::ranges is not used, because clang 14 cannot destructure its result.
    std::stable_partition(codes.begin(), codes.end(), [&](std::uint32_t code) {
      const double fastest = fastest_rate(handle, code, wanted.width_px, wanted.height_px);
      return fastest == 0.0 || fastest >= settings.rate_hz * (1.0 - kSameRate);
    });
  }
  return codes;
}

void add_word(std::string& words, const std::string& word) { words += (words.empty() ? "" : ", ") + word; }

/// The agreed rate; 0: the device cannot set a rate.
double agree_on_rate(const Handle& handle, std::uint32_t buffer_type, double wanted_hz,
                     std::vector<std::string>& refused) {
  v4l2_streamparm parameters{};
  parameters.type = buffer_type;
  const bool asks = handle.call(VIDIOC_G_PARM, parameters) == 0;
  v4l2_captureparm& capture = parameters.parm.capture;
  if (asks && wanted_hz > 0.0 && (capture.capability & V4L2_CAP_TIMEPERFRAME) != 0) {
    capture.timeperframe = {1000, static_cast<std::uint32_t>(std::lround(1000.0 * wanted_hz))};
    if (const int error = handle.call(VIDIOC_S_PARM, parameters))
      refused.push_back("does not take a rate: " + error_text(error));
  }
  const double rate_hz = asks ? rate_of(capture.timeperframe) : 0.0;
  if (wanted_hz > 0.0 && std::abs(rate_hz - wanted_hz) > kSameRate * wanted_hz)
    refused.push_back(rate_hz > 0.0 ? "runs at " + rate_text(rate_hz) + ", asked for " + rate_text(wanted_hz)
                                    : "does not say its rate, asked for " + rate_text(wanted_hz));
  return rate_hz;
}

}  // namespace

tl::expected<Agreement, CameraTrouble> negotiate(const Handle& handle, const Abilities& abilities,
                                                 const V4l2Settings& settings, std::vector<std::string>& refused) {
  v4l2_format present{};
  present.type = abilities.buffer_type;
  if (const int error = handle.call(VIDIOC_G_FMT, present))
    return tl::unexpected(handle.trouble("VIDIOC_G_FMT", error));
  ImageLayout wanted = layout_of(present);
  if (settings.width_px > 0) wanted.width_px = settings.width_px;
  if (settings.height_px > 0) wanted.height_px = settings.height_px;

  std::string offers;
  for (const std::uint32_t code : candidates(handle, abilities.buffer_type, settings, wanted)) {
    v4l2_format format = request_for(abilities.buffer_type, code, wanted.width_px, wanted.height_px);
    if (const int error = handle.call(VIDIOC_S_FMT, format)) {
      if (error != EINVAL) return tl::unexpected(handle.trouble("VIDIOC_S_FMT", error));
      continue;
    }
    const ImageLayout got = layout_of(format);
    const auto agreed = frame_format(got);
    if (!agreed || got.code != code || got.width_px != wanted.width_px || got.height_px != wanted.height_px) {
      add_word(offers, size_text(got));
      continue;
    }
    if (got.field != V4L2_FIELD_NONE && got.field != V4L2_FIELD_ANY) refused.emplace_back("gives interlaced images");
    return Agreement{*agreed, agree_on_rate(handle, abilities.buffer_type, settings.rate_hz, refused)};
  }
  if (offers.empty()) {
    for (const std::uint32_t code : listed_formats(handle, abilities.buffer_type)) add_word(offers, code_text(code));
    return tl::unexpected(
        handle.trouble("has none of the formats wanted, but " + (offers.empty() ? "none at all" : offers), 0));
  }
  return tl::unexpected(handle.trouble("gives no images of " + std::to_string(wanted.width_px) + 'x' +
                                       std::to_string(wanted.height_px) + " in a format that can be read, but " +
                                       offers));
}

}  // namespace azimuth::v4l2
