#pragma once
#include <cstdint>
#include <string>

#include "base/ring.hpp"
#include "base/unique_fd.hpp"
#include "drivers/usb/usb_port.hpp"

struct libusb_context;
struct libusb_device;

namespace azimuth {

/// A USB device was plugged in or unplugged.
struct UsbEvent {
  enum class Kind { arrived, left };
  Kind kind = Kind::arrived;
  std::string port;  ///< UsbPort::text()
  std::uint16_t vendor = 0, product = 0;
};

/// Reports when USB devices are plugged in and unplugged, for a thread that polls: descriptor() for POLLIN; then
/// turn(); then take() until it returns false.
///
/// The monitor only shortens waiting: a driver that waits for a device is woken at once instead of after its back-off.
/// Where the system does not report devices (no udev, no netlink), trouble() tells why, and nothing else changes.
///
/// Thread contract: thread-bound; nothing blocks after construction. libusb has a thread of its own, which inherits the
/// signal mask of the thread that constructs the first monitor. Allocates only when there are events.
class UsbMonitor {
 public:
  static constexpr std::size_t kMaxUntaken = 32;  ///< beyond this, the oldest events are dropped

  UsbMonitor();
  ~UsbMonitor();
  UsbMonitor(const UsbMonitor&) = delete;
  UsbMonitor& operator=(const UsbMonitor&) = delete;

  /// -1: there is nothing to wait for. Only turn() can change it, and only to -1.
  int descriptor() const { return descriptors_.get(); }
  void turn();
  /// Takes the oldest event.
  bool take(UsbEvent& event) { return events_.pop(event); }

  /// Why no events are reported; empty: the monitor works.
  const std::string& trouble() const { return trouble_; }

 private:
  static int on_event(libusb_context* context, libusb_device* device, int event, void* monitor);
  static void on_descriptor(int fd, short events, void* monitor);
  static void on_no_descriptor(int fd, void* monitor);
  bool open();
  bool watch_descriptors();
  bool works(const char* what, int returned);
  void close();

  UniqueFd descriptors_;  // an epoll of libusb's descriptors
  libusb_context* context_ = nullptr;
  Ring<UsbEvent, kMaxUntaken> events_;
  std::string trouble_;
};

}  // namespace azimuth
