#include "tools/azimuth/command.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

#include "base/visible.hpp"

namespace azimuth {

void print_error(std::string message) {
  while (!message.empty() && message.back() == '\n') message.pop_back();
  if (!message.empty()) std::fprintf(stderr, "%s\n", visible_lines(message).c_str());
}

std::string shown(const std::filesystem::path& file) { return visible(file.string()); }

void refuse(const std::string& message) { throw CommandError{kBadInput, visible(message)}; }
void refuse(const FileErrors& errors) { throw CommandError{kBadInput, text(errors)}; }
void fail(const std::string& message) { throw CommandError{kFailure, visible(message)}; }
void fail(const FileErrors& errors) { throw CommandError{kFailure, text(errors)}; }

void fail_on(const FileResult<void>& result) {
  if (!result) fail(result.error());
}

Run load_run_or_refuse(const std::filesystem::path& path, const LogOptions& options) {
  FileResult<Run> run = load_run(path, options);
  if (!run) refuse(run.error());
  return *std::move(run);
}

LoadedMap load_map_or_refuse(const std::filesystem::path& file) {
  FileResult<LoadedMap> loaded = read_map(file);
  if (!loaded) refuse(loaded.error());
  if (std::string troubles = text(loaded->troubles); !troubles.empty()) {
    troubles.pop_back();  // the end of its last line
    print_error(troubles + "; used " + shown(loaded->file));
  }
  return *std::move(loaded);
}

void add_channel_options(CLI::App& command, LogOptions& options) {
  command.add_option(
      "--odometry-channel", options.odometry_channel,
      "Channel of odometry in the LCM log of another program (bot_core.pose_t or odometry_t); without it AZIMUTH_ODOM");
  command.add_option("--image-channel", options.image_channel, "Channel of images (image_t) in an LCM log")
      ->capture_default_str();
}

void add_log_options(CLI::App& command, LogOptions& options) {
  command.add_option("--rig", options.rig_file, "rig.toml that replaces the run's own");
  add_channel_options(command, options);
}

void write_text(const std::string& text, const std::filesystem::path& file) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) fail(file.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace azimuth
