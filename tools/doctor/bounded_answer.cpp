#include "tools/doctor/bounded_answer.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/unique_fd.hpp"

namespace azimuth {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void answer(int fd, const std::function<std::string()>& ask) {
  const std::string text = ask();
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = ::write(fd, text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) ::_exit(1);
    written += static_cast<std::size_t>(count);
  }
  ::_exit(0);  // exit() would flush copies of the parent's output buffers
}

/// Reads until the other end is closed; nothing if that takes longer than until `end`.
std::optional<std::string> read_until(int fd, Clock::time_point end) {
  std::string text;
  std::array<char, 4096> part{};
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) return std::nullopt;
    pollfd ready{.fd = fd, .events = POLLIN, .revents = 0};
    if (::poll(&ready, 1, static_cast<int>(left.count())) <= 0) continue;
    const ssize_t count = ::read(fd, part.data(), part.size());
    if (count < 0 && errno != EINTR) return std::nullopt;
    if (count == 0) return text;
    if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
  }
}

/// True if the child exited normally. A child that cannot be killed because it waits for a device is abandoned.
bool end_well(pid_t process, bool answered) {
  if (!answered) ::kill(process, SIGKILL);
  int status = 0;
  pid_t ended = 0;
  do {
    ended = ::waitpid(process, &status, answered ? 0 : WNOHANG);
  } while (ended < 0 && errno == EINTR);
  return ended == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::optional<std::string> answer_within(std::chrono::milliseconds limit, const std::function<std::string()>& ask) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  const UniqueFd read_end(ends[0]);
  UniqueFd write_end(ends[1]);
  const pid_t process = ::fork();
  if (process < 0) return std::nullopt;
  if (process == 0) answer(write_end.get(), ask);
  write_end = UniqueFd();
  auto text = read_until(read_end.get(), Clock::now() + limit);
  return end_well(process, text.has_value()) ? text : std::nullopt;
}

}  // namespace azimuth
