#include "tools/import/ros_message.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>

#include "drivers/wire/image_header.hpp"
#include "drivers/wire/plausible.hpp"
#include "tools/bag/bag_records.hpp"
#include "tools/import/wheel_path.hpp"

namespace azimuth {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Reads a little-endian number. All machines that Azimuth supports are little-endian.
template <class Number>
Number number_at(Bytes bytes, std::size_t index) {
  Number number{};
  std::memcpy(&number, bytes.data() + index * sizeof number, sizeof number);
  return number;
}

double as_double(RosScalar scalar, Bytes bytes, std::size_t index) {
  switch (scalar) {
    case RosScalar::i8:
      return number_at<std::int8_t>(bytes, index);
    case RosScalar::boolean:
    case RosScalar::u8:
      return number_at<std::uint8_t>(bytes, index);
    case RosScalar::i16:
      return number_at<std::int16_t>(bytes, index);
    case RosScalar::u16:
      return number_at<std::uint16_t>(bytes, index);
    case RosScalar::i32:
      return number_at<std::int32_t>(bytes, index);
    case RosScalar::u32:
      return number_at<std::uint32_t>(bytes, index);
    case RosScalar::i64:
      return static_cast<double>(number_at<std::int64_t>(bytes, index));
    case RosScalar::u64:
      return static_cast<double>(number_at<std::uint64_t>(bytes, index));
    case RosScalar::f32:
      return static_cast<double>(number_at<float>(bytes, index));
    case RosScalar::f64:
      return number_at<double>(bytes, index);
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

struct Encoding {
  std::string_view name;
  PixelFormat pixels;
};
// Names of encodings before ROS 2 Iron and from Iron on.
constexpr std::array<Encoding, 13> kEncodings{{{"mono8", PixelFormat::gray8},
                                               {"8UC1", PixelFormat::gray8},
                                               {"rgb8", PixelFormat::rgb8},
                                               {"bgr8", PixelFormat::bgr8},
                                               {"8UC3", PixelFormat::bgr8},
                                               {"yuv422", PixelFormat::uyvy},
                                               {"uyvy", PixelFormat::uyvy},
                                               {"yuv422_yuy2", PixelFormat::yuyv},
                                               {"yuyv", PixelFormat::yuyv},
                                               {"bayer_rggb8", PixelFormat::bayer_rggb8},
                                               {"bayer_grbg8", PixelFormat::bayer_grbg8},
                                               {"bayer_gbrg8", PixelFormat::bayer_gbrg8},
                                               {"bayer_bggr8", PixelFormat::bayer_bggr8}}};

/// An encoding of which only some bytes of each pixel are kept: colours without transparency, the upper byte of 16
/// bits.
struct WideEncoding {
  std::string_view name;
  PixelFormat pixels;
  int bytes;  // bytes per pixel
};
constexpr std::array<WideEncoding, 5> kWideEncodings{{{"rgba8", PixelFormat::rgb8, 4},
                                                      {"bgra8", PixelFormat::bgr8, 4},
                                                      {"8UC4", PixelFormat::bgr8, 4},
                                                      {"mono16", PixelFormat::gray8, 2},
                                                      {"16UC1", PixelFormat::gray8, 2}}};

/// An image side or stride; 0 if it is implausible.
int length_of(const RosMessage& message, std::string_view path) {
  const double value = message.number(path).value_or(0.0);
  return value >= 0.0 && value <= 1e6 ? static_cast<int>(value) : 0;
}

RosImage compressed_image(const RosMessage& message) {
  const std::optional<Bytes> bytes = message.bytes("data");
  if (!bytes) return {};
  const bool is_image = is_png(*bytes) || jpeg_size(*bytes);
  if (!is_image) return {.image = {}, .unsupported = std::string(message.text("format").value_or(""))};
  const auto [width_px, height_px] = jpeg_size(*bytes).value_or(std::pair{0, 0});
  return {.image = {packed_format(PixelFormat::mjpeg, width_px, height_px), *bytes}};
}

/// The image with the kept bytes of each pixel, in rows without padding. No bytes if the message is too short.
ImageView narrowed(const RosMessage& message, const WideEncoding& wide, std::vector<std::byte>& out) {
  const FrameFormat format = packed_format(wide.pixels, length_of(message, "width"), length_of(message, "height"));
  const Bytes bytes = message.bytes("data").value_or(Bytes{});
  const std::size_t stride = as_size(length_of(message, "step")), kept = as_size(bytes_per_pixel(wide.pixels));
  const std::size_t width = as_size(format.width_px), of_pixel = as_size(wide.bytes);
  if (!is_valid(format) || stride < width * of_pixel || bytes.size() / stride < as_size(format.height_px)) return {};
  const bool upper_is_second = kept == 1 && message.number("is_bigendian").value_or(0.0) == 0.0;
  out.clear();
  out.reserve(format.bytes());
  for (std::size_t v = 0; v < as_size(format.height_px); ++v) {
    for (std::size_t u = 0; u < width; ++u) {
      const Bytes pixel = bytes.subspan(v * stride + u * of_pixel + (upper_is_second ? 1 : 0), kept);
      out.insert(out.end(), pixel.begin(), pixel.end());
    }
  }
  return {format, out};
}

bool holds(std::string_view name, std::string_view word) {
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  return std::search(name.begin(), name.end(), word.begin(), word.end(), same) != name.end();
}

/// Angle of the only joint for which `is_meant(name)` is true; nothing if there is none or more than one.
template <class IsMeant>
std::optional<double> only_joint(const RosMessage& message, IsMeant is_meant) {
  std::optional<double> found;
  for (std::size_t i = 0;; ++i) {
    const std::optional<std::string_view> name = message.text("name[" + std::to_string(i) + ']');
    if (!name) return found;
    if (!is_meant(*name)) continue;
    if (found) return std::nullopt;
    found = message.number("position", i);
    if (!found) return std::nullopt;
  }
}

std::optional<double> joint(const RosMessage& message, std::string_view name, std::string_view word) {
  if (!name.empty()) return only_joint(message, [&](std::string_view each) { return each == name; });
  return only_joint(message, [&](std::string_view each) { return holds(each, word); });
}

}  // namespace

bool RosMessage::read(Bytes message) {
  values_.clear();
  return definition_.read(message, [this](std::string_view path, const RosDefinition::Value& value) {
    values_.insert_or_assign(std::string(path), value);
  });
}

const RosDefinition::Value* RosMessage::find(std::string_view path) const {
  const auto value = values_.find(path);
  return value != values_.end() ? &value->second : nullptr;
}

std::optional<double> RosMessage::number(std::string_view path, std::size_t index) const {
  const RosDefinition::Value* const value = find(path);
  if (value == nullptr || index >= value->count) return std::nullopt;
  const double number = as_double(value->scalar, value->bytes, index);
  return std::isnan(number) ? std::nullopt : std::optional(number);
}

std::optional<std::string_view> RosMessage::text(std::string_view path) const {
  const RosDefinition::Value* const value = find(path);
  if (value == nullptr || value->scalar != RosScalar::text) return std::nullopt;
  return as_text(value->bytes);
}

std::optional<Bytes> RosMessage::bytes(std::string_view path) const {
  const RosDefinition::Value* const value = find(path);
  if (value == nullptr || value->scalar != RosScalar::u8) return std::nullopt;
  return value->bytes;
}

std::optional<Stamp> RosMessage::time(std::string_view path) const {
  std::uint32_t seconds = 0, part = 0;
  if (const RosDefinition::Value* const value = find(path)) {
    if (value->scalar != RosScalar::time || value->count != 1) return std::nullopt;
    seconds = number_at<std::uint32_t>(value->bytes, 0);
    part = number_at<std::uint32_t>(value->bytes, 1);
  } else {
    const std::optional<double> sec = number(std::string(path) + ".sec"),
                                nanosec = number(std::string(path) + ".nanosec");
    if (!sec || !nanosec || !(*sec >= 0.0 && *nanosec >= 0.0 && *nanosec < 4e9)) return std::nullopt;
    seconds = static_cast<std::uint32_t>(std::min(*sec, 4.2e9));
    part = static_cast<std::uint32_t>(*nanosec);
  }
  if (seconds == 0 && part == 0) return std::nullopt;
  return ros_stamp(seconds, part);
}

namespace {

/// Path prefix of the pose, which depends on the message type.
std::string pose_path(const RosMessage& message) {
  return message.has("pose.pose.position.x") ? "pose.pose." : "pose.";
}

}  // namespace

std::optional<Pose2> pose_of(const RosMessage& message) {
  const std::string prefix = pose_path(message);
  const auto position = [&](const char* axis) { return message.number(prefix + "position." + axis); };
  const auto turn = [&](const char* axis) { return message.number(prefix + "orientation." + axis); };
  const auto x_m = position("x"), y_m = position("y");
  const auto qx = turn("x"), qy = turn("y"), qz = turn("z"), qw = turn("w");
  if (!x_m || !y_m || !qx || !qy || !qz || !qw) return std::nullopt;
  const std::optional<double> heading_rad = heading_of(*qx, *qy, *qz, *qw);
  if (!heading_rad || !is_plausible_coordinate(*x_m) || !is_plausible_coordinate(*y_m)) return std::nullopt;
  return Pose2{*x_m, *y_m, *heading_rad};
}

bool has_unset_orientation(const RosMessage& message) {
  const std::string prefix = pose_path(message) + "orientation.";
  return std::ranges::all_of(std::string_view("xyzw"), [&](char axis) { return message.number(prefix + axis) == 0.0; });
}

std::optional<RosTwist> twist_of(const RosMessage& message) {
  const auto speed_m_s = message.number("twist.twist.linear.x"), turn_rad_s = message.number("twist.twist.angular.z");
  constexpr double kFastest = 100.0;  // limit of both speeds, above that of any robot
  if (!speed_m_s || !turn_rad_s || !(std::abs(*speed_m_s) < kFastest && std::abs(*turn_rad_s) < kFastest))
    return std::nullopt;
  return RosTwist{*speed_m_s, *turn_rad_s};
}

std::string frames_of(const RosMessage& message) {
  const std::string parent(message.text("header.frame_id").value_or(""));
  const std::string child(message.text("child_frame_id").value_or(""));
  return child.empty() ? parent : parent + " -> " + child;
}

RosImage image_of(const RosMessage& message, std::vector<std::byte>& changed) {
  if (message.has("format")) return compressed_image(message);
  const std::string_view encoding = message.text("encoding").value_or("");
  const auto wide = std::ranges::find(kWideEncodings, encoding, &WideEncoding::name);
  if (wide != kWideEncodings.end()) return {.image = narrowed(message, *wide, changed)};
  const auto known = std::ranges::find(kEncodings, encoding, &Encoding::name);
  if (known == kEncodings.end()) return {.image = {}, .unsupported = std::string(encoding)};
  const FrameFormat format{known->pixels, length_of(message, "width"), length_of(message, "height"),
                           length_of(message, "step")};
  const ImageView image{format, message.bytes("data").value_or(Bytes{})};
  return image.readable() ? RosImage{.image = {format, image.bytes.first(format.bytes())}} : RosImage{};
}

std::string joints_of(const RosMessage& message) {
  constexpr std::size_t kMostNamed = 20;
  std::string names;
  for (std::size_t i = 0; i < kMostNamed; ++i) {
    const std::optional<std::string_view> name = message.text("name[" + std::to_string(i) + ']');
    if (!name) break;
    names += (names.empty() ? "" : ", ") + std::string(*name);
  }
  return names;
}

std::optional<WheelAngles> wheels_of(const RosMessage& message, std::string_view left, std::string_view right) {
  const std::optional<double> left_rad = joint(message, left, "left"), right_rad = joint(message, right, "right");
  if (!left_rad || !right_rad) return std::nullopt;
  return WheelAngles{*left_rad, *right_rad};
}

}  // namespace azimuth
