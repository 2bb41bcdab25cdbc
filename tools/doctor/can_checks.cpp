#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/doctor/checks.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

constexpr const char* kCanCheck = "can";
constexpr std::int64_t kTypeCan = 280;  // ARPHRD_CAN

struct FoundCanInterface {
  std::string name;
  bool is_up = false;
  bool is_virtual = false;
  std::optional<std::int64_t> bit_rate;  ///< [bit/s]; nothing if unknown
  std::string state;                     ///< state of the controller, e.g. "BUS-OFF"; empty if unknown
};

/// A member of an object; null if it does not exist.
json member(const json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() ? *found : json();
}
std::string word(const json& value) { return value.is_string() ? value.get<std::string>() : ""; }

/// Adds details from the output of `ip -json -details link show`. The bit rate is not available in sysfs.
void add_details(const json& links, FoundCanInterface& found) {
  for (const json& link : links) {
    if (word(member(link, "ifname")) != found.name) continue;
    const json information = member(link, "linkinfo"), data = member(information, "info_data");
    const std::string kind = word(member(information, "info_kind"));
    found.is_virtual = kind == "vcan" || kind == "vxcan";
    found.state = word(member(data, "state"));
    for (const json& rate : {member(member(data, "bittiming"), "bitrate"), member(data, "bitrate")})
      if (rate.is_number_integer() && !found.bit_rate) found.bit_rate = rate.get<std::int64_t>();
  }
}

std::vector<FoundCanInterface> can_interfaces(const Machine& machine) {
  std::vector<FoundCanInterface> all;
  for (const fs::path& folder : entries(machine.at("/sys/class/net"), "")) {
    if (number_in(folder / "type") != kTypeCan) continue;
    const bool is_up = (number_in(folder / "flags", 16).value_or(0) & kInterfaceUp) != 0;
    all.push_back({.name = folder.filename().string(), .is_up = is_up, .is_virtual = {}, .bit_rate = {}, .state = {}});
  }
  if (all.empty() || !machine.run) return all;
  const auto outcome = machine.run({"ip", "-json", "-details", "link", "show"});
  const json links = outcome ? json::parse(outcome->output, nullptr, false) : json();
  if (!links.is_array()) return all;
  for (FoundCanInterface& found : all) add_details(links, found);
  return all;
}

std::string described(const FoundCanInterface& found) {
  const std::string rate = found.is_virtual ? "virtual"
                           : found.bit_rate ? fmt::format("{} bit/s", *found.bit_rate)
                                            : "bit rate not known";
  return fmt::format("{} is {}, {}{}", found.name, found.is_up ? "up" : "down", rate,
                     found.state.empty() || !found.is_up ? "" : ", " + found.state);
}

std::string switch_on(const FoundCanInterface& found) {
  const std::string up = fmt::format("sudo ip link set {} up", found.name);
  if (found.is_virtual || found.bit_rate) return up;
  return fmt::format("sudo ip link set {} type can bitrate 500000 restart-ms 100  # the bit rate is the base's\n{}",
                     found.name, up);
}

/// Checks an interface that is used or may be used. `when_down`: verdict if the interface is down.
Finding check_interface(const FoundCanInterface& found, Verdict when_down) {
  const std::string what = described(found);
  if (!found.is_up) return {kCanCheck, when_down, what, switch_on(found)};
  if (found.state == "BUS-OFF")
    return {kCanCheck, Verdict::warning, what + ": it takes no part in the bus until it is started again",
            fmt::format("sudo ip link set {} type can restart  # by itself: restart-ms 100", found.name)};
  if (found.state == "ERROR-PASSIVE" || found.state == "ERROR-WARNING")
    return {kCanCheck, Verdict::warning, what + ": many errors, as of a wrong bit rate, a loose wire or no terminator",
            fmt::format("ip -details -statistics link show {}", found.name)};
  return {kCanCheck, Verdict::ok, what, ""};
}

Finding check_wanted(const std::vector<FoundCanInterface>& all, const std::string& name) {
  const auto found = std::ranges::find(all, name, &FoundCanInterface::name);
  if (found != all.end()) return check_interface(*found, Verdict::error);
  if (name.starts_with("vcan"))
    return {kCanCheck, Verdict::error, fmt::format("the configured CAN interface, {}, is not there", name),
            fmt::format("sudo ip link add {0} type vcan && sudo ip link set {0} up", name)};
  return {kCanCheck, Verdict::error,
          fmt::format("the configured CAN interface, {}, is not there: no adapter is plugged in, its driver is not "
                      "loaded, or it has another name",
                      name),
          "ip -brief -details link show\nsudo dmesg | grep -i can | tail"};
}

}  // namespace

Findings check_can(const Machine& machine, const Plan& plan) {
  const std::vector<FoundCanInterface> all = can_interfaces(machine);
  Findings findings;
  if (plan.can_interface) findings.push_back(check_wanted(all, *plan.can_interface));
  for (const FoundCanInterface& found : all) {
    if (found.name == plan.can_interface) continue;
    const bool may_be_meant = !plan.can_interface && plan.devices.empty() && plan.wants_serial;
    findings.push_back(may_be_meant ? check_interface(found, Verdict::warning)
                                    : Finding{kCanCheck, Verdict::ok, described(found) + "; it is not used", ""});
  }
  if (findings.empty())
    findings.push_back({kCanCheck, Verdict::ok, "there is no CAN interface, and none is configured", ""});
  return findings;
}

}  // namespace azimuth
