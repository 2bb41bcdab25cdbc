#include "drivers/usb/usb_monitor.hpp"

#include <cerrno>
#include <poll.h>
#include <sys/epoll.h>
#include <system_error>

#include "drivers/usb/libusb_port.hpp"

namespace azimuth {
namespace {

void add(int epoll, int fd, short events) {
  epoll_event wanted{.events = 0, .data = {.fd = fd}};
  if ((events & POLLIN) != 0) wanted.events |= EPOLLIN;
  if ((events & POLLOUT) != 0) wanted.events |= EPOLLOUT;
  ::epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &wanted);
}

}  // namespace

UsbMonitor::UsbMonitor() {
  if (!open()) close();
}

UsbMonitor::~UsbMonitor() { close(); }

bool UsbMonitor::open() {
  if (!works("libusb_init", libusb_init(&context_))) return false;
  if (libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG) == 0) {
    trouble_ = "USB hot-plug: this system does not tell of it";
    return false;
  }
  const auto callback = [](libusb_context* context, libusb_device* device, libusb_hotplug_event event, void* monitor) {
    return on_event(context, device, event, monitor);
  };
  const int registered = libusb_hotplug_register_callback(
      context_, LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT, 0, LIBUSB_HOTPLUG_MATCH_ANY,
      LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY, callback, this, nullptr);
  return works("libusb_hotplug_register_callback", registered) && watch_descriptors();
}

bool UsbMonitor::watch_descriptors() {
  descriptors_ = UniqueFd(::epoll_create1(EPOLL_CLOEXEC));
  const libusb_pollfd** const polled = descriptors_ ? libusb_get_pollfds(context_) : nullptr;
  if (!polled) {
    trouble_ = "USB hot-plug: its descriptors cannot be had: " + std::generic_category().message(errno);
    return false;
  }
  for (const libusb_pollfd** next = polled; *next; ++next) add(descriptors_.get(), (*next)->fd, (*next)->events);
  libusb_free_pollfds(polled);
  libusb_set_pollfd_notifiers(context_, on_descriptor, on_no_descriptor, this);
  return true;
}

void UsbMonitor::on_descriptor(int fd, short events, void* monitor) {
  add(static_cast<UsbMonitor*>(monitor)->descriptors_.get(), fd, events);
}

void UsbMonitor::on_no_descriptor(int fd, void* monitor) {
  ::epoll_ctl(static_cast<UsbMonitor*>(monitor)->descriptors_.get(), EPOLL_CTL_DEL, fd, nullptr);
}

int UsbMonitor::on_event(libusb_context* /*context*/, libusb_device* device, int event, void* monitor) {
  const std::optional<UsbPort> port = usb_port_of(device);
  libusb_device_descriptor about{};
  if (!port || libusb_get_device_descriptor(device, &about) != 0) return 0;
  const bool arrived = event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED;
  static_cast<UsbMonitor*>(monitor)->events_.push({.kind = arrived ? UsbEvent::Kind::arrived : UsbEvent::Kind::left,
                                                   .port = port->text(),
                                                   .vendor = about.idVendor,
                                                   .product = about.idProduct});
  return 0;  // any other value would end the registration
}

void UsbMonitor::turn() {
  if (!context_) return;
  timeval no_time{};
  const int returned = libusb_handle_events_timeout_completed(context_, &no_time, nullptr);
  if (returned != LIBUSB_ERROR_INTERRUPTED && !works("libusb_handle_events", returned)) close();
}

bool UsbMonitor::works(const char* what, int returned) {
  if (returned == LIBUSB_SUCCESS) return true;
  trouble_ = std::string("USB hot-plug: ") + what + ": " + libusb_strerror(returned);
  return false;
}

void UsbMonitor::close() {
  if (context_) {
    libusb_set_pollfd_notifiers(context_, nullptr, nullptr, nullptr);
    libusb_exit(context_);  // ends the registration as well
  }
  context_ = nullptr;
  descriptors_ = UniqueFd{};
}

}  // namespace azimuth
