#include "tools/import/bag_run.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "drivers/storage/in_order.hpp"
#include "drivers/wire/bot_odometry.hpp"
#include "drivers/wire/plausible.hpp"
#include "tools/import/ros_message.hpp"
#include "tools/import/wheel_odometry.hpp"

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

constexpr const char* kNoPose = "no sound pose in it";

/// What `value(message)` finds in the messages of a topic, made into samples by `make(stamp, value)`; `none`: that it
/// finds nothing.
template <class Sample, class ValueOf, class Make>
FileResult<std::vector<Sample>> read_samples(const BagFile& bag, const std::string& file, const BagTopic& topic,
                                             ValueOf value, Make make, const char* none, Skipped& skipped,
                                             std::uint64_t& not_in_order) {
  std::vector<Sample> samples;
  const auto cut_short = each_message(bag, topic, [&](Stamp stamp, const RosMessage& message) {
    if (const auto found = value(message))
      samples.push_back(make(stamp, *found));
    else
      ++skipped.malformed_messages;
  });
  if (!cut_short) return failure(no_definition(file, topic));
  skipped.malformed_messages += *cut_short;
  if (samples.empty()) return failure(FileError{file, 0, not_one(topic, none)});
  not_in_order = keep_in_order(samples);
  return samples;
}

/// From what the wheels have rolled.
FileResult<std::vector<OdometryReading>> read_wheels(const BagFile& bag, const std::string& file, const BagTopic& topic,
                                                     const BagWheels& wheels, Skipped& skipped,
                                                     std::vector<std::string>& notes) {
  const auto angles = [&](const RosMessage& message) {
    auto read = wheels_of(message, wheels.left, wheels.right);
    const bool good = read && is_plausible_coordinate(read->left_rad) && is_plausible_coordinate(read->right_rad);
    return good ? read : std::nullopt;
  };
  const double radius_m = wheels.wheels.radius_m;
  const auto make = [radius_m](Stamp stamp, const WheelAngles& read) {
    return WheelReading{stamp, radius_m * read.left_rad, radius_m * read.right_rad};
  };
  auto rolled = read_samples<WheelReading>(bag, file, topic, angles, make, "no angles of two wheels in it", skipped,
                                           skipped.odometry_not_in_order);
  if (!rolled) return failure(rolled.error());
  return wheel_odometry(*std::move(rolled), {radius_m, radius_m}, wheels.wheels.track_m, file, notes);
}

FileResult<std::vector<OdometryReading>> read_odometry(const BagFile& bag, const std::string& file,
                                                       const BagTopic& topic, const BagWheels& wheels, Skipped& skipped,
                                                       std::vector<std::string>& notes) {
  if (topic.type == "sensor_msgs/JointState") return read_wheels(bag, file, topic, wheels, skipped, notes);
  const auto make = [](Stamp stamp, const Pose2& pose) { return OdometryReading{.stamp = stamp, .T_odom_body = pose}; };
  auto readings =
      read_samples<OdometryReading>(bag, file, topic, pose_of, make, kNoPose, skipped, skipped.odometry_not_in_order);
  if (readings) number_odometry(*readings);
  return readings;
}

}  // namespace

FileResult<void> read_bag_samples(const BagFile& bag, const std::string& file, const BagChoice& choice,
                                  const BagWheels& wheels, Run& run, std::vector<std::string>& notes) {
  FileErrors errors;
  const auto keep = [&errors](auto read, auto& samples) {
    if (read)
      samples = *std::move(read);
    else
      errors.insert(errors.end(), read.error().begin(), read.error().end());
  };
  if (choice.odometry) keep(read_odometry(bag, file, *choice.odometry, wheels, run.skipped, notes), run.odometry);
  const auto make = [](Stamp stamp, const Pose2& pose) { return TruthPose{.stamp = stamp, .T_world_body = pose}; };
  if (choice.truth)
    keep(read_samples<TruthPose>(bag, file, *choice.truth, pose_of, make, kNoPose, run.skipped,
                                 run.skipped.truth_not_in_order),
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
