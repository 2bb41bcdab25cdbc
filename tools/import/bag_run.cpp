#include "tools/import/bag_run.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <tuple>
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

/// Counts the frames in the messages of one topic. Alternating frames mean several robots or several estimates.
class FrameTally {
 public:
  explicit FrameTally(std::string wish) : wish_(std::move(wish)) {}

  /// True if the message has the requested frame, or if no frame is requested.
  bool take(const RosMessage& message) {
    const std::string frames = frames_of(message);
    ++counts_[frames];
    if (frames != last_) ++changes_;
    last_ = frames;
    return wish_.empty() || frames == wish_ || frames.ends_with("-> " + wish_) || frames.starts_with(wish_ + " ->");
  }
  /// Few changes do not count as mixed, since a restarted sender may use another frame.
  bool are_mixed() const { return wish_.empty() && counts_.size() > 1 && changes_ > 2 * counts_.size(); }
  std::string text() const {
    std::string words;
    for (const auto& [frames, count] : counts_)
      words += (words.empty() ? "" : ", ") + (frames.empty() ? "none" : frames) + " (" + std::to_string(count) +
               " messages)";
    return words;
  }

 private:
  std::string wish_, last_;
  std::map<std::string, std::uint64_t> counts_;
  std::size_t changes_ = 0;
};

/// Stamp and arrival of a message.
struct Came {
  Stamp stamp{};
  Arrival arrival;
};

/// Calls `use(came, message)` for each complete message of a topic with the requested frame. Returns the number of
/// incomplete messages. Fails if the message definition is not understood or if frames are mixed.
template <class Use>
FileResult<std::uint64_t> each_message(const BagFile& bag, const std::string& file, const BagTopic& topic, Use use) {
  std::optional<RosDefinition> definition = RosDefinition::parse(topic.definition, topic.type, topic.version);
  if (!definition)
    return failure(FileError{
        file, 0, "the definition of " + topic.type + " that it carries for " + topic.name + " makes no sense"});
  RosMessage message(*std::move(definition));
  FrameTally frames(topic.frame);
  const bool may_be_mixed = topic.type == "sensor_msgs/JointState";  // joints are distinguished by name
  std::uint64_t cut = 0, used = 0;
  bag.each(topic, [&](const Arrival& arrival, Bytes bytes) {
    if (!message.read(bytes)) return void(++cut);
    if (!frames.take(message) || (!may_be_mixed && frames.are_mixed())) return;
    ++used;
    use(Came{message.time("header.stamp").value_or(arrival.recorded), arrival}, message);
  });
  if (!may_be_mixed && frames.are_mixed())
    return failure(FileError{file, 0,
                             "the messages on " + topic.name + " are of several frames by turns: " + frames.text() +
                                 "; choose by --sender FRAME, or their poses are mixed"});
  if (!topic.frame.empty() && used == 0)
    return failure(FileError{file, 0,
                             "--sender " + topic.frame + ": nobody sends so on " + topic.name + ": there are " +
                                 senders_of(topic) + ", of the frames " + frames.text()});
  return cut;
}

struct Poses {
  std::vector<std::pair<Came, Pose2>> poses;
  std::uint64_t unsound = 0;
  std::string why;  ///< reason for the last unsound message; empty if unknown
};

/// The poses of a topic. `pose(message, stamp, why)` returns nothing for an unsound message and writes the reason to
/// `why`.
template <class PoseOf>
FileResult<Poses> read_poses(const BagFile& bag, const std::string& file, const BagTopic& topic, PoseOf pose) {
  Poses read;
  const auto cut = each_message(bag, file, topic, [&](const Came& came, const RosMessage& message) {
    if (const std::optional<Pose2> at = pose(message, came.stamp, read.why))
      read.poses.emplace_back(came, *at);
    else
      ++read.unsound;
  });
  if (!cut) return failure(cut.error());
  if (read.poses.empty())
    return failure(FileError{file, 0, not_one(topic, read.why.empty() ? "no sound pose in it" : read.why)});
  read.unsound += *cut;
  return read;
}

constexpr const char* kUnset = "its orientation is unset (a quaternion of zeros): its sender fills in positions alone";

std::optional<Pose2> pose_in(const RosMessage& message, Stamp, std::string& why) {
  std::optional<Pose2> pose = pose_of(message);
  if (!pose && has_unset_orientation(message)) why = kUnset;
  return pose;
}

/// Stores the distances that the wheels have rolled, and computes poses that are valid as long as no counter wraps.
class JointPath {
 public:
  JointPath(const BagWheels& wheels, std::vector<WheelReading>& rolled)
      : wheels_(wheels), rolled_(rolled), path_(wheels.wheels.track_m) {}

  std::optional<Pose2> operator()(const RosMessage& message, Stamp stamp, std::string& why) {
    const auto angles = wheels_of(message, wheels_.left, wheels_.right);
    if (!angles) {
      why = "its joints are " + joints_of(message) +
            ": --joints LEFT,RIGHT says which are the wheels (of four wheels, one of each side)";
      return std::nullopt;
    }
    const double radius_m = wheels_.wheels.radius_m;
    if (!is_plausible_coordinate(angles->left_rad) || !is_plausible_coordinate(angles->right_rad)) return std::nullopt;
    rolled_.push_back({stamp, radius_m * angles->left_rad, radius_m * angles->right_rad});
    return path_.at(rolled_.back().left_m, rolled_.back().right_m);
  }

 private:
  const BagWheels& wheels_;
  std::vector<WheelReading>& rolled_;
  WheelPath path_;
};

/// Integrates speeds to poses. Each speed applies to the interval since the previous message.
class TwistPath {
 public:
  std::optional<Pose2> operator()(const RosMessage& message, Stamp stamp, std::string& why) {
    const std::optional<RosTwist> twist = twist_of(message);
    if (!twist || (before_ && stamp <= *before_)) return std::nullopt;
    const double waited_s = before_ ? to_seconds(stamp - *before_) : 0.0;
    before_ = stamp;
    moves_ = moves_ || twist->turn_rad_s != 0.0;
    why = kUnset;
    return path_.drive(waited_s * twist->speed_m_s, waited_s * twist->turn_rad_s);
  }
  bool has_turned() const { return moves_; }

 private:
  WheelPath path_{1.0};
  std::optional<Stamp> before_;
  bool moves_ = false;
};

/// Poses for odometry without orientation, computed from its speeds, unless these are unset as well.
FileResult<Poses> by_speeds(const BagFile& bag, const std::string& file, const BagTopic& topic, BagRun& read) {
  TwistPath path;
  FileResult<Poses> poses =
      read_poses(bag, file, topic, [&path](const RosMessage& message, Stamp stamp, std::string& why) {
        return has_unset_orientation(message) ? path(message, stamp, why) : std::nullopt;
      });
  if (!poses || !path.has_turned())
    return failure(FileError{
        file, 0,
        not_one(topic, std::string(kUnset) + ", and no turn rate either. Nothing says where the robot heads: take "
                                             "another topic of odometry, or sensor_msgs/JointState of its wheels "
                                             "with --track and --wheel-radius")});
  read.notes.push_back(file + ": on " + topic.name + ' ' + kUnset +
                       "; the odometry is made from its twist (speed and turn rate) instead");
  return poses;
}

FileResult<Poses> odometry_poses(const BagFile& bag, const std::string& file, const BagTopic& topic,
                                 const BagWheels& wheels, BagRun& read) {
  if (topic.type == "sensor_msgs/JointState") {
    read.wheels = wheels.wheels;
    return read_poses(bag, file, topic, JointPath(wheels, read.rolled));
  }
  FileResult<Poses> poses = read_poses(bag, file, topic, pose_in);
  const bool is_unset = !poses && poses.error().front().message.find(kUnset) != std::string::npos;
  if (!is_unset || topic.type != "nav_msgs/Odometry") return poses;
  return by_speeds(bag, file, topic, read);
}

/// Odometry from the wheels, with the corrected stamps.
FileResult<std::vector<OdometryReading>> rolled_odometry(const BagRun& read, const std::string& file,
                                                         std::vector<std::string>& notes) {
  std::vector<WheelReading> rolled;
  for (const OdometryReading& reading : read.run.odometry) {
    rolled.push_back(read.rolled[reading.sequence]);
    rolled.back().stamp = reading.stamp;
  }
  const double radius_m = read.wheels.radius_m;
  return wheel_odometry(std::move(rolled), {radius_m, radius_m}, read.wheels.track_m, file, notes);
}

}  // namespace

FileResult<void> read_bag_samples(const BagFile& bag, const std::string& file, const BagChoice& choice,
                                  const BagWheels& wheels, BagRun& read) {
  FileErrors errors;
  const auto take = [&](const FileResult<Poses>& poses, std::vector<Arrival>& arrivals, auto use) {
    if (!poses) {
      errors.insert(errors.end(), poses.error().begin(), poses.error().end());
      return;
    }
    read.run.skipped.malformed_messages += poses->unsound;
    for (const auto& [came, pose] : poses->poses) {
      arrivals.push_back(came.arrival);
      use(came.stamp, pose);
    }
  };
  if (choice.odometry)
    take(odometry_poses(bag, file, *choice.odometry, wheels, read), read.odometry, [&](Stamp stamp, const Pose2& pose) {
      read.run.odometry.push_back({.stamp = stamp, .sequence = read.run.odometry.size(), .T_odom_body = pose});
    });
  if (choice.truth)
    take(read_poses(bag, file, *choice.truth, pose_in), read.truth,
         [&](Stamp stamp, const Pose2& pose) { read.run.truth.push_back({.stamp = stamp, .T_world_body = pose}); });
  if (!errors.empty()) return failure(std::move(errors));
  return {};
}

FileResult<void> read_bag_images(const BagFile& bag, const std::string& file, const BagTopic& topic, BagImages& images,
                                 BagRun& read) {
  FileErrors errors;
  std::string unsupported;
  Run& run = read.run;
  std::vector<std::byte> changed;
  const auto cut = each_message(bag, file, topic, [&](const Came& came, const RosMessage& message) {
    if (!errors.empty()) return;
    const RosImage image = image_of(message, changed);
    if (image.image.bytes.empty()) {
      ++(image.unsupported.empty() ? run.skipped.malformed_messages : run.skipped.unsupported_images);
      if (!image.unsupported.empty()) unsupported = image.unsupported;
      return;
    }
    FileResult<FrameFile> frame = images.keep(run.frames.size(), came.stamp, image.image);
    if (!frame) {
      errors = frame.error();
      return;
    }
    run.frames.push_back(*std::move(frame));
    read.frames.push_back(came.arrival);
  });
  if (!cut) return failure(cut.error());
  run.skipped.malformed_messages += *cut;
  if (errors.empty() && run.frames.empty())
    errors.push_back({file, 0, not_one(topic, unsupported.empty() ? "" : "its images are " + unsupported)});
  if (!errors.empty()) return failure(std::move(errors));
  return {};
}

FileResult<Run> finish_bag_run(BagRun read, const std::string& file, std::vector<std::string>& notes) {
  Run& run = read.run;
  Skipped& skipped = run.skipped;
  skipped.clock_jumps = mend_clock_jumps(read.odometry, run.odometry, skipped.odometry_not_in_order,
                                         std::tie(read.frames, run.frames, skipped.frames_not_in_order),
                                         std::tie(read.truth, run.truth, skipped.truth_not_in_order));
  skipped.odometry_not_in_order += keep_in_order(run.odometry);
  skipped.frames_not_in_order += keep_in_order(run.frames);
  skipped.truth_not_in_order += keep_in_order(run.truth);
  notes.insert(notes.end(), read.notes.begin(), read.notes.end());
  if (read.rolled.empty()) {
    number_odometry(run.odometry);
  } else if (FileResult<std::vector<OdometryReading>> odometry = rolled_odometry(read, file, notes)) {
    run.odometry = *std::move(odometry);
  } else {
    return failure(odometry.error());
  }
  return std::move(run);
}

}  // namespace azimuth
