#include "tests/live/robot.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>

#include "base/unique_fd.hpp"
#include "tests/live/text.hpp"

namespace azimuth::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> command(const fs::path& folder, const std::vector<std::string>& more) {
  std::vector<std::string> words{AZIMUTH_SIM,     "--camera-socket",       Robot::camera(folder),
                                 "--control",     folder / "control.sock", "--run-folder",
                                 folder / "drive"};
  if (std::ranges::find(more, "--tcp") == more.end()) words.insert(words.end(), {"--device", Robot::device(folder)});
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

UniqueFd connect_to(const fs::path& path) {
  UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_un where{};
  where.sun_family = AF_UNIX;
  path.native().copy(where.sun_path, sizeof where.sun_path - 1);
  if (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&where), sizeof where) != 0) return UniqueFd();
  return fd;
}

}  // namespace

Robot::Robot(fs::path folder, const std::vector<std::string>& more)
    : folder_(std::move(folder)), process_(command(folder_, more), folder_) {
  if (!tells("robot at")) throw std::runtime_error("azimuth-sim does not start: " + process_.standard_error());
}

fs::path Robot::write_rig(const fs::path& folder, const std::vector<std::string>& more) {
  const fs::path drive = folder / "rig";
  std::vector<std::string> words{AZIMUTH_SIM, "--tcp",           "0",           "--duration", "0.3", "--run-folder",
                                 drive,       "--camera-socket", camera(folder)};
  words.insert(words.end(), more.begin(), more.end());
  ChildProcess robot(words, folder);
  EXPECT_EQ(robot.wait(kPatience), 0) << robot.standard_error();
  return drive / "rig.toml";
}

std::uint16_t Robot::port() const {
  const std::string all = told(), at = "robot at tcp:127.0.0.1:";
  return static_cast<std::uint16_t>(std::stoi(all.substr(all.find(at) + at.size())));
}

std::string Robot::obey(const std::string& command) const {
  const UniqueFd socket = connect_to(folder_ / "control.sock");
  const std::string line = command + '\n';
  if (!socket || ::send(socket.get(), line.data(), line.size(), MSG_NOSIGNAL) < 0) return {};
  std::array<char, 512> answer{};
  const ssize_t size = ::recv(socket.get(), answer.data(), answer.size(), 0);
  return {answer.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
}

bool Robot::tells(const std::string& news, std::size_t times) const {
  return eventually([&] { return occurrences(told(), news) >= times; }, kPatience);
}

std::optional<int> Robot::end(int signal) {
  process_.signal(signal);
  return process_.wait(kPatience);
}

Run Robot::truth() const {
  FileResult<Run> run = load_run(folder_ / "drive");
  if (!run) throw std::runtime_error(text(run.error()));
  return *std::move(run);
}

/// Each line of azimuth-sim begins with the time since its start, as in "[    1.645] session open". The true drive
/// starts at the same instant.
Stamp Robot::when(const std::string& news) const {
  const std::string all = told();
  const std::size_t at = all.find("] " + news);
  if (at == std::string::npos) throw std::runtime_error("azimuth-sim never told: " + news);
  const double time_s = std::stod(all.substr(all.rfind('[', at) + 1));
  return truth().truth.front().stamp + duration_from_seconds(time_s);
}

}  // namespace azimuth::test
