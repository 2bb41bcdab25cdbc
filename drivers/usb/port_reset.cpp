#include "drivers/usb/port_reset.hpp"

#include <algorithm>
#include <libusb.h>
#include <memory>

#include "drivers/usb/libusb_port.hpp"

namespace azimuth {
namespace {

struct Exit {
  void operator()(libusb_context* context) const { libusb_exit(context); }
};
struct Close {
  void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
struct Free {
  void operator()(libusb_device** list) const { libusb_free_device_list(list, 1); }
};

PortResetResult failed(const UsbPort& port, const char* what, int error) {
  std::string text = "USB port " + port.text() + ": cannot " + what + ": " + libusb_strerror(error);
  if (error == LIBUSB_ERROR_ACCESS)
    text += "; a udev rule (60-azimuth.rules) must let this user write to the device below /dev/bus/usb";
  return {false, std::move(text)};
}

/// Opens and resets the device.
PortResetResult reset_device(libusb_device* device, const UsbPort& port) {
  libusb_device_handle* opened = nullptr;
  if (const int error = libusb_open(device, &opened); error != LIBUSB_SUCCESS) return failed(port, "open", error);
  const std::unique_ptr<libusb_device_handle, Close> handle(opened);
  const int error = libusb_reset_device(handle.get());
  if (error == LIBUSB_SUCCESS) return {true, "USB port " + port.text() + ": reset"};
  // libusb returns this error when the device came back with another address.
  if (error == LIBUSB_ERROR_NOT_FOUND) return {true, "USB port " + port.text() + ": reset, came back as a new device"};
  return failed(port, "reset", error);
}

/// Uses a new libusb context each time, so that the list of devices is current and nothing stays open in between.
PortResetResult reset_port(const UsbPort& port) {
  libusb_context* made = nullptr;
  if (const int error = libusb_init(&made); error != LIBUSB_SUCCESS) return failed(port, "start libusb", error);
  const std::unique_ptr<libusb_context, Exit> context(made);
  libusb_device** all = nullptr;
  const auto count = libusb_get_device_list(context.get(), &all);
  if (count < 0) return failed(port, "list the devices", static_cast<int>(count));
  const std::unique_ptr<libusb_device*, Free> list(all);
  const std::span devices(all, static_cast<std::size_t>(count));
  const auto device = std::ranges::find_if(devices, [&](libusb_device* each) { return usb_port_of(each) == port; });
  if (device == devices.end()) return {false, "USB port " + port.text() + ": nothing to reset is plugged in"};
  return reset_device(*device, port);
}

}  // namespace

PortResetResult PortReset::reset(const UsbPort& port, Clock::time_point now) {
  if (is_too_soon(port, now)) return {false, "USB port " + port.text() + ": not reset again within a minute"};
  return reset_port(port);
}

bool PortReset::is_too_soon(const UsbPort& port, Clock::time_point now) {
  auto attempt = std::ranges::find_if(attempts_, [&](const auto& each) { return each && each->port == port; });
  if (attempt != attempts_.end() && now - (*attempt)->at < kLeastInterval) return true;
  if (attempt == attempts_.end()) {
    attempt = std::ranges::min_element(attempts_, {},
                                       [](const auto& each) { return each ? each->at : Clock::time_point::min(); });
  }
  *attempt = Attempt{port, now};
  return false;
}

}  // namespace azimuth
