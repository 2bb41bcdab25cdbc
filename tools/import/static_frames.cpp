#include "tools/import/static_frames.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

#include "settings/rig.hpp"
#include "slam/camera/make_camera.hpp"
#include "tools/import/ros_message.hpp"

namespace azimuth {
namespace {

constexpr double kWorthSaying_m = 1e-3;
constexpr double kWorthSaying_rad = 1e-3;
// Largest angle between the optical axis and the vertical. If no axis is within it, the optical axis is unknown.
constexpr double kMostTilt_rad = 0.6;
constexpr std::size_t kDeepest = 100;  // limit of the depth of the frame tree

template <class Use>
void each_message(const BagFile& bag, const BagTopic& topic, Use use) {
  std::optional<RosDefinition> definition = RosDefinition::parse(topic.definition, topic.type, topic.version);
  if (!definition) return;
  RosMessage message(*std::move(definition));
  bag.each(topic, [&](const Arrival&, Bytes bytes) {
    if (message.read(bytes)) use(message);
  });
}

std::string without_slash(std::string_view frame) {
  return std::string(frame.starts_with('/') ? frame.substr(1) : frame);
}

/// The frame in the first message that names one.
std::string frame_of(const BagFile& bag, const BagTopic& topic, std::string_view path) {
  std::string frame;
  each_message(bag, topic, [&](const RosMessage& message) {
    if (frame.empty()) frame = without_slash(message.text(path).value_or(""));
  });
  return frame;
}

/// The transform at path `at`. Nothing if a value is missing or the quaternion is no rotation.
std::optional<Eigen::Isometry3d> transform_in(const RosMessage& message, const std::string& at) {
  const auto number = [&](const char* name) { return message.number(at + name).value_or(std::nan("")); };
  const Eigen::Vector3d p(number("translation.x"), number("translation.y"), number("translation.z"));
  Eigen::Quaterniond q(number("rotation.w"), number("rotation.x"), number("rotation.y"), number("rotation.z"));
  if (!p.allFinite() || !(std::abs(q.squaredNorm() - 1.0) < 0.02)) return std::nullopt;
  q.normalize();
  return Eigen::Translation3d(p) * q;
}

StaticFrames static_frames(const BagFile& bag) {
  StaticFrames frames;
  for (const BagTopic& topic : bag.topics()) {
    if (!topic.name.ends_with("tf_static")) continue;
    each_message(bag, topic, [&](const RosMessage& message) {
      for (std::size_t i = 0;; ++i) {
        const std::string at = fmt::format("transforms[{}].", i);
        const auto child = message.text(at + "child_frame_id");
        if (!child) return;
        if (const auto T = transform_in(message, at + "transform."))
          frames.add(without_slash(message.text(at + "header.frame_id").value_or("")), without_slash(*child), *T);
      }
    });
  }
  return frames;
}

}  // namespace

void StaticFrames::add(const std::string& parent, const std::string& child, const Eigen::Isometry3d& T_parent_child) {
  frames_[child] = {parent, T_parent_child};
}

std::optional<StaticFrames::InRoot> StaticFrames::in_root(std::string frame) const {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (std::size_t depth = 0; depth < kDeepest; ++depth) {
    const auto found = frames_.find(frame);
    if (found == frames_.end()) return InRoot{frame, T};
    T = found->second.T_parent_child * T;
    frame = found->second.parent;
  }
  return std::nullopt;
}

std::optional<Eigen::Isometry3d> StaticFrames::between(const std::string& from, const std::string& to) const {
  const auto one = in_root(from), other = in_root(to);
  if (!one || !other || one->root != other->root) return std::nullopt;
  return one->T_root_frame.inverse() * other->T_root_frame;
}

std::optional<CameraMounting> camera_mounting(const BagFile& bag, const BagChoice& choice) {
  if (!choice.images) return std::nullopt;
  const StaticFrames frames = static_frames(bag);
  const std::string camera = frame_of(bag, *choice.images, "header.frame_id");
  const std::string base = choice.odometry ? frame_of(bag, *choice.odometry, "child_frame_id") : std::string();
  if (camera.empty()) return std::nullopt;
  for (const std::string& frame : std::array<std::string, 3>{base, "base_link", "base_footprint"})
    if (const auto T = frame.empty() || frame == camera ? std::nullopt : frames.between(frame, camera))
      return CameraMounting{frame, camera, T->translation(), T->rotation()};
  return std::nullopt;
}

std::optional<CameraTilt> CameraMounting::tilt() const {
  Eigen::Index upright = 0;
  R_base_camera.row(2).cwiseAbs().maxCoeff(&upright);
  const Eigen::Vector3d axis = R_base_camera.col(upright) * (R_base_camera(2, upright) < 0.0 ? -1.0 : 1.0);
  if (axis.z() < std::cos(kMostTilt_rad)) return std::nullopt;
  return tilt_of_axis(axis);
}

namespace {

/// Lines for those keys that `camera` does not set and whose values differ from the defaults.
std::string lines_of(const CameraMounting& mounting, const CameraRig& camera) {
  const std::string source = fmt::format("# /tf_static: {} in {}\n", mounting.camera, mounting.base);
  std::string lines;
  const Eigen::Vector3d& p_m = mounting.p_base_camera_m;
  if (camera.position_m == std::array<double, 2>{} && p_m.head<2>().norm() >= kWorthSaying_m)
    lines += fmt::format("position_m = [{:.4f}, {:.4f}]  {}", p_m.x(), p_m.y(), source);
  CameraMounting turned = mounting;  // a rig's tilt applies before its yaw
  turned.R_base_camera = Eigen::AngleAxisd(-camera.yaw_offset_rad, Eigen::Vector3d::UnitZ()) * mounting.R_base_camera;
  const std::optional<CameraTilt> tilt = turned.tilt();
  const bool levels = takes_images(camera.model) && !std::holds_alternative<RadialRig>(camera.model);
  if (!tilt || !levels || !tilt_of(camera).is_level()) return lines;
  if (std::abs(tilt->roll_rad) >= kWorthSaying_rad)
    lines += fmt::format("roll_rad = {:.4f}  {}", tilt->roll_rad, source);
  if (std::abs(tilt->pitch_rad) >= kWorthSaying_rad)
    lines += fmt::format("pitch_rad = {:.4f}  {}", tilt->pitch_rad, source);
  return lines;
}

}  // namespace

std::optional<std::string> rig_with(const CameraMounting& mounting, const std::string& rig_toml) {
  constexpr std::string_view kTable = "[camera]\n";
  const FileResult<Rig> said = read_rig(rig_toml, "rig.toml");
  const std::size_t table = rig_toml.find(kTable);
  if (!said || table == std::string::npos) return std::nullopt;
  const std::string lines = lines_of(mounting, said->camera);
  if (lines.empty()) return std::nullopt;
  std::string text = rig_toml;
  text.insert(table + kTable.size(), lines);
  if (!read_rig(text, "rig.toml")) return std::nullopt;  // the text already contains the key, with zeros
  return text;
}

}  // namespace azimuth
