#include "daemon/config/camera_sections.hpp"

namespace azimuth {

Section own_camera_section(OwnCameraSettings& camera) {
  return {"daemon.camera",
          "A camera that the daemon itself opens, of any kind.",
          {{"silent_s", &camera.driver.silent_s,
            "The daemon opens the camera anew when it sends no image for this time and for four of its intervals.",
            above_to(0, 600)},
           {"latency_s", &camera.latency_s, "Time from the middle of the exposure to the device's stamp.",
            from_to(-1, 1)}}};
}

Section v4l2_section(V4l2Settings& v4l2) {
  return {"daemon.v4l2",
          "A camera of the kernel's video interface (V4L2).",
          {{"device", &v4l2.device,
            "Camera to open: a path such as /dev/v4l/by-id/..., or a property that finds the camera at any node: "
            "serial:XYZ, usb:VVVV:PPPP[:SERIAL], card:NAME, or first."},
           {"width_px", &v4l2.width_px, "Width of the images, together with height_px; 0: as the rig says.",
            from_to(0, kMaxFrameSide_px)},
           {"height_px", &v4l2.height_px, "Height of the images, together with width_px; 0: as the rig says.",
            from_to(0, kMaxFrameSide_px)},
           {"rate_hz", &v4l2.rate_hz, "Images per second; 0: as the camera is set.", from_to(0, 1000)},
           {"exposure", &v4l2.exposure, "Exposure time: auto, keep, or a number in units of 0.1 ms."},
           {"gain", &v4l2.gain, "Gain: auto, keep, or a number in the camera's units."},
           {"white_balance", &v4l2.white_balance, "White balance: auto, keep, or a temperature in kelvin."},
           {"focus", &v4l2.focus, "Focus: auto, keep, or a number in the camera's units."},
           choice<PowerLine>("power_line", v4l2.power_line,
                             {{"keep", PowerLine::keep},
                              {"off", PowerLine::off},
                              {"50", PowerLine::hz50},
                              {"60", PowerLine::hz60},
                              {"auto", PowerLine::automatic}},
                             "Frequency of the lamps' flicker, in Hz.")}};
}

FileErrors check(const V4l2Settings& v4l2) {
  FileErrors violations;
  for (V4l2Problem& wrong : problems(v4l2))
    violations.push_back({std::string("daemon.v4l2.") + wrong.key, 0, std::move(wrong.text)});
  return violations;
}

}  // namespace azimuth
