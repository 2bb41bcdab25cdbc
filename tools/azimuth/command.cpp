#include "tools/azimuth/command.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

namespace azimuth {

void print_error(std::string message) {
  while (!message.empty() && message.back() == '\n') message.pop_back();
  if (!message.empty()) std::fprintf(stderr, "%s\n", message.c_str());
}

void refuse(const std::string& message) { throw CommandError{kBadInput, message}; }
void refuse(const FileErrors& errors) { refuse(text(errors)); }
void fail(const std::string& message) { throw CommandError{kFailure, message}; }

void fail_on(const FileResult<void>& result) {
  if (!result) fail(text(result.error()));
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
    print_error(troubles + "; used " + loaded->file.string());
  }
  return *std::move(loaded);
}

void add_log_options(CLI::App& command, LogOptions& options) {
  command.add_option("--rig", options.rig_file, "rig.toml to use in place of the run's own");
  command.add_option(
      "--odometry-channel", options.odometry_channel,
      "Of the odometry in the log of another program: bot_core.pose_t, or odometry_t; else AZIMUTH_ODOM");
  command.add_option("--image-channel", options.image_channel, "Of the images (image_t) in the log")
      ->capture_default_str();
}

void write_text(const std::string& text, const std::filesystem::path& file) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) fail(file.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace azimuth
