#include "daemon/devices/usb_help.hpp"

#include <algorithm>
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

UsbHelp::UsbHelp(std::unique_ptr<UsbMonitor> monitor, std::shared_ptr<PortResetter> resetter, std::size_t client,
                 Clock::duration longest_interval)
    : monitor_(std::move(monitor)),
      resetter_(std::move(resetter)),
      client_(client),
      longest_interval_(longest_interval) {}

bool UsbHelp::turn() {
  if (!monitor_) return false;
  monitor_->turn();
  if (!monitor_->trouble().empty() && !std::exchange(told_monitor_, true))
    events_.push({true, monitor_->trouble() + "; devices are tried from time to time"});
  bool arrived = false;
  UsbEvent event;
  while (monitor_->take(event)) arrived |= event.kind == UsbEvent::Kind::arrived;
  return arrived;
}

bool UsbHelp::reset(const std::string& port, Clock::time_point now) {
  if (!may_reset(now)) return false;
  const std::optional<UsbPort> parsed = UsbPort::parse(port);
  if (!parsed) return false;
  not_before_ = now + interval_;
  interval_ = std::min(2 * interval_, std::max(longest_interval_, PortReset::kLeastInterval));
  resetting_ = true;
  resetter_->request(client_, *parsed);
  return true;
}

bool UsbHelp::take_end() {
  if (!resetting_ || !resetter_->take(client_, result_)) return false;
  resetting_ = false;
  if (result_.done) ++resets_;
  if (result_.done || result_.text != told_failure_)
    events_.push({.trouble = true, .text = result_.text, .port_reset = result_.done});
  told_failure_ = result_.done ? std::string() : result_.text;
  return true;
}

bool UsbHelp::take_event(DeviceEvent& event) { return events_.pop(event); }

}  // namespace azimuth
