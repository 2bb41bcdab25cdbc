#pragma once
// Settings to a camera that is about to take images as they say. Internal to drivers/iidc.
// Thread contract: reentrant, for different cameras.

#include <optional>
#include <string>
#include <vector>

#include "drivers/iidc/iidc_camera.hpp"
#include "slam/sample/image.hpp"

namespace azimuth::iidc {

/// What became of the settings.
struct ImageSetup {
  FrameFormat format{};
  double rate_hz = 0.0;              ///< 0: unknown
  std::vector<std::string> refused;  ///< settings not had, one sentence each
};

/// Mode, region of interest, rate and speed of the bus. Stops what a program before us has left running. Nothing: it
/// cannot be, and `trouble` says why.
std::optional<ImageSetup> set_up_image(const OpenCamera& camera, const IidcSettings& settings, CameraTrouble& trouble);

/// What a Format 7 mode allows along one axis, in pixels. Units of 0 count as 1.
struct AxisLimits {
  std::uint32_t largest = 0;
  std::uint32_t size_unit = 1;
  std::uint32_t place_unit = 1;
};
/// Both multiples of their units, and together within `largest`.
struct AxisChoice {
  std::uint32_t place = 0;
  std::uint32_t size = 0;
};
/// The wish rounded down to what is possible; size 0: as large as the place allows.
AxisChoice choose_axis(int size_px, int place_px, const AxisLimits& limits);

/// Bytes a packet must have for `rate_hz` images of `image_bytes` a second, with 8000 packets a second: a multiple of
/// `unit_bytes`, no more than `max_bytes`.
std::uint32_t packet_bytes_for(double rate_hz, std::uint64_t image_bytes, std::uint32_t unit_bytes,
                               std::uint32_t max_bytes);

}  // namespace azimuth::iidc
