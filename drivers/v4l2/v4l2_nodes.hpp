#pragma once
// Lists the cameras of the kernel's video interface, for a user who has to choose one. Thread contract: reentrant, for
// different `calls`.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/v4l2/v4l2_calls.hpp"

namespace azimuth::v4l2 {

/// The USB device behind a node; all members are empty if there is none.
struct UsbIdentity {
  std::string port;                     ///< as named by sysfs ("1-2.3")
  std::string vendor, product, serial;  ///< as in sysfs, numbers in hexadecimal
};

struct VideoNode {
  std::string path{};  ///< "/dev/video0"
  std::string card{};  ///< the driver's name of the camera
  UsbIdentity usb{};
  int open_error = 0;  ///< errno; 0: this process may open it
  /// False: the node provides only metadata or similar data; none: unknown.
  std::optional<bool> gives_images{};
};

/// `node` is a name such as "video0".
UsbIdentity usb_identity(const Calls& calls, const std::string& node);

/// The names of all nodes, by number.
std::vector<std::string> node_names(const Calls& calls);

/// All nodes, by number. Opens each for a moment, which disturbs no other program.
std::vector<VideoNode> video_nodes(Calls& calls);

/// True: a name other than a path (V4l2Settings::device) matches the node. False for an invalid name.
bool is_meant(std::string_view name, const VideoNode& node);

/// A value of V4l2Settings::device that selects this node among `all`, even when its number changes: by serial number,
/// USB ids, both, or card, the first of these that matches no other node; its path when none does.
std::string lasting_name(const VideoNode& node, std::span<const VideoNode> all);

}  // namespace azimuth::v4l2
