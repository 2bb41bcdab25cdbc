#include "daemon/config/iidc_section.hpp"

#include "drivers/iidc/iidc_text.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

Section iidc_section(IidcSettings& iidc) {
  const Range side = from_to(0, kMaxFrameSide_px);
  return {
      "daemon.iidc",
      "An IIDC camera, on FireWire or USB (libdc1394).",
      {{"guid", &iidc.guid, "GUID of the camera, 16 hexadecimal digits; empty: the camera with the lowest GUID."},
       {"mode", &iidc.mode, "Video mode: auto, or a mode of IIDC such as 640x480_mono8 or format7_0."},
       {"width_px", &iidc.width_px,
        "Width of the images or of Format 7's region of interest, together with height_px; 0: as the rig says.", side},
       {"height_px", &iidc.height_px,
        "Height of the images or of Format 7's region of interest, together with width_px; 0: as the rig says.", side},
       {"left_px", &iidc.left_px, "Left edge of Format 7's region of interest.", side},
       {"top_px", &iidc.top_px, "Upper edge of Format 7's region of interest.", side},
       {"colour_coding", &iidc.colour_coding, "Colour coding of Format 7: auto, mono8, yuv422, rgb8 or raw8."},
       {"rate_hz", &iidc.rate_hz,
        "Images per second; 0: the mode's fastest rate, in Format 7 the rate that the camera recommends.",
        from_to(0, 1000)},
       {"brightness", &iidc.brightness, "Brightness: keep, auto, off, or a whole number in the camera's units."},
       {"exposure", &iidc.exposure,
        "Target of an automatic exposure: keep, auto, off, a whole number, or such as \"0.5 EV\"."},
       {"shutter", &iidc.shutter, "Shutter time: keep, auto, off, a whole number, or such as \"4 ms\"."},
       {"gain", &iidc.gain, "Gain: keep, auto, off, a whole number, or such as \"6 dB\"."},
       {"focus", &iidc.focus, "Focus: keep, auto, off, or a whole number in the camera's units."},
       {"white_balance", &iidc.white_balance,
        "White balance: keep, auto, off, or two numbers, blue and red, such as \"512 480\"."},
       {"gamma", &iidc.gamma, "Gamma: keep, auto, off, or a whole number in the camera's units."}}};
}

FileErrors check(const IidcSettings& iidc) {
  const auto problem = iidc::problem_of(iidc);
  if (!problem) return {};
  return {{"daemon.iidc." + std::string(problem->key), 0, problem->text}};
}

}  // namespace azimuth
