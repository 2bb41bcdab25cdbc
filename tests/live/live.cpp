#include "tests/live/live.hpp"

#include "tests/live/text.hpp"
#include "tests/support/places.hpp"

namespace azimuth::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> command(const fs::path& folder, const fs::path& rig, const std::vector<std::string>& more,
                                 const std::string& lcm_url) {
  std::vector<std::string> words{AZIMUTHD,
                                 "--config",
                                 source_folder() / "config/simulated-robot.toml",
                                 "--rig",
                                 rig,
                                 "--lcm-url",
                                 lcm_url,
                                 "--set",
                                 "daemon.pioneer.device=" + Robot::device(folder).string(),
                                 "--set",
                                 "daemon.live.camera_socket=" + Robot::camera(folder).string(),
                                 "--set",
                                 "daemon.record.min_free_mb=0"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

Daemon::Daemon(const fs::path& folder, const fs::path& rig, const std::vector<std::string>& more,
               const std::string& lcm_url)
    : ChildProcess(command(folder, rig, more, lcm_url), folder) {}

bool Daemon::logs(const std::string& text, std::size_t times) const {
  return eventually([&] { return occurrences(standard_error(), text) >= times; }, kPatience);
}

bool Daemon::has_landmarks(int count) const {
  return eventually([&] { return last_number_before(standard_error(), "landmarks") >= count; }, kPatience);
}

std::optional<int> Daemon::stop() {
  signal(SIGTERM);
  return wait(kPatience);
}

void Daemon::kill() {
  signal(SIGKILL);
  wait(kPatience);
}

std::unique_ptr<Daemon> Live::recording_daemon(const std::vector<std::string>& more) const {
  std::vector<std::string> options{"--status", "--record", records()};
  options.insert(options.end(), more.begin(), more.end());
  return std::make_unique<Daemon>(folder(), rig_, options);
}

}  // namespace azimuth::test
