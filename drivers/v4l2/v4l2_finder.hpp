#pragma once
// Internal to drivers/v4l2: which node is the camera that is meant.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "drivers/v4l2/v4l2_handle.hpp"
#include "drivers/v4l2/v4l2_nodes.hpp"

namespace azimuth::v4l2 {

/// How a camera is named in the settings; see V4l2Settings::device. Empty parts: any.
struct CameraName {
  std::string path;
  std::string vendor, product, serial;  ///< of its USB device
  std::string card;
};

/// Nothing: not a name of any kind.
std::optional<CameraName> parse_name(std::string_view text);

/// Whether the USB device is one that the name allows.
bool matches(const CameraName& name, const UsbIdentity& usb);

/// Opens the node that is meant: a path as it stands; else the one with the lowest number that matches and gives images
/// (a camera may have further nodes, for its metadata).
tl::expected<Handle, CameraTrouble> open_named(Calls& calls, const std::string& name);

/// Where the node's device is plugged in, as sysfs names it ("1-2.3"); empty: not by USB.
std::string usb_port(const Calls& calls, const std::filesystem::path& node);

}  // namespace azimuth::v4l2
