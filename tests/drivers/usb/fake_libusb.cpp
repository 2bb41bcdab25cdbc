#include "tests/drivers/usb/fake_libusb.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <set>
#include <sys/eventfd.h>
#include <unistd.h>

using azimuth::test::fake_usb;
using azimuth::test::FakeUsb;
using azimuth::test::UsbCall;

struct libusb_device {
  FakeUsb::Device device;
};

struct libusb_device_handle {
  libusb_device* device = nullptr;
};

struct libusb_context {
  struct Event {
    libusb_device device;
    libusb_hotplug_event event;
  };
  int bell = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  libusb_pollfd polled{bell, 1};  // POLLIN
  std::deque<Event> events;
  libusb_hotplug_callback_fn callback = nullptr;
  void* user = nullptr;
  libusb_pollfd_added_cb added = nullptr;
  libusb_pollfd_removed_cb removed = nullptr;
  void* notified = nullptr;
};

namespace {

std::set<libusb_context*>& contexts() {
  static std::set<libusb_context*> all;
  return all;
}

FakeUsb& bus() {
  static FakeUsb usb;
  return usb;
}

}  // namespace

namespace azimuth::test {

FakeUsb& fake_usb() { return bus(); }
void reset_fake_usb() { bus() = FakeUsb{}; }

void FakeUsb::announce(const Device& device, libusb_hotplug_event event) {
  for (libusb_context* context : ::contexts()) {
    context->events.push_back({{device}, event});
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(context->bell, &one, sizeof one);
  }
}

void FakeUsb::add_descriptor(int fd) {
  for (libusb_context* context : ::contexts())
    if (context->added) context->added(fd, 1, context->notified);
}

void FakeUsb::remove_descriptor(int fd) {
  for (libusb_context* context : ::contexts())
    if (context->removed) context->removed(fd, context->notified);
}

}  // namespace azimuth::test

extern "C" {

int libusb_init(libusb_context** context) {
  if (const int failure = fake_usb().result_of(UsbCall::init)) return failure;
  *context = new libusb_context;
  contexts().insert(*context);
  ++fake_usb().contexts;
  return 0;
}

void libusb_exit(libusb_context* context) {
  contexts().erase(context);
  ::close(context->bell);
  delete context;
  --fake_usb().contexts;
}

int libusb_has_capability(std::uint32_t capability) {
  return capability == LIBUSB_CAP_HAS_HOTPLUG && fake_usb().result_of(UsbCall::hotplug) == 0 ? 1 : 0;
}

int libusb_hotplug_register_callback(libusb_context* context, int /*events*/, int /*flags*/, int /*vendor*/,
                                     int /*product*/, int /*device_class*/, libusb_hotplug_callback_fn callback,
                                     void* user, libusb_hotplug_callback_handle* /*handle*/) {
  if (const int failure = fake_usb().result_of(UsbCall::subscribe)) return failure;
  context->callback = callback;
  context->user = user;
  return 0;
}

const libusb_pollfd** libusb_get_pollfds(libusb_context* context) {
  if (fake_usb().result_of(UsbCall::descriptors) != 0) return nullptr;
  return new const libusb_pollfd* [2] { &context->polled, nullptr };
}

void libusb_free_pollfds(const libusb_pollfd** polled) { delete[] polled; }

void libusb_set_pollfd_notifiers(libusb_context* context, libusb_pollfd_added_cb added,
                                 libusb_pollfd_removed_cb removed, void* user) {
  context->added = added;
  context->removed = removed;
  context->notified = user;
}

int libusb_handle_events_timeout_completed(libusb_context* context, timeval* /*limit*/, int* /*completed*/) {
  if (const int failure = fake_usb().result_of(UsbCall::handle_events)) return failure;
  std::uint64_t rings = 0;
  [[maybe_unused]] const auto taken = ::read(context->bell, &rings, sizeof rings);
  while (!context->events.empty()) {
    libusb_context::Event event = context->events.front();
    context->events.pop_front();
    if (context->callback && context->callback(context, &event.device, event.event, context->user) != 0)
      context->callback = nullptr;
  }
  return 0;
}

ssize_t libusb_get_device_list(libusb_context* /*context*/, libusb_device*** list) {
  if (const int failure = fake_usb().result_of(UsbCall::list)) return failure;
  const auto& devices = fake_usb().devices;
  *list = new libusb_device* [devices.size() + 1] {};
  std::ranges::transform(devices, *list, [](const FakeUsb::Device& device) { return new libusb_device{device}; });
  ++fake_usb().lists;
  return static_cast<ssize_t>(devices.size());
}

void libusb_free_device_list(libusb_device** list, int unreference) {
  for (libusb_device** each = list; unreference != 0 && *each; ++each) delete *each;
  delete[] list;
  --fake_usb().lists;
}

std::uint8_t libusb_get_bus_number(libusb_device* device) { return device->device.bus; }

int libusb_get_port_numbers(libusb_device* device, std::uint8_t* ports, int room) {
  const auto& at = device->device.ports;
  if (static_cast<std::size_t>(room) < at.size()) return LIBUSB_ERROR_OVERFLOW;
  std::ranges::copy(at, ports);
  return static_cast<int>(at.size());
}

int libusb_get_device_descriptor(libusb_device* device, libusb_device_descriptor* about) {
  if (const int failure = fake_usb().result_of(UsbCall::describe)) return failure;
  about->idVendor = device->device.vendor;
  about->idProduct = device->device.product;
  return 0;
}

int libusb_open(libusb_device* device, libusb_device_handle** handle) {
  if (const int failure = fake_usb().result_of(UsbCall::open)) return failure;
  *handle = new libusb_device_handle{device};
  ++fake_usb().handles;
  return 0;
}

void libusb_close(libusb_device_handle* handle) {
  delete handle;
  --fake_usb().handles;
}

int libusb_reset_device(libusb_device_handle* handle) {
  ++fake_usb().resets_tried;
  if (const int failure = fake_usb().result_of(UsbCall::reset)) return failure;
  fake_usb().resets.push_back(handle->device->device.ports);
  return 0;
}

const char* libusb_strerror(int error) {
  switch (error) {
    case LIBUSB_ERROR_ACCESS:
      return "Access denied (insufficient permissions)";
    case LIBUSB_ERROR_NOT_FOUND:
      return "Entity not found";
    default:
      return "Other error";
  }
}

}  // extern "C"
