#pragma once
// Which cameras of the kernel's video interface there are, for a user who is to choose one.
// Thread contract: reentrant, for different `calls`.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/v4l2/v4l2_calls.hpp"

namespace azimuth::v4l2 {

/// The USB device behind a node; all empty: there is none.
struct UsbIdentity {
  std::string port;                     ///< as sysfs names it ("1-2.3")
  std::string vendor, product, serial;  ///< as sysfs has them, numbers in hexadecimal
};

struct VideoNode {
  std::string path{};  ///< "/dev/video0"
  std::string card{};  ///< as the driver calls it
  UsbIdentity usb{};
  int open_error = 0;                  ///< errno; 0: this process may open it
  std::optional<bool> gives_images{};  ///< false: of metadata, or the like; nothing: it does not tell
};

/// Of "video0".
UsbIdentity usb_identity(const Calls& calls, const std::string& node);

/// The names of all nodes, by number.
std::vector<std::string> node_names(const Calls& calls);

/// All nodes, by number. Opens each for a moment, which disturbs nobody.
std::vector<VideoNode> video_nodes(Calls& calls);

/// Whether a name other than a path (V4l2Settings::device) means the node; false for a wrong name.
bool is_meant(std::string_view name, const VideoNode& node);

/// What to write for V4l2Settings::device to have this one of `all`, whatever number it gets: by serial, USB numbers,
/// both, or card, the first of these that means no other; its path when none does.
std::string lasting_name(const VideoNode& node, std::span<const VideoNode> all);

}  // namespace azimuth::v4l2
