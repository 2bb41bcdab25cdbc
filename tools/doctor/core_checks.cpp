// Checks whether the processor has enough cores, and whether threads run on the fast ones.

#include <charconv>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/doctor/checks.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

constexpr int kEnoughCores = 2;
constexpr double kEnoughMemory_mb = 250.0;

/// Parses a list such as "0-3,6".
std::vector<int> numbers_in_list(std::string_view list) {
  std::vector<int> numbers;
  const char *at = list.data(), *const end = at + list.size();
  while (at != end) {
    int first = 0;
    auto read = std::from_chars(at, end, first);
    if (read.ec != std::errc{}) break;
    int last = first;
    if (read.ptr != end && *read.ptr == '-') read = std::from_chars(read.ptr + 1, end, last);
    for (int number = first; number <= last; ++number) numbers.push_back(number);
    at = read.ptr == end ? end : read.ptr + 1;
  }
  return numbers;
}

std::string list_of(const std::vector<int>& numbers) { return fmt::format("{}", fmt::join(numbers, ", ")); }

/// CPUs that are online, by relative speed. A processor with one kind of cores has one entry.
using CoresBySpeed = std::map<std::int64_t, std::vector<int>>;

CoresBySpeed cores_of(const Machine& machine) {
  CoresBySpeed cores;
  const fs::path folder = machine.at("/sys/devices/system/cpu");
  for (const int cpu : numbers_in_list(first_line(folder / "online").value_or("")))
    cores[number_in(folder / fmt::format("cpu{}/cpu_capacity", cpu)).value_or(0)].push_back(cpu);
  return cores;
}

/// The board's name with a colon, such as "Raspberry Pi 4 Model B Rev 1.4: "; empty if unknown.
std::string board(const Machine& machine) {
  const std::string name = file_content(machine.at("/proc/device-tree/model")).value_or("");
  const std::string until_zero = name.substr(0, name.find('\0'));
  return until_zero.empty() ? "" : until_zero + ": ";
}

std::string described(const CoresBySpeed& cores) {
  const auto& fastest = cores.rbegin()->second;
  std::size_t count = 0;
  for (const auto& [speed, cpus] : cores) count += cpus.size();
  if (cores.size() == 1) return fmt::format("{} {}", count, count == 1 ? "core" : "cores");
  return fmt::format("{} cores, the fast ones are {}", count, list_of(fastest));
}

std::optional<std::string> misplaced(const CoresBySpeed& cores, const ThreadCpu& thread) {
  for (const auto& [speed, cpus] : cores) {
    if (std::ranges::find(cpus, thread.cpu) == cpus.end()) continue;
    if (speed == cores.rbegin()->first) return std::nullopt;
    return fmt::format("daemon.realtime.{} is {}, a slow core", thread.key, thread.cpu);
  }
  return fmt::format("daemon.realtime.{} is {}, and there is no such core", thread.key, thread.cpu);
}

}  // namespace

Finding check_cores(const Machine& machine, const std::vector<ThreadCpu>& threads) {
  const CoresBySpeed cores = cores_of(machine);
  if (cores.empty()) return {"cores", Verdict::unknown, "the system does not say how many cores there are", ""};
  const std::string found = board(machine) + described(cores);
  std::string complaints;
  for (const ThreadCpu& thread : threads)
    if (const auto complaint = misplaced(cores, thread)) complaints += "; " + *complaint;
  if (!complaints.empty()) return {"cores", Verdict::warning, found + complaints, "lscpu --extended"};
  if (cores.size() == 1 && static_cast<int>(cores.begin()->second.size()) < kEnoughCores)
    return {"cores", Verdict::warning, found + ": images and estimates wait for each other", "lscpu --extended"};
  return {"cores", Verdict::ok, found, ""};
}

Finding check_memory(const Machine& machine) {
  const std::string table = file_content(machine.at("/proc/meminfo")).value_or("");
  constexpr std::string_view kKey = "MemAvailable:";
  const std::size_t key = table.find(kKey);
  if (key == std::string::npos) return {"memory", Verdict::unknown, "the system does not say what memory is free", ""};
  const double free_mb = std::strtod(table.c_str() + key + kKey.size(), nullptr) * 1024.0 / 1e6;
  const std::string found = fmt::format("{:.0f} MB of memory are free", free_mb);
  if (free_mb >= kEnoughMemory_mb) return {"memory", Verdict::ok, found, ""};
  return {"memory", Verdict::warning,
          fmt::format("{}, and the daemon, which keeps all of its own, may want {:.0f} MB", found, kEnoughMemory_mb),
          "ps -eo rss,comm --sort=-rss | head"};
}

}  // namespace azimuth
