#include "tools/import/bag_run.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "drivers/storage/in_order.hpp"
#include "drivers/wire/bot_odometry.hpp"
#include "drivers/wire/plausible.hpp"
#include "tools/import/ros_message.hpp"

namespace azimuth {
namespace {

std::string not_one(const BagTopic& topic, const std::string& why) {
  return "not one message on " + topic.name + " can be used" + (why.empty() ? "" : ": " + why);
}

/// Calls `use(stamp, message)` for each whole message of a topic; how many are not. Nothing: its definition cannot be
/// understood.
template <class Use>
std::optional<std::uint64_t> each_message(const BagFile& bag, const BagTopic& topic, Use use) {
  std::optional<RosDefinition> definition = RosDefinition::parse(topic.definition, topic.type, topic.version);
  if (!definition) return std::nullopt;
  RosMessage message(*std::move(definition));
  std::uint64_t cut = 0;
  bag.each(topic, [&](Stamp recorded, Bytes bytes) {
    if (message.read(bytes))
      use(message.time("header.stamp").value_or(recorded), message);
    else
      ++cut;
  });
  return cut;
}

FileError no_definition(const std::string& file, const BagTopic& topic) {
  return {file, 0, "the definition of " + topic.type + " that it carries for " + topic.name + " makes no sense"};
}

/// The poses of a topic, made into samples by `make(stamp, pose)`.
template <class Sample, class PoseOf, class Make>
FileResult<std::vector<Sample>> read_poses(const BagFile& bag, const std::string& file, const BagTopic& topic,
                                           PoseOf pose, Make make, Skipped& skipped, std::uint64_t& not_in_order) {
  std::vector<Sample> samples;
  const auto cut_short = each_message(bag, topic, [&](Stamp stamp, const RosMessage& message) {
    const std::optional<Pose2> at = pose(message);
    if (at)
      samples.push_back(make(stamp, *at));
    else
      ++skipped.malformed_messages;
  });
  if (!cut_short) return failure(no_definition(file, topic));
  skipped.malformed_messages += *cut_short;
  if (samples.empty()) return failure(FileError{file, 0, not_one(topic, "no sound pose in it")});
  not_in_order = keep_in_order(samples);
  return samples;
}

/// Poses from what the wheels have rolled.
class JointPath {
 public:
  explicit JointPath(const BagWheels& wheels) : wheels_(wheels), path_(wheels.wheels.track_m) {}

  std::optional<Pose2> operator()(const RosMessage& message) {
    const auto angles = wheels_of(message, wheels_.left, wheels_.right);
    const double radius_m = wheels_.wheels.radius_m;
    if (!angles || !is_plausible_coordinate(angles->left_rad) || !is_plausible_coordinate(angles->right_rad))
      return std::nullopt;
    return path_.at(radius_m * angles->left_rad, radius_m * angles->right_rad);
  }

 private:
  const BagWheels& wheels_;
  WheelPath path_;
};

FileResult<std::vector<OdometryReading>> read_odometry(const BagFile& bag, const std::string& file,
                                                       const BagTopic& topic, const BagWheels& wheels,
                                                       Skipped& skipped) {
  const auto make = [](Stamp stamp, const Pose2& pose) { return OdometryReading{.stamp = stamp, .T_odom_body = pose}; };
  std::uint64_t& not_in_order = skipped.odometry_not_in_order;
  auto readings = topic.type == "sensor_msgs/JointState"
                      ? read_poses<OdometryReading>(bag, file, topic, JointPath(wheels), make, skipped, not_in_order)
                      : read_poses<OdometryReading>(bag, file, topic, pose_of, make, skipped, not_in_order);
  if (readings) number_odometry(*readings);
  return readings;
}

}  // namespace

FileResult<void> read_bag_samples(const BagFile& bag, const std::string& file, const BagChoice& choice,
                                  const BagWheels& wheels, Run& run) {
  FileErrors errors;
  const auto keep = [&errors](auto read, auto& samples) {
    if (read)
      samples = *std::move(read);
    else
      errors.insert(errors.end(), read.error().begin(), read.error().end());
  };
  if (choice.odometry) keep(read_odometry(bag, file, *choice.odometry, wheels, run.skipped), run.odometry);
  const auto make = [](Stamp stamp, const Pose2& pose) { return TruthPose{.stamp = stamp, .T_world_body = pose}; };
  if (choice.truth)
    keep(read_poses<TruthPose>(bag, file, *choice.truth, pose_of, make, run.skipped, run.skipped.truth_not_in_order),
         run.truth);
  if (!errors.empty()) return failure(std::move(errors));
  return {};
}

FileResult<void> read_bag_images(const BagFile& bag, const std::string& file, const BagTopic& topic, BagImages& images,
                                 Run& run) {
  FileErrors errors;
  std::string unsupported;
  const auto cut_short = each_message(bag, topic, [&](Stamp stamp, const RosMessage& message) {
    if (!errors.empty()) return;
    const RosImage image = image_of(message);
    if (image.image.bytes.empty()) {
      ++(image.unsupported.empty() ? run.skipped.malformed_messages : run.skipped.unsupported_images);
      if (!image.unsupported.empty()) unsupported = image.unsupported;
      return;
    }
    FileResult<FrameFile> frame = images.keep(run.frames.size(), stamp, image.image);
    if (frame)
      run.frames.push_back(*std::move(frame));
    else
      errors = frame.error();
  });
  if (!cut_short) return failure(no_definition(file, topic));
  run.skipped.malformed_messages += *cut_short;
  if (errors.empty() && run.frames.empty())
    errors.push_back({file, 0, not_one(topic, unsupported.empty() ? "" : "its images are " + unsupported)});
  if (!errors.empty()) return failure(std::move(errors));
  run.skipped.frames_not_in_order = keep_in_order(run.frames);
  return {};
}

}  // namespace azimuth
