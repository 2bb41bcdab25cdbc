#include "tests/sim/azimuth_sim/sim_process.hpp"

#include <arpa/inet.h>
#include <array>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <utility>

namespace azimuth::sim {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kPatience = 10s;  // for a loaded machine; the waits normally end much earlier

bool wait_readable(int fd, std::chrono::milliseconds limit) {
  pollfd ready{fd, POLLIN, 0};
  return ::poll(&ready, 1, static_cast<int>(std::max(limit, 0ms).count())) == 1;
}

std::pair<UniqueFd, UniqueFd> make_pipe() {
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return {};
  return {UniqueFd(ends[0]), UniqueFd(ends[1])};
}

speed_t speed_code(int baud) {
  switch (baud) {
    case 19200:
      return B19200;
    case 38400:
      return B38400;
    case 57600:
      return B57600;
    case 115200:
      return B115200;
    default:
      return B9600;
  }
}

}  // namespace

SimProcess::SimProcess(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), AZIMUTH_SIM);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  auto [child_input, input] = make_pipe();
  auto [output, child_output] = make_pipe();
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::dup2(child_input.get(), STDIN_FILENO);
    ::dup2(child_output.get(), STDOUT_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  pid_ = pid;  // NOLINT(cppcoreguidelines-prefer-member-initializer): argv comes first
  input_ = std::move(input);
  output_ = std::move(output);
}

SimProcess::~SimProcess() {
  if (pid_ > 0) end(SIGKILL);
}

void SimProcess::say(const std::string& line) const {
  const std::string text = line + "\n";
  [[maybe_unused]] const auto written = ::write(input_.get(), text.data(), text.size());
}

std::optional<std::string> SimProcess::output_until(const std::string& text) {
  const auto deadline = Clock::now() + kPatience;
  while (heard_.find(text) == std::string::npos) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    std::array<char, 512> buffer{};
    if (!wait_readable(output_.get(), left)) return std::nullopt;
    const ssize_t count = ::read(output_.get(), buffer.data(), buffer.size());
    if (count <= 0) return std::nullopt;
    heard_.append(buffer.data(), static_cast<std::size_t>(count));
  }
  const std::size_t end = heard_.find('\n', heard_.find(text));
  std::string output = heard_.substr(0, end);
  heard_.erase(0, output.size());
  return output;
}

int SimProcess::end(int signal) {
  if (signal != 0) ::kill(pid_, signal);
  int status = 0;
  for (auto deadline = Clock::now() + kPatience; ::waitpid(pid_, &status, WNOHANG) == 0; ::usleep(5000)) {
    if (Clock::now() < deadline) continue;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, &status, 0);
    break;
  }
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

UniqueFd open_serial(const std::string& path, int baud) {
  UniqueFd fd(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (fd) set_baud(fd.get(), baud);
  return fd;
}

void set_baud(int fd, int baud) {
  termios settings{};
  ::tcgetattr(fd, &settings);
  ::cfmakeraw(&settings);
  ::cfsetspeed(&settings, speed_code(baud));
  ::tcsetattr(fd, TCSANOW, &settings);
}

UniqueFd connect_tcp(int port) {
  UniqueFd fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  where.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::connect(fd.get(), reinterpret_cast<sockaddr*>(&where), sizeof where) != 0) return UniqueFd();
  return fd;
}

bool WireClient::send(const pioneer::Frame& frame) const {
  return ::write(fd_.get(), frame.bytes.data(), frame.size) == static_cast<ssize_t>(frame.size);
}

void WireClient::read_for(std::chrono::milliseconds patience) {
  if (hung_up_ || !wait_readable(fd_.get(), patience)) return;
  std::array<std::uint8_t, 256> buffer{};
  const ssize_t count = ::read(fd_.get(), buffer.data(), buffer.size());
  hung_up_ = count <= 0 && !(count < 0 && errno == EAGAIN);
  if (count <= 0) return;
  bytes_ += static_cast<std::size_t>(count);
  scanner_.add(pioneer::ByteView(buffer).first(static_cast<std::size_t>(count)), {});
  while (const auto packet = scanner_.next()) packets_.emplace_back(packet->data.begin(), packet->data.end());
}

std::vector<PacketBytes> WireClient::listen(std::chrono::milliseconds duration) {
  const auto end = Clock::now() + duration;
  while (Clock::now() < end && !hung_up_) {
    read_for(std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()) + 1ms);
  }
  return std::exchange(packets_, {});
}

std::optional<PacketBytes> WireClient::await(std::uint8_t id) { return await_any(id, id); }

std::optional<PacketBytes> WireClient::await_sip() {
  return await_any(pioneer::packet_id::sip_first, pioneer::packet_id::sip_last);
}

std::optional<PacketBytes> WireClient::next(std::chrono::milliseconds patience) {
  const auto end = Clock::now() + patience;
  while (packets_.empty() && Clock::now() < end && !hung_up_) {
    read_for(std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()) + 1ms);
  }
  if (packets_.empty()) return std::nullopt;
  PacketBytes packet = std::move(packets_.front());
  packets_.erase(packets_.begin());
  return packet;
}

std::optional<PacketBytes> WireClient::await_any(std::uint8_t first_id, std::uint8_t last_id) {
  for (const auto end = Clock::now() + kPatience; Clock::now() < end && !hung_up_;) {
    while (!packets_.empty()) {
      PacketBytes packet = std::move(packets_.front());
      packets_.erase(packets_.begin());
      if (packet.front() >= first_id && packet.front() <= last_id) return packet;
    }
    read_for(100ms);
  }
  return std::nullopt;
}

bool WireClient::open_session() {
  for (const std::uint8_t sync : {pioneer::kSync0, pioneer::kSync1, pioneer::kSync2}) {
    if (!send(pioneer::encode_command(sync)) || !await(sync)) return false;
  }
  return send(pioneer::encode_command(pioneer::Command::open)) &&
         send(pioneer::encode_command(pioneer::Command::sonar, 0)) && await_sip();
}

}  // namespace azimuth::sim
