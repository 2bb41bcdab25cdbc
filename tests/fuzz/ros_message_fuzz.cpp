// Any text as the definition of a ROS message and any bytes as the message. The message must be refused, or its parts
// must lie within the bytes. The first byte selects the type and the version of ROS; a zero byte ends the definition.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "tools/import/ros_message.hpp"

namespace azimuth {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check(const std::string& type, RosVersion version, std::string_view text, Bytes bytes) {
  const std::optional<RosDefinition> definition = RosDefinition::parse(text, type, version);
  if (!definition) return;
  RosMessage message(*definition);
  const bool whole = message.read(bytes);
  for (std::size_t size : {bytes.size() / 2, bytes.size() / 3}) {
    const bool half = message.read(bytes.first(size));
    require(whole || !half);
  }
  if (!message.read(bytes)) return;
  message.time("header.stamp");
  if (const auto pose = pose_of(message)) require(std::isfinite(pose->x_m) && std::isfinite(pose->heading_rad));
  wheels_of(message, "", "");
  has_unset_orientation(message);
  if (const auto twist = twist_of(message)) require(std::isfinite(twist->speed_m_s + twist->turn_rad_s));
  require(frames_of(message).size() <= bytes.size() + 4);
  joints_of(message);
  std::vector<std::byte> changed;
  const RosImage image = image_of(message, changed);
  if (image.image.bytes.empty()) return;
  const Bytes within = changed.empty() ? bytes : Bytes(changed);
  require(image.image.bytes.data() >= within.data());
  require(image.image.bytes.data() + image.image.bytes.size() <= within.data() + within.size());
  require(image.image.format.pixels == PixelFormat::mjpeg || image.image.readable());
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<const char*, 4> kTypes{"nav_msgs/Odometry", "sensor_msgs/Image", "sensor_msgs/JointState",
                                              "a/B"};
  if (size == 0) return 0;
  const std::string_view all(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t end = std::min(all.find('\0'), all.size());
  const std::string_view message = all.substr(std::min(end + 1, all.size()));
  const bool is_two = data[0] / kTypes.size() % 2 == 1;
  azimuth::check(kTypes.at(data[0] % kTypes.size()), is_two ? azimuth::RosVersion::two : azimuth::RosVersion::one,
                 all.substr(0, end), std::as_bytes(std::span(message.data(), message.size())));
  return 0;
}
