#include "daemon/config/iidc_section.hpp"

#include "drivers/iidc/iidc_text.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

Section iidc_section(IidcSettings& iidc) {
  const Range side = from_to(0, kMaxFrameSide_px);
  return {
      "daemon.iidc",
      "An IIDC camera, on FireWire or USB (libdc1394).",
      {everyday({"guid", &iidc.guid, "16 hexadecimal digits; empty: the camera with the lowest."}),
       everyday({"mode", &iidc.mode, "auto, or a mode of IIDC such as 640x480_mono8 or format7_0."}),
       {"width_px", &iidc.width_px, "With height_px; of Format 7's region of interest. 0: as the rig says.", side},
       {"height_px", &iidc.height_px, "With width_px; 0: as the rig says.", side},
       {"left_px", &iidc.left_px, "Left edge of Format 7's region of interest.", side},
       {"top_px", &iidc.top_px, "Upper edge of Format 7's region of interest.", side},
       {"colour_coding", &iidc.colour_coding, "Colour coding of Format 7: auto, mono8, yuv422, rgb8 or raw8."},
       {"rate_hz", &iidc.rate_hz, "Images per second; 0: the mode's fastest, in Format 7 as the camera recommends.",
        from_to(0, 1000)},
       {"packet_bytes", &iidc.packet_bytes, "Packet size of Format 7; 0: what rate_hz needs.", from_to(0, 32768)},
       {"iso_speed_mbps", &iidc.iso_speed_mbps, "Speed of FireWire: 100, 200, 400 or 800; 0: as it is.",
        from_to(0, 800)},
       {"dma_buffers", &iidc.dma_buffers, "Images that may wait before any is lost.", from_to(2, 64)},
       {"brightness", &iidc.brightness, "keep, auto, off, or a whole number in the camera's units."},
       {"exposure", &iidc.exposure,
        "keep, auto, off, a whole number, or such as \"0.5 EV\": what an automatic exposure aims at."},
       everyday({"shutter", &iidc.shutter, "keep, auto, off, a whole number, or such as \"4 ms\"."}),
       {"gain", &iidc.gain, "keep, auto, off, a whole number, or such as \"6 dB\"."},
       {"iris", &iidc.iris, "keep, auto, off, or a whole number in the camera's units."},
       {"focus", &iidc.focus, "keep, auto, off, or a whole number in the camera's units."},
       {"white_balance", &iidc.white_balance, "keep, auto, off, or two numbers, blue and red, such as \"512 480\"."},
       {"saturation", &iidc.saturation, "keep, auto, off, or a whole number in the camera's units."},
       {"gamma", &iidc.gamma, "keep, auto, off, or a whole number in the camera's units."},
       {"sharpness", &iidc.sharpness, "keep, auto, off, or a whole number in the camera's units."}}};
}

FileErrors check(const IidcSettings& iidc) {
  const auto problem = iidc::problem_of(iidc);
  if (!problem) return {};
  return {{"daemon.iidc." + std::string(problem->key), 0, problem->text}};
}

}  // namespace azimuth
