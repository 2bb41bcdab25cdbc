#include "daemon/devices/port_resetter.hpp"

#include <memory>
#include <utility>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 10s;
constexpr auto kDeadline = 60s;  // never checked, because this thread may block

}  // namespace

PortResetter::PortResetter()
    : PortResetter([resets = std::make_shared<PortReset>()](const UsbPort& port, PortReset::Clock::time_point now) {
        return resets->reset(port, now);
      }) {}

PortResetter::PortResetter(Reset reset)
    : reset_(std::move(reset)),
      lanes_{Lane(bell_, nobodys_bell_), Lane(bell_, nobodys_bell_)},
      thread_({.name = "usb reset", .deadline = kDeadline}, bell_, [this] { turn(); }) {
  thread_.start();
}

PortResetter::~PortResetter() {
  ends_.store(true, std::memory_order_release);
  thread_.stop();
}

void PortResetter::request(std::size_t client, const UsbPort& port) {
  std::optional<UsbPort> wish = port;
  lanes_.at(client).wishes.publish(wish);
}

bool PortResetter::take(std::size_t client, PortResetResult& into) { return lanes_.at(client).results.take(into); }

void PortResetter::turn() {
  bell_.wait(kPatience);
  for (Lane& lane : lanes_) {
    std::optional<UsbPort> wish;
    if (ends_.load(std::memory_order_acquire) || !lane.wishes.take(wish) || !wish) continue;
    PortResetResult result = reset_(*wish, PortReset::Clock::now());
    lane.results.publish(result);
  }
}

}  // namespace azimuth
