#include "drivers/pioneer/robot_parameters.hpp"

#include <algorithm>
#include <array>

namespace azimuth::pioneer {
namespace {

struct Entry {
  std::string_view subclass;
  RobotParameters parameters;
};

constexpr RobotParameters counting_mm(double mm_per_unit) { return {.distance_m_per_unit = 0.001 * mm_per_unit}; }

// The factors that calibrated robots of each kind are known by. Pioneer 1 counts 1024 units a turn and has velocities
// in units of their own.
constexpr std::array kKnown{
    Entry{"p3dx-sh", counting_mm(1.0)},
    Entry{"p3at-sh", counting_mm(1.0)},
    Entry{"p3dx", counting_mm(0.485)},
    Entry{"p3at", counting_mm(0.465)},
    Entry{"p2dx", counting_mm(0.84)},
    Entry{"p2at", counting_mm(1.32)},
    Entry{"pion1m",
          {.distance_m_per_unit = 0.05066e-3, .velocity_m_s_per_unit = 2.5332e-3, .heading_units_per_turn = 1024.0}},
};
constexpr std::string_view kMillimetreController = "-sh";

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
  if (name.size() > kMillimetreController.size() && name.ends_with(kMillimetreController)) return counting_mm(1.0);
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
  return list + "and any other that ends in \"" + std::string(kMillimetreController) + "\"";
}

}  // namespace azimuth::pioneer
