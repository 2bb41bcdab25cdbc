#include "daemon/config/device_sections.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>
#include <string>

#include "drivers/can/can_layout.hpp"
#include "drivers/iidc/iidc_text.hpp"
#include "drivers/lcm/lcm_address.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/event_codec.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {
namespace {

bool is_own_channel(const std::string& name, const PublishSettings& publish) {
  std::vector<std::string_view> own{channel::kPose,   channel::kBotPose, channel::kMapChunk, channel::kPath,
                                    channel::kStatus, channel::kPicture, channel::kKept};
  if (publish.echo_samples)
    own.insert(own.end(), {channel::kOdometry, channel::kBearings, channel::kFeatures, channel::kSightings,
                           channel::kExpected, channel::kDocument});
  return std::ranges::any_of(own,
                             [&](std::string_view each) { return name == publish.channel_prefix + std::string(each); });
}

constexpr double kMostBits = 8.0 * static_cast<double>(CanFrame::kMostBytes);

std::vector<Key> wheel_keys(CanSettings& can) {
  return {
      {"left", &can.left, "Signal of the left wheel: its counter or its speed."},
      {"right", &can.right, "Signal of the right wheel: its counter or its speed."},
      {"left_reversed", &can.left_reversed, "The left signal falls when the robot drives forwards."},
      {"right_reversed", &can.right_reversed, "The right signal falls when the robot drives forwards."},
      {"ticks_per_m", &can.ticks_per_m, "Counter units per metre that a wheel rolls; 0: not given.", from_to(0, 1e9)},
      choice<CanSpeedUnit>(
          "speed_unit", can.speed_unit,
          {{"m_per_s", CanSpeedUnit::m_per_s}, {"rpm", CanSpeedUnit::rpm}, {"rad_per_s", CanSpeedUnit::rad_per_s}},
          "Unit of the speed signals, once scaled. rpm and rad_per_s are rates of the wheel."),
      {"wheel_radius_m", &can.wheel_radius_m, "Radius of the wheels, for speeds in rpm or rad_per_s; 0: not given.",
       from_to(0, 10)},
      {"track_m", &can.track_m, "Distance between the wheels, for ticks and speeds; 0: not given.", from_to(0, 10)},
  };
}

std::vector<Key> pose_keys(CanSettings& can) {
  return {
      {"x", &can.x, "Signal of the pose's x."},
      {"y", &can.y, "Signal of the pose's y."},
      {"heading", &can.heading, "Signal of the pose's heading, counter-clockwise; it may wrap at a turn."},
      {"position_scale_m", &can.position_scale_m, "Metres per unit of x and y, once scaled.", above_to(0, 1e3)},
      {"heading_scale_rad", &can.heading_scale_rad,
       "Radians per unit of the heading, once scaled: 0.0174533 for degrees, negative when clockwise.",
       from_to(-1e3, 1e3)},
  };
}

std::vector<Key> robot_keys(CanSettings& can) {
  return {
      {"battery", &can.battery, "Signal of the battery's volts; empty: none."},
      {"emergency_stop", &can.emergency_stop, "Signal that is not 0 while the robot is stopped; empty: none."},
      {"bumper", &can.bumper, "Signal that is not 0 while a bumper is pressed; empty: none."},
      {"charging", &can.charging, "Signal that is not 0 while the battery is charged; empty: none."},
  };
}

std::vector<Key> limit_keys(CanSettings& can) {
  return {
      {"latency_s", &can.latency_s, "Time from the base's reading of its wheels to the frame's arrival.",
       from_to(0, 1)},
  };
}

std::vector<Key> bus_keys(CanSettings& can) {
  return {{"interface", &can.interface, "Network interface of the bus. The daemon does not set it up or switch it on."},
          path_key("dbc", can.dbc, "DBC file of the base. Empty: daemon.can.signal describes the base's signals."),
          choice<CanOdometryKind>(
              "odometry", can.odometry,
              {{"ticks", CanOdometryKind::ticks}, {"speeds", CanOdometryKind::speeds}, {"pose", CanOdometryKind::pose}},
              "Odometry that the base sends: counters or speeds of both wheels, or x, y and heading.")};
}

Section base_section(CanSettings& can) {
  return {"daemon.can",
          "A base on a CAN bus, to which the daemon only listens. The keys name signals as in the DBC file, "
          "Message.Signal, or as in daemon.can.signal.",
          joined({bus_keys(can), wheel_keys(can), pose_keys(can), robot_keys(can), limit_keys(can)})};
}

std::vector<Key> signal_keys(CanSignalSettings& signal) {
  return {
      {"name", &signal.name, "Name of the signal in the keys of [daemon.can]."},
      {"id", &signal.id, "Id of the frame that has the signal.", from_to(0, largest_can_id(true))},
      {"extended", &signal.extended, "The frame's id has 29 bits, not 11."},
      {"start_bit", &signal.start_bit,
       "Lowest bit of an Intel number, highest bit of a Motorola one, counted as in DBC files: bit 0 is the lowest of "
       "byte 0, bit 8 the lowest of byte 1.",
       from_to(0, kMostBits - 1)},
      {"length_bits", &signal.length_bits, "Number of the signal's bits.", from_to(1, 64)},
      choice<CanByteOrder>(
          "byte_order", signal.byte_order, {{"intel", CanByteOrder::intel}, {"motorola", CanByteOrder::motorola}},
          "Order of the bytes. intel: least significant byte first; motorola: most significant byte first."),
      choice<CanNumber>("number", signal.number,
                        {{"unsigned", CanNumber::unsigned_integer},
                         {"signed", CanNumber::signed_integer},
                         {"float", CanNumber::ieee_float}},
                        "Kind of number in the bits."),
      {"scale", &signal.scale, "Scale of the signal: the value is scale times the number, plus the offset.",
       from_to(-1e12, 1e12)},
      {"offset", &signal.offset, "Offset of the signal: the value is scale times the number, plus the offset.",
       from_to(-1e12, 1e12)},
      {"multiplexer", &signal.multiplexer,
       "Name of the multiplexer's signal, which says whether this one is in the frame."},
      {"multiplexer_value", &signal.multiplexer_value,
       "Value of the multiplexer's signal while this one is in the frame.", from_to(0, 2147483647)},
  };
}

/// Returns what is wrong with the last of `signals`; none: nothing.
std::optional<std::string> signal_problem(std::span<const CanSignalSettings> signals) {
  const CanSignalSettings& last = signals.back();
  if (last.name.empty()) return "needs the key 'name'";
  if (std::ranges::count(signals, last.name, &CanSignalSettings::name) > 1)
    return fmt::format("\"{}\" is there twice", last.name);
  if (const auto problem = problem_of(described_signal(last))) return fmt::format("\"{}\": {}", last.name, *problem);
  return std::nullopt;
}

}  // namespace

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

std::vector<Section> can_sections(CanSettings& can) {
  return {base_section(can),
          list_section<CanSignalSettings>("daemon.can.signal", "A signal of the base, without a DBC file.", can.signals,
                                          signal_keys, signal_problem)};
}

Section lcm_source_section(LcmSourceSettings& source) {
  return {"daemon.lcm_source",
          "Samples that another process sends over LCM, for daemon.live. The daemon believes everyone who can send to "
          "the group: for trusted networks only.",
          {{"url", &source.url, "Multicast group to listen to, udpm://GROUP:PORT."},
           {"frames_channel", &source.frames_channel, "Channel of images: image_t, as of bot_core."},
           {"odometry_channel", &source.odometry_channel,
            "Channel of odometry: odometry_t, or pose_t as of bot_core, in any frame that does not jump."},
           choice<LcmStampKind>(
               "stamps", source.stamps, {{"sender", LcmStampKind::sender}, {"receipt", LcmStampKind::receipt}},
               "Stamps of the samples. sender: the stamps in the messages, by this machine's clock; receipt: the time "
               "of arrival, for senders with another clock, or for a log that is played.")}};
}

FileErrors check(const LcmSourceSettings& source, const PublishSettings& publish) {
  FileErrors violations;
  const std::string section = "daemon.lcm_source.";
  const auto address = parse_lcm_url(source.url);
  if (!address)
    violations.push_back(
        {section + "url", 0, "is \"" + source.url + "\", must be udpm://GROUP:PORT, a multicast group"});
  const bool hears_itself = address && parse_lcm_url(publish.lcm_url) == address;
  const auto check_channel = [&](const char* key, const std::string& name) {
    if (name.empty() || name.size() > kMaxChannelLength)
      violations.push_back({section + key, 0, "must have 1 to " + std::to_string(kMaxChannelLength) + " characters"});
    if (hears_itself && is_own_channel(name, publish))
      violations.push_back({section + key, 0, "is \"" + name + "\", which the daemon itself sends on"});
  };
  check_channel("frames_channel", source.frames_channel);
  check_channel("odometry_channel", source.odometry_channel);
  if (source.frames_channel == source.odometry_channel)
    violations.push_back({section + "odometry_channel", 0, "is that of the frames"});
  return violations;
}

}  // namespace azimuth
