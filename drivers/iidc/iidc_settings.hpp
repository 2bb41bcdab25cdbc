#pragma once
#include <string>

namespace azimuth {

/// Which IIDC camera, and how it shall take images. What the camera cannot do is told once it is open
/// (StreamDescription::refused), except that a mode or size it does not have at all keeps it from being opened.
///
/// Features are texts: "keep" leaves the camera as it is, "auto" lets it decide, "off" switches the feature off where
/// that is possible, a whole number is the value of the camera's register, and a number with a unit an absolute value
/// ("4 ms", "6.5 dB"), which not every camera has. White balance takes two numbers, blue (U) and red (V): "512 480".
struct IidcSettings {
  std::string guid;  ///< 16 hexadecimal digits; empty: the camera with the lowest GUID

  // Image.
  std::string mode = "auto";           ///< such as "640x480_mono8" or "format7_0"; auto: what fits the rest best
  int width_px = 0;                    ///< 0: as large as the mode has it
  int height_px = 0;                   ///< likewise
  int left_px = 0;                     ///< of the region of interest; only Format 7
  int top_px = 0;                      ///< likewise
  std::string colour_coding = "auto";  ///< of Format 7: mono8, yuv422, rgb8 or raw8
  bool wants_colour = true;            ///< what auto prefers, between images of the same size

  // Bus.
  double rate_hz = 0.0;      ///< images per second; 0: the mode's fastest, in Format 7 as the camera recommends
  int packet_bytes = 0;      ///< of Format 7; 0: what rate_hz needs
  int iso_speed_mbps = 400;  ///< of FireWire: 100, 200, 400 or 800; 0: as it is
  int dma_buffers = 8;       ///< frames that may wait in libdc1394 before any is lost

  // Features.
  std::string brightness = "keep";
  std::string exposure = "keep";
  std::string shutter = "keep";
  std::string gain = "keep";
  std::string iris = "keep";
  std::string focus = "keep";
  std::string white_balance = "keep";
  std::string saturation = "keep";
  std::string gamma = "keep";
  std::string sharpness = "keep";
};

}  // namespace azimuth
