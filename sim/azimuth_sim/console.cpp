#include "sim/azimuth_sim/console.hpp"

#include <fmt/format.h>
#include <variant>

#include "slam/geometry/angle.hpp"

namespace azimuth::sim {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::string help() {
  return "status                how things are\nquit                  end\nNAME[=VALUE]          a fault:\n" +
         fault_help();
}

}  // namespace

std::string status_text(Simulation& simulation, Stamp now) {
  SimulatedPioneer& pioneer = simulation.pioneer();
  const PioneerCounts& counts = pioneer.counts();
  const Pose2 pose = simulation.pose_in_world(now);
  return fmt::format(
      "t {:.1f} s, {} at ({:.2f}, {:.2f}) m, {:.0f} deg; {}, {} baud; {} commands, {} SIPs, {} lost, {} crowded out, "
      "{} reboots\n",
      to_seconds(now), simulation.rover().arrived() ? "arrived" : "driving", pose.x_m, pose.y_m,
      rad_to_degrees(pose.heading_rad), pioneer.firmware().in_session() ? "in session" : "no session",
      pioneer.firmware().baud(), pioneer.firmware().commands(), counts.sips, counts.lost_sips, counts.crowded_out,
      counts.reboots);
}

std::string Console::obey(std::string_view line, Stamp now) {
  const std::string_view command = trimmed(line);
  if (command.empty()) return "";
  if (command == "help") return help();
  if (command == "status") return status_text(simulation_, now);
  if (command == "quit") {
    quit_ = true;
    return "quitting\n";
  }
  const auto fault = parse_fault(command);
  if (!fault) return fault.error() + "\n";
  fault->apply(simulation_.pioneer());
  return fault->text() + "\n";
}

}  // namespace azimuth::sim
