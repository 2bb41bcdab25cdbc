#pragma once
#include <string>

namespace azimuth {

/// The IIDC camera to use, and its settings. A setting that the camera refuses is reported once it is open
/// (StreamDescription::refused). A mode or size that the camera does not have keeps it from being opened.
///
/// Features are texts: "keep" leaves the camera's setting, "auto" lets the camera decide, "off" switches the feature
/// off if that is possible. A whole number is the value of the camera's register. A number with a unit is an absolute
/// value ("4 ms", "6.5 dB"), which not every camera supports. White balance takes two numbers, blue (U) and red (V):
/// "512 480".
struct IidcSettings {
  std::string guid;  ///< 16 hexadecimal digits; empty: the camera with the lowest GUID

  // Image.
  /// E.g. "640x480_mono8" or "format7_0"; auto: the mode that fits the other settings best.
  std::string mode = "auto";
  int width_px = 0;                    ///< 0: as large as the mode allows
  int height_px = 0;                   ///< 0: as large as the mode allows
  int left_px = 0;                     ///< left edge of the region of interest; only Format 7
  int top_px = 0;                      ///< top edge of the region of interest; only Format 7
  std::string colour_coding = "auto";  ///< for Format 7: auto, mono8, yuv422, rgb8 or raw8
  bool wants_colour = true;            ///< preference of auto between modes of the same image size

  // Bus.
  double rate_hz = 0.0;      ///< images per second; 0: the mode's fastest, in Format 7 as the camera recommends
  int packet_bytes = 0;      ///< for Format 7; 0: as rate_hz requires
  int iso_speed_mbps = 400;  ///< for FireWire: 100, 200, 400 or 800; 0: unchanged
  int dma_buffers = 8;       ///< frames that may wait in libdc1394 before one is lost

  // Features.
  std::string brightness = "keep";
  std::string exposure = "keep";
  std::string shutter = "keep";
  std::string gain = "keep";
  std::string focus = "keep";
  std::string white_balance = "keep";
  std::string gamma = "keep";
  std::string sharpness = "keep";
};

}  // namespace azimuth
