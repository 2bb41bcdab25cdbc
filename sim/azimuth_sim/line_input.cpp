#include "sim/azimuth_sim/line_input.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "base/file_result.hpp"

namespace azimuth::sim {
namespace {

constexpr std::size_t kLongestLine = 4096;
constexpr std::size_t kMostClients = 8;

bool is_ready(const std::vector<pollfd>& watched, int fd) {
  return std::ranges::any_of(watched, [fd](const pollfd& one) { return one.fd == fd && one.revents != 0; });
}

bool is_stale_socket(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_socket(std::filesystem::symlink_status(path, error));
}

}  // namespace

bool LineReader::read(int fd) {
  std::array<char, 512> buffer{};
  const ssize_t count = ::read(fd, buffer.data(), buffer.size());
  if (count > 0) text_.append(buffer.data(), static_cast<std::size_t>(count));
  const bool open = count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
  return open && text_.size() <= kLongestLine;
}

std::optional<std::string> LineReader::next() {
  const std::size_t end = text_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = text_.substr(0, end);
  text_.erase(0, end + 1);
  if (line.ends_with('\r')) line.pop_back();
  return line;
}

LineInput::~LineInput() {
  std::error_code ignored;
  if (listener_) std::filesystem::remove(path_, ignored);
}

void LineInput::open_standard_input() {
  ::signal(SIGTTIN, SIG_IGN);  // In the background of a terminal, reading then fails instead of stopping the process
  standard_input_open_ = true;
}

FileResult<void> LineInput::open_socket(const std::filesystem::path& path) {
  sockaddr_un where{};
  where.sun_family = AF_UNIX;
  if (path.native().size() >= sizeof where.sun_path)
    return failure(FileError{path.string(), 0, "is too long for a socket"});
  std::memcpy(where.sun_path, path.c_str(), path.native().size() + 1);
  std::error_code ignored;
  if (is_stale_socket(path)) std::filesystem::remove(path, ignored);
  UniqueFd listener(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!listener || ::bind(listener.get(), reinterpret_cast<const sockaddr*>(&where), sizeof where) != 0 ||
      ::listen(listener.get(), static_cast<int>(kMostClients)) != 0) {
    return failure(system_error(path, "cannot be listened on", errno));
  }
  ::chmod(path.c_str(), S_IRUSR | S_IWUSR);
  path_ = path;
  listener_ = std::move(listener);
  return {};
}

void LineInput::watch(std::vector<pollfd>& watched) const {
  if (standard_input_open_) watched.push_back({STDIN_FILENO, POLLIN, 0});
  if (listener_ && clients_.size() < kMostClients) watched.push_back({listener_.get(), POLLIN, 0});
  for (const Client& client : clients_) watched.push_back({client.fd.get(), POLLIN, 0});
}

void LineInput::turn(const std::vector<pollfd>& watched) {
  if (standard_input_open_ && is_ready(watched, STDIN_FILENO)) {
    standard_input_open_ = standard_input_.read(STDIN_FILENO);
    while (const auto line = standard_input_.next()) std::fputs(handler_(*line).c_str(), stdout);
    std::fflush(stdout);
  }
  std::erase_if(clients_, [&](Client& client) { return is_ready(watched, client.fd.get()) && !serve(client); });
  if (listener_ && is_ready(watched, listener_.get())) accept_client();
}

void LineInput::accept_client() {
  UniqueFd fd(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (fd) clients_.push_back({std::move(fd), {}});
}

/// Returns false if the client is gone.
bool LineInput::serve(Client& client) {
  const bool open = client.reader.read(client.fd.get());
  while (const auto line = client.reader.next()) {
    const std::string answer = handler_(*line);
    if (::send(client.fd.get(), answer.data(), answer.size(), MSG_NOSIGNAL) < 0) return false;
  }
  return open;
}

}  // namespace azimuth::sim
