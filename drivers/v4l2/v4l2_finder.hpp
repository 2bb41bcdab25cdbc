#pragma once
// Internal to drivers/v4l2: finds the node of the camera that the settings name.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "drivers/v4l2/v4l2_handle.hpp"
#include "drivers/v4l2/v4l2_nodes.hpp"

namespace azimuth::v4l2 {

/// The name of a camera in the settings; see V4l2Settings::device. Empty members match any camera.
struct CameraName {
  std::string path;
  std::string vendor, product, serial;  ///< ids of its USB device
  std::string card;
};

/// None: the text is not a valid name.
std::optional<CameraName> parse_name(std::string_view text);

/// True: the name matches the USB device.
bool matches(const CameraName& name, const UsbIdentity& usb);

/// Opens the named node. A path is used as it is; otherwise the node with the lowest number that matches and provides
/// images (a camera may have further nodes, for its metadata).
tl::expected<Handle, CameraTrouble> open_named(Calls& calls, const std::string& name);

/// The USB port of the node's device as named by sysfs ("1-2.3"); empty: not on USB.
std::string usb_port(const Calls& calls, const std::filesystem::path& node);

}  // namespace azimuth::v4l2
