#include "drivers/iidc/iidc_modes.hpp"

#include <algorithm>
#include <array>

namespace azimuth::iidc {
namespace {

constexpr std::array kFixedModes{
    FixedMode{DC1394_VIDEO_MODE_160x120_YUV444, 160, 120, DC1394_COLOR_CODING_YUV444},
    FixedMode{DC1394_VIDEO_MODE_320x240_YUV422, 320, 240, DC1394_COLOR_CODING_YUV422},
    FixedMode{DC1394_VIDEO_MODE_640x480_YUV411, 640, 480, DC1394_COLOR_CODING_YUV411},
    FixedMode{DC1394_VIDEO_MODE_640x480_YUV422, 640, 480, DC1394_COLOR_CODING_YUV422},
    FixedMode{DC1394_VIDEO_MODE_640x480_RGB8, 640, 480, DC1394_COLOR_CODING_RGB8},
    FixedMode{DC1394_VIDEO_MODE_640x480_MONO8, 640, 480, DC1394_COLOR_CODING_MONO8},
    FixedMode{DC1394_VIDEO_MODE_640x480_MONO16, 640, 480, DC1394_COLOR_CODING_MONO16},
    FixedMode{DC1394_VIDEO_MODE_800x600_YUV422, 800, 600, DC1394_COLOR_CODING_YUV422},
    FixedMode{DC1394_VIDEO_MODE_800x600_RGB8, 800, 600, DC1394_COLOR_CODING_RGB8},
    FixedMode{DC1394_VIDEO_MODE_800x600_MONO8, 800, 600, DC1394_COLOR_CODING_MONO8},
    FixedMode{DC1394_VIDEO_MODE_1024x768_YUV422, 1024, 768, DC1394_COLOR_CODING_YUV422},
    FixedMode{DC1394_VIDEO_MODE_1024x768_RGB8, 1024, 768, DC1394_COLOR_CODING_RGB8},
    FixedMode{DC1394_VIDEO_MODE_1024x768_MONO8, 1024, 768, DC1394_COLOR_CODING_MONO8},
    FixedMode{DC1394_VIDEO_MODE_800x600_MONO16, 800, 600, DC1394_COLOR_CODING_MONO16},
    FixedMode{DC1394_VIDEO_MODE_1024x768_MONO16, 1024, 768, DC1394_COLOR_CODING_MONO16},
    FixedMode{DC1394_VIDEO_MODE_1280x960_YUV422, 1280, 960, DC1394_COLOR_CODING_YUV422},
    FixedMode{DC1394_VIDEO_MODE_1280x960_RGB8, 1280, 960, DC1394_COLOR_CODING_RGB8},
    FixedMode{DC1394_VIDEO_MODE_1280x960_MONO8, 1280, 960, DC1394_COLOR_CODING_MONO8},
    FixedMode{DC1394_VIDEO_MODE_1600x1200_YUV422, 1600, 1200, DC1394_COLOR_CODING_YUV422},
    FixedMode{DC1394_VIDEO_MODE_1600x1200_RGB8, 1600, 1200, DC1394_COLOR_CODING_RGB8},
    FixedMode{DC1394_VIDEO_MODE_1600x1200_MONO8, 1600, 1200, DC1394_COLOR_CODING_MONO8},
    FixedMode{DC1394_VIDEO_MODE_1280x960_MONO16, 1280, 960, DC1394_COLOR_CODING_MONO16},
    FixedMode{DC1394_VIDEO_MODE_1600x1200_MONO16, 1600, 1200, DC1394_COLOR_CODING_MONO16},
};

struct Coding {
  dc1394color_coding_t coding;
  std::string_view name;
  int preference;  // result of preference() when colour is wanted
};
constexpr std::array kCodings{
    Coding{DC1394_COLOR_CODING_MONO8, "mono8", 1},   Coding{DC1394_COLOR_CODING_YUV411, "yuv411", 0},
    Coding{DC1394_COLOR_CODING_YUV422, "yuv422", 4}, Coding{DC1394_COLOR_CODING_YUV444, "yuv444", 0},
    Coding{DC1394_COLOR_CODING_RGB8, "rgb8", 3},     Coding{DC1394_COLOR_CODING_MONO16, "mono16", 0},
    Coding{DC1394_COLOR_CODING_RGB16, "rgb16", 0},   Coding{DC1394_COLOR_CODING_MONO16S, "mono16s", 0},
    Coding{DC1394_COLOR_CODING_RGB16S, "rgb16s", 0}, Coding{DC1394_COLOR_CODING_RAW8, "raw8", 2},
    Coding{DC1394_COLOR_CODING_RAW16, "raw16", 0},
};

constexpr std::string_view kFormat7 = "format7_";

}  // namespace

std::optional<FixedMode> fixed_mode(dc1394video_mode_t mode) {
  const auto found = std::ranges::find(kFixedModes, mode, &FixedMode::mode);
  return found == kFixedModes.end() ? std::nullopt : std::optional(*found);
}

bool is_format7(dc1394video_mode_t mode) {
  return mode >= DC1394_VIDEO_MODE_FORMAT7_MIN && mode <= DC1394_VIDEO_MODE_FORMAT7_MAX;
}

std::string mode_name(dc1394video_mode_t mode) {
  if (is_format7(mode)) return std::string(kFormat7) + std::to_string(mode - DC1394_VIDEO_MODE_FORMAT7_MIN);
  const std::optional<FixedMode> fixed = fixed_mode(mode);
  if (!fixed) return {};
  return std::to_string(fixed->width_px) + "x" + std::to_string(fixed->height_px) + "_" + coding_name(fixed->coding);
}

std::optional<dc1394video_mode_t> mode_named(std::string_view name) {
  for (int number = DC1394_VIDEO_MODE_MIN; number <= DC1394_VIDEO_MODE_MAX; ++number) {
    const auto mode = static_cast<dc1394video_mode_t>(number);
    if (!name.empty() && mode_name(mode) == name) return mode;
  }
  return std::nullopt;
}

std::string coding_name(dc1394color_coding_t coding) {
  const auto found = std::ranges::find(kCodings, coding, &Coding::coding);
  return found == kCodings.end() ? "coding " + std::to_string(static_cast<int>(coding)) : std::string(found->name);
}

std::optional<dc1394color_coding_t> coding_named(std::string_view name) {
  const auto found = std::ranges::find(kCodings, name, &Coding::name);
  return found == kCodings.end() ? std::nullopt : std::optional(found->coding);
}

std::optional<PixelFormat> pixels_of(dc1394color_coding_t coding) {
  switch (coding) {
    case DC1394_COLOR_CODING_MONO8:
      return PixelFormat::gray8;
    case DC1394_COLOR_CODING_YUV422:
      return PixelFormat::uyvy;
    case DC1394_COLOR_CODING_RGB8:
      return PixelFormat::rgb8;
    default:
      return std::nullopt;
  }
}

std::optional<PixelFormat> pixels_of(dc1394color_filter_t filter) {
  switch (filter) {
    case DC1394_COLOR_FILTER_RGGB:
      return PixelFormat::bayer_rggb8;
    case DC1394_COLOR_FILTER_GBRG:
      return PixelFormat::bayer_gbrg8;
    case DC1394_COLOR_FILTER_GRBG:
      return PixelFormat::bayer_grbg8;
    case DC1394_COLOR_FILTER_BGGR:
      return PixelFormat::bayer_bggr8;
  }
  return std::nullopt;
}

bool is_readable(dc1394color_coding_t coding) { return preference(coding, true) > 0; }

int preference(dc1394color_coding_t coding, bool wants_colour) {
  constexpr int kFirst = 5;
  if (coding == DC1394_COLOR_CODING_MONO8 && !wants_colour) return kFirst;
  const auto found = std::ranges::find(kCodings, coding, &Coding::coding);
  return found == kCodings.end() ? 0 : found->preference;
}

double rate_hz_of(dc1394framerate_t rate) {
  if (rate < DC1394_FRAMERATE_MIN || rate > DC1394_FRAMERATE_MAX) return 0.0;
  return 1.875 * static_cast<double>(1 << (rate - DC1394_FRAMERATE_MIN));
}

}  // namespace azimuth::iidc
