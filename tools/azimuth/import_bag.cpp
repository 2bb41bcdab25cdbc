// azimuth import: the import of ROS bags.

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <string_view>
#include <utility>

#include "base/visible.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/import_options.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/import/bag_file.hpp"
#include "tools/import/bag_run.hpp"
#include "tools/import/bag_topics.hpp"
#include "tools/import/static_frames.hpp"

namespace azimuth {
namespace {

BagFile open_bag(const ImportOptions& options, ProgressBar& bar) {
  FileResult<BagFile> bag = BagFile::open(options.parts, shown_and_interruptible(bar));
  bar.clear();
  if (!bag) refuse(bag.error());
  return *std::move(bag);
}

/// Reads --joints LEFT,RIGHT.
BagWheels wheels_in(const ImportOptions& options) {
  BagWheels wheels{options.wheels, {}, {}};
  if (options.joints.empty()) return wheels;
  const std::size_t comma = options.joints.find(',');
  if (comma == std::string::npos || comma == 0 || comma + 1 == options.joints.size())
    refuse("--joints " + options.joints + ": must have the form LEFT,RIGHT");
  wheels.left = options.joints.substr(0, comma);
  wheels.right = options.joints.substr(comma + 1);
  return wheels;
}

FileResult<BagChoice> choose(const ImportOptions& options, const BagFile& bag) {
  const bool has_wheels = options.wheels.track_m > 0.0 && options.wheels.radius_m > 0.0;
  return choose_topics(options.source.string(), bag.topics(),
                       {options.odometry, options.images, options.truth, has_wheels, options.senders});
}

bool is_same(const std::optional<BagTopic>& chosen, const BagTopic& topic) {
  return chosen && chosen->name == topic.name && chosen->checksum == topic.checksum;
}

std::string taken_as(const FileResult<BagChoice>& choice, const BagTopic& topic) {
  if (choice && is_same(choice->odometry, topic)) return "taken as odometry";
  if (choice && is_same(choice->images, topic)) return "taken as images";
  if (choice && is_same(choice->truth, topic)) return "taken as truth";
  const std::string use = use_of(topic);
  return use.empty() ? "" : "could be " + use;
}

std::string no_message(const ImportOptions& options, const BagFile& bag) {
  const std::string said = options.source.string() + ": holds no message that can be read";
  return bag.damage().empty() ? said : said + " (" + bag.damage() + ')';
}

void tell_damage(const std::string& file, const BagFile& bag) {
  if (!bag.damage().empty())
    print_error(visible(file) + ": " + bag.damage() + ": cut short, or not closed? All else was read");
}

/// Prints a note if the user gave one of several parts of a bag.
void tell_parts(const ImportOptions& options) {
  if (options.parts.size() != 1) return;
  const std::filesystem::path& file = options.parts.front();
  const std::size_t parts = parts_beside(file);
  if (parts > 1)
    print_error(fmt::format("{} is one of {} parts that lie there: azimuth import {} {} takes them all",
                            options.source.string(), parts, std::filesystem::absolute(file).parent_path().string(),
                            options.out.empty() ? "OUT" : options.out.string()));
}

void list_topics(const ImportOptions& options, const BagFile& bag) {
  const FileResult<BagChoice> choice = choose(options, bag);
  const std::vector<BagTopic>& topics = bag.topics();
  if (topics.empty()) refuse(no_message(options, bag));
  const Stamp begin = std::ranges::min(topics, {}, &BagTopic::first).first;
  std::size_t name = 0, type = 0;
  for (const BagTopic& topic : topics) {
    name = std::max(name, topic.name.size());
    type = std::max(type, topic.type.size());
  }
  for (const BagTopic& topic : topics) {
    const std::string line = fmt::format("{:{}}  {:{}}  {:7} messages  {:8.2f} to {:8.2f} s  {}", topic.name, name,
                                         topic.type, type, topic.messages, to_seconds(topic.first - begin),
                                         to_seconds(topic.last - begin), taken_as(choice, topic));
    fmt::print("{}\n", visible(std::string_view(line).substr(0, line.find_last_not_of(' ') + 1)));
  }
  tell_damage(options.source.string(), bag);
  tell_parts(options);
  if (choice)
    fmt::print("next: azimuth import {} OUT\n", shown(options.source));
  else
    print_error(text(choice.error()));
}

std::string place_text(const CameraMounting& mounting) {
  const Eigen::Vector3d& p_m = mounting.p_base_camera_m;
  const CameraTilt tilt = mounting.tilt().value_or(CameraTilt{});
  const std::string leaning = tilt.is_level() ? ""
                                              : fmt::format(", camera.roll_rad = {:.3f}, camera.pitch_rad = {:.3f}",
                                                            tilt.roll_rad, tilt.pitch_rad);
  return fmt::format("/tf_static has {} in {} at camera.position_m = [{:.3f}, {:.3f}], {:.3f} m up{}", mounting.camera,
                     mounting.base, p_m.x(), p_m.y(), p_m.z(), leaning);
}

/// Writes the camera's mounting from /tf_static into the copied rig, or returns it as a note for the user to enter.
std::string take_mounting(const BagFile& bag, const BagChoice& choice, Run& run) {
  const std::optional<CameraMounting> mounting = camera_mounting(bag, choice);
  if (!mounting) return {};
  const std::string says = place_text(*mounting);
  if (run.rig_toml.empty()) return says + ": put that into the rig";
  std::optional<std::string> rig = rig_with(*mounting, run.rig_toml);
  if (!rig) return says + ": the rig is left as it is";
  run.rig_toml = *std::move(rig);
  return says + ", which the rig says now";
}

/// Refuses options that only tables take.
void check_bag_options(const ImportOptions& options) {
  const bool tables = !options.columns.empty() || !options.bearings.empty() || !options.bearings_columns.empty() ||
                      !options.truth_columns.empty() || !options.stamps_columns.empty() || options.stamps != "name";
  if (tables)
    refuse(options.source.string() +
           ": is a bag, of which topics are taken: --odometry, --images, --truth; columns, bearings and stamps are of "
           "tables");
}

}  // namespace

void import_bag(const ImportOptions& options) {
  check_bag_options(options);
  const BagWheels wheels = wheels_in(options);
  if (!options.out.empty()) check_import(options);
  ProgressBar bar(true);
  const BagFile bag = open_bag(options, bar);
  if (options.out.empty()) return list_topics(options, bag);
  if (bag.topics().empty()) refuse(no_message(options, bag));

  const FileResult<BagChoice> choice = choose(options, bag);
  if (!choice) refuse(choice.error());
  BagRun read;
  find_rig(options, read.run);
  const std::string file = options.source.string();
  if (auto samples = read_bag_samples(bag, file, *choice, wheels, read); !samples) refuse(samples.error());
  UnfinishedRun unfinished(options.out);
  std::unique_ptr<BagImages> images = std::make_unique<FolderImages>(options.out, unfinished.files());
  if (is_log_name(options.out)) images = std::make_unique<LogImages>(options.out);
  if (choice->images)
    if (auto frames = read_bag_images(bag, file, *choice->images, *images, read); !frames) refuse(frames.error());
  bar.clear();
  std::vector<std::string> sentences;
  if (std::string mounting = take_mounting(bag, *choice, read.run); !mounting.empty())
    sentences.push_back(std::move(mounting));
  const FileResult<Run> run = finish_bag_run(std::move(read), file, sentences);
  if (!run) refuse(run.error());
  finish_import(options, *run, sentences, unfinished);
  tell_damage(file, bag);
  tell_parts(options);
}

}  // namespace azimuth
