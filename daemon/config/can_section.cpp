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

std::vector<Section> can_sections(CanSettings& can) {
  return {base_section(can),
          list_section<CanSignalSettings>("daemon.can.signal", "A signal of the base, without a DBC file.", can.signals,
                                          signal_keys, signal_problem)};
}

}  // namespace azimuth
