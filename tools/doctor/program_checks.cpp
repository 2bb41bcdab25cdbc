#include <fmt/format.h>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "tools/doctor/checks.hpp"

namespace azimuth {
namespace {

std::optional<ProgramOutcome> run(const Machine& machine, const std::vector<std::string>& command) {
  return machine.run ? machine.run(command) : std::nullopt;
}

std::string without_last_line_end(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

/// Extracts the warnings that the daemon prints for a valid configuration.
std::string warnings_in(const std::string& output) {
  constexpr std::string_view kWarning = "warning: ";
  std::string warnings;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(kWarning)) warnings += (warnings.empty() ? "" : "\n") + line.substr(kWarning.size());
  return warnings;
}

}  // namespace

Finding check_daemon_version(const Machine& machine, const std::string& own_version) {
  constexpr const char* kCheck = "version";
  const auto outcome = run(machine, {"azimuthd", "--version"});
  if (!outcome || outcome->exit_code != 0)
    return {kCheck, Verdict::error, "azimuthd cannot be started: it is not installed, or not on the PATH",
            "command -v azimuthd || echo \"$PATH\""};
  const std::string found = without_last_line_end(outcome->output);
  if (found == "azimuthd " + own_version) return {kCheck, Verdict::ok, found + ", like this program", ""};
  return {kCheck, Verdict::warning, fmt::format("{} beside azimuth {}: two installations", found, own_version),
          "command -v -a azimuthd azimuth"};
}

Finding check_configuration(const Machine& machine, const std::string& file) {
  constexpr const char* kCheck = "settings";
  if (file.empty())
    return {
        kCheck, Verdict::unknown,
        fmt::format("no configuration is given (--config FILE), and none is installed ({})", kInstalledConfiguration),
        ""};
  const std::string command = "azimuthd --check-config --config " + file;
  const auto outcome = run(machine, {"azimuthd", "--check-config", "--config", file});
  if (!outcome) return {kCheck, Verdict::unknown, file + ": azimuthd, which would check it, cannot be started", ""};
  if (outcome->exit_code == 0) {
    const std::string warnings = warnings_in(outcome->output);
    if (warnings.empty()) return {kCheck, Verdict::ok, file + " is right", ""};
    return {kCheck, Verdict::warning, warnings, command};
  }
  const std::string complaints = without_last_line_end(outcome->output);
  return {kCheck, Verdict::error, complaints.empty() ? file + " is refused" : complaints, command};
}

}  // namespace azimuth
