#include "daemon/config/can_section.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

#include "drivers/can/can_layout.hpp"

namespace azimuth {
namespace {

constexpr double kMostBits = 8.0 * static_cast<double>(CanFrame::kMostBytes);

std::vector<Key> wheel_keys(CanSettings& can) {
  return {
      everyday({"left", &can.left, "Signal of the left wheel: its counter or its speed."}),
      everyday({"right", &can.right, "Signal of the right wheel: its counter or its speed."}),
      {"left_reversed", &can.left_reversed, "The left signal falls when the robot drives forwards."},
      {"right_reversed", &can.right_reversed, "The right signal falls when the robot drives forwards."},
      everyday({"ticks_per_m", &can.ticks_per_m, "Units of the counters per metre of a wheel's way; 0: not given.",
                from_to(0, 1e9)}),
      choice<CanSpeedUnit>(
          "speed_unit", can.speed_unit,
          {{"m_per_s", CanSpeedUnit::m_per_s}, {"rpm", CanSpeedUnit::rpm}, {"rad_per_s", CanSpeedUnit::rad_per_s}},
          "Of the speeds' signals, once scaled. rpm and rad_per_s: of the wheel."),
      {"wheel_radius_m", &can.wheel_radius_m, "For speeds in rpm or rad_per_s; 0: not given.", from_to(0, 10)},
      everyday({"track_m", &can.track_m, "Between the wheels, for ticks and speeds; 0: not given.", from_to(0, 10)}),
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
  const Range bits = from_to(-1, 2147483647);
  return {
      {"battery", &can.battery, "Signal of the battery's volts; empty: none."},
      {"emergency_stop", &can.emergency_stop.signal, "Signal that says whether the robot is stopped."},
      {"emergency_stop_mask", &can.emergency_stop.mask, "Bits of the emergency stop's signal that count; -1: all.",
       bits},
      {"emergency_stop_value", &can.emergency_stop.value,
       "What those bits are when the robot is stopped; -1: anything but 0.", bits},
      {"bumper", &can.bumper.signal, "Signal that says whether a bumper is pressed."},
      {"bumper_mask", &can.bumper.mask, "Bits of the bumpers' signal that count; -1: all.", bits},
      {"bumper_value", &can.bumper.value, "What those bits are when a bumper is pressed; -1: anything but 0.", bits},
      {"charging", &can.charging.signal, "Signal that says whether the battery is charged."},
      {"charging_mask", &can.charging.mask, "Bits of the charger's signal that count; -1: all.", bits},
      {"charging_value", &can.charging.value, "What those bits are when the battery is charged; -1: anything but 0.",
       bits},
  };
}

std::vector<Key> limit_keys(CanSettings& can) {
  return {
      {"latency_s", &can.latency_s, "From the base's look at its wheels to the frame's arrival.", from_to(0, 1)},
      {"stale_s", &can.stale_s, "Odometry that has not come for so long counts as silent.", above_to(0, 60)},
      {"max_speed_m_s", &can.max_speed_m_s, "The fastest the robot can be; faster steps are not believed.",
       above_to(0, 20)},
      {"max_turn_rad_s", &can.max_turn_rad_s, "The fastest the robot can turn; faster turns are not believed.",
       above_to(0, 100)},
  };
}

std::vector<Key> bus_keys(CanSettings& can) {
  return {everyday({"interface", &can.interface,
                    "Network interface of the bus. It is to be set up and switched on elsewhere."}),
          everyday(path_key("dbc", can.dbc, "DBC file of the base. Empty: its signals are described below.")),
          everyday(choice<CanOdometryKind>(
              "odometry", can.odometry,
              {{"ticks", CanOdometryKind::ticks}, {"speeds", CanOdometryKind::speeds}, {"pose", CanOdometryKind::pose}},
              "What the base sends: counters or speeds of both wheels, or x, y and heading."))};
}

Section base_section(CanSettings& can) {
  return {
      "daemon.can",
      "A base on a CAN bus, which is only listened to. Its signals are named as in the DBC file, Message.Signal, or as "
      "in daemon.can.signal.",
      joined({bus_keys(can), wheel_keys(can), pose_keys(can), robot_keys(can), limit_keys(can)})};
}

std::vector<Key> signal_keys(CanSignalSettings& signal) {
  return {
      {"name", &signal.name, "By which the keys of [daemon.can] call the signal."},
      {"id", &signal.id, "Id of the frame that has the signal.", from_to(0, largest_can_id(true))},
      {"extended", &signal.extended, "The frame's id has 29 bits, not 11."},
      {"start_bit", &signal.start_bit,
       "Bit 0 is the lowest of byte 0, bit 8 the lowest of byte 1, as in DBC files: the lowest bit of an Intel number, "
       "the highest of a Motorola one.",
       from_to(0, kMostBits - 1)},
      {"length_bits", &signal.length_bits, "How many bits it has.", from_to(1, 64)},
      choice<CanByteOrder>("byte_order", signal.byte_order,
                           {{"intel", CanByteOrder::intel}, {"motorola", CanByteOrder::motorola}},
                           "intel: least significant byte first; motorola: most significant."),
      choice<CanNumber>("number", signal.number,
                        {{"unsigned", CanNumber::unsigned_integer},
                         {"signed", CanNumber::signed_integer},
                         {"float", CanNumber::ieee_float}},
                        "What the bits are."),
      {"scale", &signal.scale, "The value is scale times the number, plus the offset.", from_to(-1e12, 1e12)},
      {"offset", &signal.offset, "The value is scale times the number, plus this.", from_to(-1e12, 1e12)},
      {"multiplexer", &signal.multiplexer, "Name of the signal that says whether this one is in the frame."},
      {"multiplexer_value", &signal.multiplexer_value,
       "What the multiplexer's signal is when this one is in the frame.", from_to(0, 2147483647)},
  };
}

/// What is wrong with the last of some signals.
std::optional<std::string> signal_problem(std::span<const CanSignalSettings> signals) {
  const CanSignalSettings& last = signals.back();
  if (last.name.empty()) return "needs the key 'name'";
  if (std::ranges::count(signals, last.name, &CanSignalSettings::name) > 1)
    return fmt::format("\"{}\" is there twice", last.name);
  if (const auto problem = problem_of(described_signal(last))) return fmt::format("\"{}\": {}", last.name, *problem);
  return std::nullopt;
}

}  // namespace

std::vector<Section> can_sections(CanSettings& can) {
  return {base_section(can),
          list_section<CanSignalSettings>("daemon.can.signal", "A signal of the base, without a DBC file.", can.signals,
                                          signal_keys, signal_problem)};
}

}  // namespace azimuth
