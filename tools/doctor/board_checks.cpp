// Checks of the supply voltage and the cooling, the most frequent problems of small computers.

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <string>

#include "tools/doctor/checks.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

// Status bits of the Raspberry Pi firmware. Sixteen bits higher are the same bits accumulated since power-on.
constexpr std::int64_t kUnderVoltage = 0x1, kCapped = 0x2, kThrottled = 0x4, kSoftLimit = 0x8;
constexpr int kSinceStart = 16;
constexpr std::int64_t kSlowed = kCapped | kThrottled | kSoftLimit;

constexpr const char* kBetterSupply =
    "sudo dmesg | grep -i voltage\n# a supply of more current, a shorter cable; what draws much from a hub of its own";
constexpr const char* kBetterCooling = "grep . /sys/class/thermal/*/temp\n# a heat sink, a fan, air";

/// The status bits of the Raspberry Pi firmware, if the kernel's driver provides them.
std::optional<std::int64_t> firmware_bits(const Machine& machine) {
  const fs::path driver = machine.at("/sys/bus/platform/drivers/raspberrypi-firmware");
  for (const fs::path& device : entries(driver, "")) {
    if (const auto bits = number_in(device / "get_throttled", 16)) return bits;
  }
  return std::nullopt;
}

/// The undervoltage alarm of the same board, if the kernel provides a hardware monitor for it.
std::optional<bool> voltage_alarm(const Machine& machine) {
  for (const fs::path& sensor : entries(machine.at("/sys/class/hwmon"), "hwmon")) {
    if (first_line(sensor / "name") != "rpi_volt") continue;
    if (const auto alarm = number_in(sensor / "in0_lcrit_alarm")) return *alarm != 0;
  }
  return std::nullopt;
}

/// True if a cooling device throttles the processor: types "cpufreq-cpu0", "thermal-cpufreq-0" or "Processor".
bool slows_the_processor(const fs::path& cooling_device) {
  const std::string type = first_line(cooling_device / "type").value_or("");
  return type.find("cpufreq") != std::string::npos || type == "Processor";
}

bool is_slowed_by_heat(const Machine& machine) {
  const std::vector<fs::path> devices = entries(machine.at("/sys/class/thermal"), "cooling_device");
  return std::ranges::any_of(devices, [](const fs::path& device) {
    return slows_the_processor(device) && number_in(device / "cur_state").value_or(0) > 0;
  });
}

struct Zone {
  std::string name;
  double now_celsius = 0.0;
  double limit_celsius = 0.0;
};

/// The lowest temperature at which the kernel takes measures other than switching on a fan. Trip points of zero or less
/// are unset.
std::optional<double> lowest_limit_celsius(const fs::path& zone) {
  std::optional<double> lowest;
  for (int trip = 0;; ++trip) {
    const auto type = first_line(zone / fmt::format("trip_point_{}_type", trip));
    if (!type) return lowest;
    const std::int64_t millidegrees = number_in(zone / fmt::format("trip_point_{}_temp", trip)).value_or(0);
    if (*type == "active" || millidegrees <= 0) continue;
    const double celsius = static_cast<double>(millidegrees) / 1e3;
    lowest = std::min(lowest.value_or(celsius), celsius);
  }
}

/// The thermal zone with the least margin to its limit.
std::optional<Zone> hottest_zone(const Machine& machine) {
  std::optional<Zone> hottest;
  for (const fs::path& folder : entries(machine.at("/sys/class/thermal"), "thermal_zone")) {
    const auto millidegrees = number_in(folder / "temp");
    const auto trip = lowest_limit_celsius(folder);
    if (!millidegrees || !trip) continue;
    const Zone zone{first_line(folder / "type").value_or("?"), static_cast<double>(*millidegrees) / 1e3, *trip};
    if (!hottest || zone.limit_celsius - zone.now_celsius < hottest->limit_celsius - hottest->now_celsius)
      hottest = zone;
  }
  return hottest;
}

Finding by_temperature(const Machine& machine) {
  constexpr double kNear_celsius = 5.0;
  const std::optional<Zone> zone = hottest_zone(machine);
  if (!zone) return {"heat", Verdict::ok, "nothing slows the processor down", ""};
  const std::string found = fmt::format("{}: {:.0f} degrees of the {:.0f} that are allowed", zone->name,
                                        zone->now_celsius, zone->limit_celsius);
  if (zone->now_celsius < zone->limit_celsius - kNear_celsius) return {"heat", Verdict::ok, found, ""};
  return {"heat", Verdict::warning, found + ", where the processor is slowed down", kBetterCooling};
}

}  // namespace

Findings check_supply(const Machine& machine) {
  const std::optional<std::int64_t> bits = firmware_bits(machine);
  const std::optional<bool> alarm = voltage_alarm(machine);
  if (!bits && !alarm) return {};
  if (alarm.value_or(false) || (bits.value_or(0) & kUnderVoltage) != 0)
    return {{"supply", Verdict::warning, "the board's voltage is too low: it slows down, and USB devices drop out",
             kBetterSupply}};
  if ((bits.value_or(0) & (kUnderVoltage << kSinceStart)) != 0)
    return {{"supply", Verdict::warning,
             "the board's voltage has been too low since it was switched on: perhaps when motors start",
             kBetterSupply}};
  return {{"supply", Verdict::ok, "the board's voltage holds", ""}};
}

Finding check_heat(const Machine& machine) {
  const std::int64_t bits = firmware_bits(machine).value_or(0);
  // Undervoltage also throttles the processor, but is a finding of its own.
  const bool slowed_by_firmware = (bits & kSlowed) != 0 && (bits & kUnderVoltage) == 0;
  if (slowed_by_firmware || is_slowed_by_heat(machine))
    return {"heat", Verdict::warning, "the processor is slowed down because it is hot: steps take longer",
            kBetterCooling};
  const bool was_hot = (bits & (kSoftLimit << kSinceStart)) != 0;
  if (was_hot)
    return {"heat", Verdict::warning, "the processor has been slowed down by heat since it was switched on",
            kBetterCooling};
  return by_temperature(machine);
}

}  // namespace azimuth
