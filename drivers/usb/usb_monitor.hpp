#pragma once
#include <cstdint>
#include <string>

#include "base/ring.hpp"
#include "base/unique_fd.hpp"
#include "drivers/usb/usb_port.hpp"

struct libusb_context;
struct libusb_device;

namespace azimuth {

/// A device was plugged in or out.
struct UsbEvent {
  enum class Kind { arrived, left };
  Kind kind = Kind::arrived;
  std::string port;  ///< UsbPort::text()
  std::uint16_t vendor = 0, product = 0;
};

/// Tells when USB devices are plugged in and out, for a thread that polls: descriptor() for POLLIN; turn(); take()
/// until it says no.
///
/// A convenience: who waits for a device is woken at once instead of after its back-off. Where the system does not tell
/// (no udev, no netlink) trouble() says why, and nothing else changes.
///
/// Thread contract: thread-bound; nothing blocks after construction. libusb has a thread of its own, which takes on the
/// signal mask of the thread that makes the first monitor. Allocates when something happens, never while nothing does.
class UsbMonitor {
 public:
  static constexpr std::size_t kMaxUntaken = 32;  ///< then the oldest events give way

  UsbMonitor();
  ~UsbMonitor();
  UsbMonitor(const UsbMonitor&) = delete;
  UsbMonitor& operator=(const UsbMonitor&) = delete;

  /// -1: there is nothing to wait for. Only turn() changes it, and only to that.
  int descriptor() const { return descriptors_.get(); }
  void turn();
  /// The oldest event not taken yet.
  bool take(UsbEvent& event) { return events_.pop(event); }

  /// Why nothing is told, or will be any more; empty: it works.
  const std::string& trouble() const { return trouble_; }

 private:
  static int on_event(libusb_context* context, libusb_device* device, int event, void* monitor);
  static void on_descriptor(int fd, short events, void* monitor);
  static void on_no_descriptor(int fd, void* monitor);
  bool open();
  bool watch_descriptors();
  bool works(const char* what, int returned);
  void close();

  UniqueFd descriptors_;  // an epoll of libusb's
  libusb_context* context_ = nullptr;
  Ring<UsbEvent, kMaxUntaken> events_;
  std::string trouble_;
};

}  // namespace azimuth
