#include "daemon/config/daemon_settings.hpp"

#include <algorithm>
#include <array>

namespace azimuth {
namespace {

constexpr double kMaxCpu = 1023;         // CPU_SETSIZE - 1
constexpr double kMaxFifoPriority = 99;  // sched(7)

constexpr auto kProviders = std::to_array<std::string_view>({"udpm://", "tcpq://", "memq://", "file://"});
constexpr std::size_t kLongestPrefix = 40;  // LCM allows 63 for the whole channel

Section top_section(DaemonSettings& settings) {
  return {"daemon",
          "The daemon itself.",
          {choice<LogLevel>("log_level", settings.log_level,
                            {{"debug", LogLevel::debug},
                             {"info", LogLevel::info},
                             {"warning", LogLevel::warning},
                             {"error", LogLevel::error}},
                            "Least severity of what is logged.")}};
}

Section play_section(PlaySettings& play) {
  return {"daemon.play",
          "The source that plays a recording.",
          {{"run", &play.run, "Run folder or LCM log."},
           {"rig", &play.rig, "rig.toml to use instead of the recording's own."},
           {"speed", &play.speed, "Times the recording's own pace; 0: as fast as possible.", from_to(0, 1e6)},
           {"hold", &play.hold, "Keep running when the recording has ended."}}};
}

Section lcm_section(PublishSettings& publish) {
  return {"daemon.lcm",
          "What is published, where and how often.",
          {{"url", &publish.lcm_url, "LCM provider. ttl=0 keeps the messages on this machine."},
           {"channel_prefix", &publish.channel_prefix, "Put before every channel's name."},
           {"map_rate_hz", &publish.map_rate_hz, "How often the map is sent; 0: only at the end.", from_to(0, 100)},
           {"echo_samples", &publish.echo_samples, "Send odometry and bearings as well."},
           {"print_poses", &publish.print_poses, "Print a line for the pose of every step."}}};
}

Section realtime_section(DaemonSettings& settings) {
  ThreadSettings& threads = settings.threads;
  const Range priority = from_to(0, kMaxFifoPriority), cpu = from_to(-1, kMaxCpu);
  return {"daemon.realtime",
          "Scheduling. What the system refuses is reported, and the daemon runs without it.",
          {{"lock_memory", &settings.lock_memory, "Keep the whole process in memory (mlockall)."},
           {"source_fifo_priority", &threads.source.fifo_priority, "SCHED_FIFO priority; 0: none.", priority},
           {"estimator_fifo_priority", &threads.estimator.fifo_priority, "SCHED_FIFO priority; 0: none.", priority},
           {"publisher_fifo_priority", &threads.publisher.fifo_priority, "SCHED_FIFO priority; 0: none.", priority},
           {"source_cpu", &threads.source.cpu, "The only CPU the thread may run on; -1: any.", cpu},
           {"estimator_cpu", &threads.estimator.cpu, "The only CPU the thread may run on; -1: any.", cpu},
           {"publisher_cpu", &threads.publisher.cpu, "The only CPU the thread may run on; -1: any.", cpu},
           {"deadline_ms", &threads.deadline_ms,
            "A stage whose turn takes longer counts as hung and stops the watchdog from being fed.",
            from_to(200, 600000)}}};
}

}  // namespace

Violations check(const DaemonSettings& settings) {
  Violations violations;
  const auto provides = [&](std::string_view provider) { return settings.publish.lcm_url.starts_with(provider); };
  if (std::none_of(kProviders.begin(), kProviders.end(), provides)) {
    violations.push_back(
        {"daemon.lcm.url", 0, 0,
         "is \"" + settings.publish.lcm_url + "\", must begin with udpm://, tcpq://, memq:// or file://"});
  }
  if (settings.publish.channel_prefix.size() > kLongestPrefix) {
    violations.push_back(
        {"daemon.lcm.channel_prefix", 0, 0, "is longer than " + std::to_string(kLongestPrefix) + " characters"});
  }
  return violations;
}

std::vector<Section> daemon_sections(DaemonSettings& settings) {
  return {top_section(settings), play_section(settings.play), lcm_section(settings.publish),
          realtime_section(settings)};
}

}  // namespace azimuth
