#pragma once
// Names of video modes and colour codings, and what of them is an image for us. Internal to drivers/iidc.
// Thread contract: reentrant.

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

/// Nothing for Format 7 and for modes that are no video.
std::optional<FixedMode> fixed_mode(dc1394video_mode_t mode);
bool is_format7(dc1394video_mode_t mode);

/// "640x480_mono8", "format7_0"; empty for a number that is no video mode.
std::string mode_name(dc1394video_mode_t mode);
std::optional<dc1394video_mode_t> mode_named(std::string_view name);

/// "mono8"; "coding N" for a number that is none.
std::string coding_name(dc1394color_coding_t coding);
std::optional<dc1394color_coding_t> coding_named(std::string_view name);

/// What a pixel is in memory. Nothing for codings that we cannot read: more than 8 bits, 4:1:1, 4:4:4; and for raw8,
/// whose pixels depend on the sensor's filter.
std::optional<PixelFormat> pixels_of(dc1394color_coding_t coding);
/// Of raw8.
std::optional<PixelFormat> pixels_of(dc1394color_filter_t filter);
/// Whether frames of it can become images.
bool is_readable(dc1394color_coding_t coding);

/// Order in which codings are chosen: the larger the better, 0 for unreadable ones. Colour goes before grey where it is
/// wanted, and of colours the one that needs least of the bus.
int preference(dc1394color_coding_t coding, bool wants_colour);

/// Images per second; 0 for a number that is no frame rate.
double rate_hz_of(dc1394framerate_t rate);

}  // namespace azimuth::iidc
