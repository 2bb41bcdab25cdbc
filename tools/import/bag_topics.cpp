#include "tools/import/bag_topics.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>
#include <utility>

#include "settings/suggestion.hpp"

namespace azimuth {
namespace {

bool is_odometry(const BagTopic& topic) { return topic.type == "nav_msgs/Odometry"; }
bool are_joints(const BagTopic& topic) { return topic.type == "sensor_msgs/JointState"; }
bool are_images(const BagTopic& topic) {
  return topic.type == "sensor_msgs/Image" || topic.type == "sensor_msgs/CompressedImage";
}
bool are_poses(const BagTopic& topic) {
  return is_odometry(topic) || topic.type == "geometry_msgs/PoseStamped" ||
         topic.type == "geometry_msgs/PoseWithCovarianceStamped";
}

using Fits = std::function<bool(const BagTopic&)>;

/// Chooses among the topics of one bag and collects errors.
struct Chooser {
  const std::string& file;
  const std::vector<BagTopic>& topics;
  FileErrors errors;

  void fail(std::string message) { errors.push_back({file, 0, std::move(message)}); }

  std::optional<BagTopic> named(const std::string& name, const Fits& fits, const char* option) {
    std::vector<std::string_view> names;
    std::string type;
    for (const BagTopic& topic : topics) {
      names.push_back(topic.name);
      if (topic.name == name && fits(topic)) return topic;
      if (topic.name == name) type = topic.type;
    }
    const std::optional<std::string_view> meant = nearest(name, names);
    if (!type.empty())
      fail("topic " + name + " is of " + type + ", which " + option + " cannot use");
    else
      fail("has no topic " + name + (meant ? "; did you mean " + std::string(*meant) + '?' : std::string()));
    return std::nullopt;
  }

  /// The only suitable topic. Nothing if there is none, or, with an error, if there are several.
  std::optional<BagTopic> only(const Fits& fits, const char* what, const char* option) {
    std::vector<const BagTopic*> found;
    for (const BagTopic& topic : topics)
      if (fits(topic)) found.push_back(&topic);
    if (found.size() == 1) return *found.front();
    std::string names;
    for (const BagTopic* topic : found) names += (names.empty() ? "" : ", ") + topic->name;
    if (!found.empty()) fail("has several topics of " + std::string(what) + ": " + names + "; choose by " + option);
    return std::nullopt;
  }
};

/// True if two senders send at the same time. A restarted sender may get another name or channel, but does not overlap.
bool are_mixed(std::vector<BagSender> senders) {
  constexpr Duration kHandover{1'000'000};
  std::ranges::sort(senders, {}, &BagSender::first);
  const auto overlap = [&](const BagSender& a, const BagSender& b) { return b.first + kHandover <= a.last; };
  return std::ranges::adjacent_find(senders, overlap) != senders.end();
}

/// Selects the requested sender. Joints may have several senders, since they are distinguished by name.
void choose_sender(Chooser& chooser, BagTopic& topic, const std::vector<std::string>& wishes) {
  for (const std::string& wish : wishes)
    if (std::ranges::count(topic.senders, wish, &BagSender::name) > 0) topic.sender = wish;
  if (topic.sender.empty() && are_mixed(topic.senders) && !are_joints(topic))
    chooser.fail("on " + topic.name + " several send at once: " + senders_of(topic) +
                 "; choose by --sender NAME, or they are mixed");
}

/// A requested name that is no sender of any topic is a frame of the odometry.
void choose_frame(BagChoice& choice, const std::vector<std::string>& wishes) {
  for (const std::string& wish : wishes) {
    const bool is_sender = std::ranges::any_of(std::array{&choice.odometry, &choice.images, &choice.truth},
                                               [&](const auto* topic) { return *topic && (*topic)->sender == wish; });
    if (!is_sender && choice.odometry) choice.odometry->frame = wish;
  }
}

std::optional<BagTopic> choose_odometry(Chooser& chooser, const BagWishes& wishes) {
  constexpr const char* kOption = "--odometry TOPIC";
  const Fits with_wheels = [&](const BagTopic& topic) { return wishes.has_wheels && are_joints(topic); };
  const Fits any = [&](const BagTopic& topic) { return are_poses(topic) || with_wheels(topic); };
  if (!wishes.odometry.empty()) return chooser.named(wishes.odometry, any, kOption);
  const std::size_t errors = chooser.errors.size();
  std::optional<BagTopic> found = chooser.only(is_odometry, "odometry", kOption);
  if (!found && chooser.errors.size() == errors) found = chooser.only(with_wheels, "wheels", kOption);
  if (found || chooser.errors.size() != errors) return found;
  const bool joints = std::ranges::any_of(chooser.topics, are_joints);
  const bool poses = std::ranges::any_of(chooser.topics, are_poses);
  chooser.fail(std::string("has no odometry: no topic of nav_msgs/Odometry") +
               (joints ? "; sensor_msgs/JointState needs --track METRES and --wheel-radius METRES" : "") +
               (poses ? "; poses count as odometry when named, --odometry TOPIC" : ""));
  return std::nullopt;
}

}  // namespace

std::string senders_of(const BagTopic& topic) {
  std::string senders;
  for (const BagSender& sender : topic.senders)
    senders += (senders.empty() ? "" : ", ") + sender.name + " (" + std::to_string(sender.messages) + " messages)";
  return senders;
}

std::string use_of(const BagTopic& topic) {
  if (is_odometry(topic)) return "odometry";
  if (are_images(topic)) return "images";
  if (are_joints(topic)) return "wheels";
  return are_poses(topic) ? "poses" : "";
}

FileResult<BagChoice> choose_topics(const std::string& file, const std::vector<BagTopic>& topics,
                                    const BagWishes& wishes) {
  Chooser chooser{file, topics, {}};
  BagChoice choice;
  choice.odometry = choose_odometry(chooser, wishes);
  constexpr const char* kImages = "--images TOPIC";
  choice.images = wishes.images.empty() ? chooser.only(are_images, "images", kImages)
                                        : chooser.named(wishes.images, are_images, kImages);
  if (!wishes.truth.empty()) choice.truth = chooser.named(wishes.truth, are_poses, "--truth TOPIC");
  for (std::optional<BagTopic>* topic : {&choice.odometry, &choice.images, &choice.truth})
    if (*topic) choose_sender(chooser, **topic, wishes.senders);
  choose_frame(choice, wishes.senders);
  if (!chooser.errors.empty()) return failure(std::move(chooser.errors));
  return choice;
}

}  // namespace azimuth
