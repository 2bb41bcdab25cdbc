#include "daemon/devices/usb_help.hpp"

#include <algorithm>
#include <utility>

namespace azimuth {

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
