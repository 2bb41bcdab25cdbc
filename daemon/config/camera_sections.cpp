#include "daemon/config/camera_sections.hpp"

namespace azimuth {

Section own_camera_section(OwnCameraSettings& camera) {
  return {"daemon.camera",
          "A camera that belongs to the daemon, of whatever kind.",
          {{"silent_s", &camera.driver.silent_s,
            "One that has sent no image for so long, and for four of its intervals, is opened anew.", above_to(0, 600)},
           {"first_image_s", &camera.driver.first_image_s,
            "A camera that has sent no first image for so long since it was opened is opened anew.", above_to(0, 600)},
           {"latency_s", &camera.latency_s, "From the middle of the exposure to the device's stamp.", from_to(-1, 1)}}};
}

Section v4l2_section(V4l2Settings& v4l2) {
  return {"daemon.v4l2",
          "A camera of the kernel's video interface (V4L2).",
          {everyday({"device", &v4l2.device,
                     "A path such as /dev/v4l/by-id/..., or what identifies it in whatever node: serial:XYZ, "
                     "usb:VVVV:PPPP[:SERIAL], "
                     "card:NAME, or first."}),
           everyday({"width_px", &v4l2.width_px, "With height_px; 0: as the rig says.", from_to(0, kMaxFrameSide_px)}),
           everyday({"height_px", &v4l2.height_px, "With width_px; 0: as the rig says.", from_to(0, kMaxFrameSide_px)}),
           everyday({"rate_hz", &v4l2.rate_hz, "Images per second; 0: as it is set.", from_to(0, 1000)}),
           {"formats", &v4l2.formats, "In order of preference, e.g. YUYV,MJPG; auto: whatever is read at least cost."},
           {"buffers", &v4l2.buffers, "Images the kernel may hold.", from_to(3, 32)},
           everyday({"exposure", &v4l2.exposure, "auto, keep, or a number in units of 0.1 ms."}),
           {"gain", &v4l2.gain, "auto, keep, or a number in the camera's units."},
           {"white_balance", &v4l2.white_balance, "auto, keep, or a temperature in kelvin."},
           {"focus", &v4l2.focus, "auto, keep, or a number in the camera's units."},
           choice<PowerLine>("power_line", v4l2.power_line,
                             {{"keep", PowerLine::keep},
                              {"off", PowerLine::off},
                              {"50", PowerLine::hz50},
                              {"60", PowerLine::hz60},
                              {"auto", PowerLine::automatic}},
                             "Frequency of the lamps' flicker, in Hz."),
           {"exposure_may_lower_rate", &v4l2.exposure_may_lower_rate,
            "Let an automatic exposure take longer in the dark than the rate allows."}}};
}

FileErrors check(const V4l2Settings& v4l2) {
  FileErrors violations;
  for (V4l2Problem& wrong : problems(v4l2))
    violations.push_back({std::string("daemon.v4l2.") + wrong.key, 0, std::move(wrong.text)});
  return violations;
}

}  // namespace azimuth
