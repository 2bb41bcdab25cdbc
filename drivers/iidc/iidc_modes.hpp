#pragma once
// Names of video modes and colour codings, and the image formats they correspond to. Internal to drivers/iidc. Thread
// contract: reentrant.

#include <dc1394/dc1394.h>
#include <optional>
#include <string>
#include <string_view>

#include "slam/sample/image.hpp"

namespace azimuth::iidc {

/// A video mode of fixed size.
struct FixedMode {
  dc1394video_mode_t mode;
  int width_px;
  int height_px;
  dc1394color_coding_t coding;
};

/// None for Format 7 and for modes that are not video.
std::optional<FixedMode> fixed_mode(dc1394video_mode_t mode);
bool is_format7(dc1394video_mode_t mode);

/// The name of a mode, e.g. "640x480_mono8" or "format7_0"; empty for a number that is not a video mode.
std::string mode_name(dc1394video_mode_t mode);
std::optional<dc1394video_mode_t> mode_named(std::string_view name);

/// The name of a coding, e.g. "mono8"; "coding N" for an unknown number.
std::string coding_name(dc1394color_coding_t coding);
std::optional<dc1394color_coding_t> coding_named(std::string_view name);

/// The pixel format of a coding. None for codings that are not supported (more than 8 bits, 4:1:1, 4:4:4), and for
/// raw8, whose pixels depend on the sensor's filter.
std::optional<PixelFormat> pixels_of(dc1394color_coding_t coding);
/// The pixel format of raw8 with this filter.
std::optional<PixelFormat> pixels_of(dc1394color_filter_t filter);
/// True: frames of this coding can become images.
bool is_readable(dc1394color_coding_t coding);

/// Preference among codings: the larger the better, 0 for unsupported ones. Colour comes before grey if colour is
/// wanted; among colour codings the one with the least bandwidth wins.
int preference(dc1394color_coding_t coding, bool wants_colour);

/// Images per second; 0 for a number that is not a frame rate.
double rate_hz_of(dc1394framerate_t rate);

}  // namespace azimuth::iidc
