#pragma once
// A USB bus in memory, behind the calls of libusb that Azimuth uses.

#include <cstdint>
#include <libusb.h>
#include <string>
#include <vector>

namespace azimuth::test {

/// The calls that may be made to fail.
enum class UsbCall { init, hotplug, subscribe, descriptors, handle_events, list, describe, open, reset };

struct FakeUsb {
  struct Device {
    std::uint8_t bus = 1;
    std::vector<std::uint8_t> ports;  ///< none: a root hub
    std::uint16_t vendor = 0x0403, product = 0x6001;
  };
  std::vector<Device> devices;

  UsbCall failing_call{};
  int failure = 0;  ///< what `failing_call` returns; 0: nothing fails

  // What has been done with it.
  int contexts = 0;  ///< open now
  int handles = 0;   ///< likewise
  int lists = 0;     ///< likewise
  std::vector<std::vector<std::uint8_t>> resets;
  int resets_tried = 0;

  /// Queues an event for every monitor and makes their descriptors readable.
  void plug_in(const Device& device) { announce(device, LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED); }
  void unplug(const Device& device) { announce(device, LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT); }
  /// As libusb does when it begins and ceases to use a descriptor.
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

/// The one bus of the program. reset_fake_usb() before each test.
FakeUsb& fake_usb();
void reset_fake_usb();

}  // namespace azimuth::test
