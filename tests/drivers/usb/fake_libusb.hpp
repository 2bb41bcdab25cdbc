#pragma once
// A simulated USB bus behind the libusb calls that Azimuth uses.

#include <cstdint>
#include <libusb.h>
#include <string>
#include <vector>

namespace azimuth::test {

/// Calls that a test may let fail.
enum class UsbCall { init, hotplug, subscribe, descriptors, handle_events, list, describe, open, reset };

struct FakeUsb {
  struct Device {
    std::uint8_t bus = 1;
    std::vector<std::uint8_t> ports;  ///< empty: a root hub
    std::uint16_t vendor = 0x0403, product = 0x6001;
  };
  std::vector<Device> devices;

  UsbCall failing_call{};
  int failure = 0;  ///< return value of `failing_call`; 0: nothing fails

  // Observed calls.
  int contexts = 0;  ///< currently open
  int handles = 0;   ///< currently open
  int lists = 0;     ///< currently open
  std::vector<std::vector<std::uint8_t>> resets;
  int resets_tried = 0;

  /// Queues an event for every monitor and makes their descriptors readable.
  void plug_in(const Device& device) { announce(device, LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED); }
  void unplug(const Device& device) { announce(device, LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT); }
  /// Called as libusb does when it starts and stops using a descriptor.
  void add_descriptor(int fd);
  void remove_descriptor(int fd);

  void fail(UsbCall call, int with) {
    failing_call = call;
    failure = with;
  }
  int result_of(UsbCall call) const { return call == failing_call ? failure : 0; }

 private:
  void announce(const Device& device, libusb_hotplug_event event);
};

/// The single bus of the program; call reset_fake_usb() before each test.
FakeUsb& fake_usb();
void reset_fake_usb();

}  // namespace azimuth::test
