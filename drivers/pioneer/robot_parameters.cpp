#include "drivers/pioneer/robot_parameters.hpp"

#include <algorithm>
#include <array>

namespace azimuth::pioneer {
namespace {

struct Entry {
  std::string_view subclass;
  RobotParameters parameters;
};

constexpr RobotParameters counting(double mm_per_unit) { return {.distance_m_per_unit = 0.001 * mm_per_unit}; }

/// Pioneer 1 has 1024 units per turn, and its own units of velocity.
constexpr RobotParameters first_generation(double mm_per_unit) {
  return {
      .distance_m_per_unit = 0.001 * mm_per_unit, .velocity_m_s_per_unit = 2.5332e-3, .heading_units_per_turn = 1024.0};
}

constexpr RobotParameters amigo() {
  RobotParameters parameters = counting(0.5083);
  parameters.velocity_m_s_per_unit = 0.6154e-3;
  return parameters;
}

// The conversion factors of each kind of robot, as in ARIA and Player. Names that end in "-sh" are not listed.
constexpr std::array kKnown{
    Entry{"amigo", amigo()},
    Entry{"mt400", counting(1.0)},
    Entry{"p2at", counting(1.32)},
    Entry{"p2at8", counting(1.32)},
    Entry{"p2at8+", counting(0.465)},
    Entry{"p2ce", counting(0.826)},
    Entry{"p2d8", counting(0.485)},
    Entry{"p2d8+", counting(0.485)},
    Entry{"p2de", counting(0.969)},
    Entry{"p2df", counting(0.485)},
    Entry{"p2dx", counting(0.84)},
    Entry{"p2it", counting(1.136)},
    Entry{"p2pb", counting(0.424)},
    Entry{"p2pp", counting(0.485)},
    Entry{"p3at", counting(0.465)},
    Entry{"p3dx", counting(0.485)},
    Entry{"perfpb", counting(0.485)},
    Entry{"perfpb+", counting(0.485)},
    Entry{"pion1m", first_generation(0.05066)},
    Entry{"pion1x", first_generation(0.05066)},
    Entry{"pionat", first_generation(0.07)},
    Entry{"pioneer-lx", counting(1.0)},
    Entry{"powerbot", counting(0.5813)},
    Entry{"psos1m", first_generation(0.05066)},
    Entry{"psos1x", first_generation(0.05066)},
    Entry{"psos43m", first_generation(0.05066)},
    Entry{"researchpb", counting(1.0)},
    Entry{"seekur", counting(1.0)},
    Entry{"seekurjr", counting(1.0)},
};

/// True: the controller counts in millimetres. All controllers of the make "-sh" do, on any robot and with any
/// equipment: "p3dx-sh", "p3dx-sh-lms500".
bool counts_millimetres(std::string_view name) {
  constexpr std::string_view kMake = "-sh";
  return (name.size() > kMake.size() && name.ends_with(kMake)) || name.find("-sh-", 1) != std::string_view::npos;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

}  // namespace

std::optional<RobotParameters> find_robot_parameters(std::string_view subclass) {
  const std::string name = lower_case(subclass);
  const auto entry = std::ranges::find(kKnown, std::string_view(name), &Entry::subclass);
  if (entry != kKnown.end()) return entry->parameters;
  if (counts_millimetres(name)) return counting(1.0);
  return std::nullopt;
}

std::optional<RobotParameters> robot_parameters(const PioneerSettings& settings, std::string_view subclass) {
  auto parameters = find_robot_parameters(settings.subclass.empty() ? subclass : settings.subclass);
  if (settings.distance_mm_per_unit > 0.0) {
    if (!parameters) parameters.emplace();
    parameters->distance_m_per_unit = 0.001 * settings.distance_mm_per_unit;
  }
  if (parameters && settings.heading_units_per_turn > 0.0)
    parameters->heading_units_per_turn = settings.heading_units_per_turn;
  return parameters;
}

std::string known_subclasses() {
  std::string list;
  for (const Entry& entry : kKnown) list += std::string(entry.subclass) + ", ";
  return list + "and all with \"-sh\", as p3dx-sh";
}

}  // namespace azimuth::pioneer
