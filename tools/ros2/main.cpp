// azimuth-ros2 publishes azimuthd's LCM messages for ROS 2. It is a separate process, and azimuthd does not know of it.

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <poll.h>
#include <string>
#include <sys/signalfd.h>

#include "base/clocks.hpp"
#include "base/unique_fd.hpp"
#include "base/visible.hpp"
#include "drivers/lcm/lcm_receiver.hpp"
#include "tools/ros2/bridge/bridge.hpp"
#include "tools/ros2/bridge/options.hpp"
#include "tools/ros2/dds_output.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = Bridge::Clock;

constexpr int kStopped = 0, kFailed = 1;
constexpr auto kTurnEvery = 100ms;

void tell(const std::string& sentence) {
  std::fprintf(stderr, "azimuth-ros2: %s\n", visible_lines(sentence).c_str());
  std::fflush(stderr);
}

/// Blocks SIGTERM and SIGINT, and returns a signalfd for them. To be called before the DDS library starts its threads,
/// which inherit the signal mask.
UniqueFd stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return UniqueFd(::signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC));
}

/// Runs until a signal arrives.
void run_bridge(LcmReceiver& receiver, Bridge& bridge, DdsOutput& output, int signals) {
  for (Clock::time_point next_turn = Clock::now();;) {
    pollfd ready[] = {{signals, POLLIN, 0}, {receiver.descriptor(), POLLIN, 0}};
    ::poll(ready, 2, static_cast<int>(kTurnEvery.count()));
    if (ready[0].revents != 0) return;
    const Clock::time_point now = Clock::now();
    receiver.turn(now, bridge);
    if (now < next_turn) continue;
    next_turn = now + kTurnEvery;
    bridge.turn(now, Stamp{now_on(CLOCK_REALTIME)}, receiver.state().trouble);
    output.turn();
  }
}

int bridge_until_stopped(const Ros2Options& options) {
  const UniqueFd signals = stop_signals();
  DdsOutput output(options.domain, options.interface, tell);
  if (!output.trouble().empty()) {
    tell(output.trouble());
    return kFailed;
  }
  LcmReceiver receiver(*parse_lcm_url(options.bridge.lcm_url), epoch_minus_monotonic());
  Bridge bridge(options.bridge, output, tell, Clock::now());
  receiver.turn(Clock::now(), bridge);  // starts to listen
  tell("publishes in domain " + std::to_string(options.domain) + " what comes on " + options.bridge.lcm_url);
  run_bridge(receiver, bridge, output, signals.get());
  std::string told = bridge.summary();
  if (const std::string failures = output.failures(); !failures.empty()) told += "; not sent: " + failures;
  if (receiver.state().kernel_dropped > 0)
    told += "; " + std::to_string(receiver.state().kernel_dropped) + " datagrams came too fast";
  tell(told);
  return kStopped;
}

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

}  // namespace
}  // namespace azimuth

int main(int argc, char** argv) {
  try {
    const azimuth::ParsedRos2Options parsed = azimuth::parse_ros2_options(argc, argv, azimuth::variable);
    return parsed.exit_code ? *parsed.exit_code : azimuth::bridge_until_stopped(parsed.options);
  } catch (const std::exception& error) {
    azimuth::tell(error.what());
    return azimuth::kFailed;
  }
}
