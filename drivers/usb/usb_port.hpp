#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace azimuth {

/// The place where a device is plugged in: the bus, and the ports of the hubs from the root to the device, as named by
/// sysfs ("1-2.3"). It stays the same when a device is unplugged and plugged in there again, or renumbered by a reset.
///
/// Thread contract: reentrant.
class UsbPort {
 public:
  static constexpr std::size_t kMaxDepth = 7;  ///< USB does not allow more hubs

  /// `ports` lists 1 to kMaxDepth ports from the root hub outwards. None for any other length: a root hub has no port.
  static std::optional<UsbPort> make(std::uint8_t bus, std::span<const std::uint8_t> ports);
  /// Parses exactly the output of text(); none for any other text, e.g. an interface's "1-2.3:1.0".
  static std::optional<UsbPort> parse(std::string_view text);

  std::string text() const;

  friend bool operator==(const UsbPort&, const UsbPort&) = default;

 private:
  UsbPort() = default;

  std::uint8_t bus_ = 0, depth_ = 0;
  std::array<std::uint8_t, kMaxDepth> ports_{};  // zero beyond depth_
};

/// The port of the innermost USB device on a path below /sys/devices; none when there is no such device.
std::optional<UsbPort> usb_port_in_path(const std::filesystem::path& sysfs_path);

/// The port of the device behind a node ("/dev/ttyUSB0", "/dev/omnicam", also symbolic links). None when the device is
/// not present, or not on USB. It is known only while the device is plugged in. Tests pass another `sysfs`.
std::optional<UsbPort> usb_port_of_node(const std::filesystem::path& node, const std::filesystem::path& sysfs = "/sys");

}  // namespace azimuth
