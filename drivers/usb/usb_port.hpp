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

/// Where a device is plugged in: the bus, and the hubs' ports on the way from its root, as sysfs names it ("1-2.3").
/// Stays the same when a device is unplugged and plugged in there again, or renumbered by a reset.
///
/// Thread contract: reentrant.
class UsbPort {
 public:
  static constexpr std::size_t kMaxDepth = 7;  ///< USB allows no more hubs

  /// `ports` from the root hub outwards, 1 to kMaxDepth of them. Nothing for anything else: a root hub has no port.
  static std::optional<UsbPort> make(std::uint8_t bus, std::span<const std::uint8_t> ports);
  /// Exactly what text() gives; nothing for any other text, e.g. an interface's "1-2.3:1.0".
  static std::optional<UsbPort> parse(std::string_view text);

  std::string text() const;

  friend bool operator==(const UsbPort&, const UsbPort&) = default;

 private:
  UsbPort() = default;

  std::uint8_t bus_ = 0, depth_ = 0;
  std::array<std::uint8_t, kMaxDepth> ports_{};  // zero beyond depth_
};

/// Of the innermost USB device on a path below /sys/devices; nothing where there is none.
std::optional<UsbPort> usb_port_in_path(const std::filesystem::path& sysfs_path);

/// Where the device behind a node ("/dev/ttyUSB0", "/dev/omnicam", symbolic links included) is plugged in; nothing when
/// it is not there, or not by USB. Known only as long as it is plugged in. `sysfs` is elsewhere in tests only.
std::optional<UsbPort> usb_port_of_node(const std::filesystem::path& node, const std::filesystem::path& sysfs = "/sys");

}  // namespace azimuth
