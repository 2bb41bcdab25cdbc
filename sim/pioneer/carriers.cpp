#include "sim/pioneer/carriers.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <system_error>
#include <termios.h>
#include <unistd.h>

namespace azimuth::sim {
namespace {

/// Connections that are queued while this program is stopped, as by other servers.
constexpr int kWaiting = 16;

void switch_on(int fd, int level, int option) {
  const int on = 1;
  ::setsockopt(fd, level, option, &on, sizeof on);
}

namespace fs = std::filesystem;

struct Speed {
  speed_t code;
  int baud;
};
constexpr std::array kSpeeds{
    Speed{B1200, 1200},     Speed{B2400, 2400},     Speed{B4800, 4800},     Speed{B9600, 9600},
    Speed{B19200, 19200},   Speed{B38400, 38400},   Speed{B57600, 57600},   Speed{B115200, 115200},
    Speed{B230400, 230400}, Speed{B460800, 460800}, Speed{B921600, 921600},
};
constexpr int kUnknownBaud = 300;  // A rate that no controller has

/// Sets the terminal to raw mode. A fresh terminal echoes, so the robot would receive its own output.
int set_raw(int fd) {
  termios settings{};
  if (::tcgetattr(fd, &settings) != 0) return errno;
  ::cfmakeraw(&settings);
  ::cfsetspeed(&settings, B9600);
  return ::tcsetattr(fd, TCSANOW, &settings) == 0 ? 0 : errno;
}

}  // namespace

FileResult<void> PtyCarrier::plug_in() {
  if (master_) return {};
  if (auto opened = open_terminal(); !opened) return opened;
  if (auto linked = make_link(); !linked) {
    master_ = UniqueFd();
    return linked;
  }
  return {};
}

FileResult<void> PtyCarrier::open_terminal() {
  const auto failed = [](const char* what, int error) { return failure(system_error("/dev/ptmx", what, error)); };
  UniqueFd master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!master) return failed("no pseudo-terminal", errno);
  if (::grantpt(master.get()) != 0 || ::unlockpt(master.get()) != 0) return failed("cannot be unlocked", errno);
  std::array<char, 64> name{};
  if (const int error = ::ptsname_r(master.get(), name.data(), name.size())) return failed("has no name", error);
  // Set on the master, this applies to the terminal's other side and outlives each client.
  if (const int error = set_raw(master.get())) return failed("cannot be made raw", error);
  terminal_ = name.data();
  master_ = std::move(master);
  has_client_ = false;
  forget_unread();
  return {};
}

/// The new link replaces the old one atomically, so that clients never find an incomplete link.
FileResult<void> PtyCarrier::make_link() {
  std::error_code error;
  const fs::file_status there = fs::symlink_status(link_, error);
  if (fs::exists(there) && !fs::is_symlink(there))
    return failure(FileError{link_.string(), 0, "exists and is not a link"});
  const fs::path fresh = fmt::format("{}.{}", link_.string(), ::getpid());
  fs::create_symlink(terminal_, fresh, error);
  if (error) return failure(system_error(fresh, "cannot be linked", error.value()));
  fs::rename(fresh, link_, error);
  if (!error) return {};
  std::error_code ignored;
  fs::remove(fresh, ignored);
  return failure(system_error(link_, "cannot be linked", error.value()));
}

void PtyCarrier::unplug() {
  if (!master_) return;
  std::error_code ignored;
  if (fs::read_symlink(link_, ignored) == fs::path(terminal_)) fs::remove(link_, ignored);
  master_ = UniqueFd();
  has_client_ = false;
}

// Without a client, poll() reports a hang-up continuously, so the terminal is polled at intervals instead.
void PtyCarrier::watch(std::vector<pollfd>& watched) const {
  if (master_ && has_client_) watched.push_back({master_.get(), POLLIN, 0});
}

std::chrono::milliseconds PtyCarrier::patience() const { return std::chrono::milliseconds(has_client_ ? 1000 : 10); }

void PtyCarrier::look_for_client() {
  pollfd state{master_.get(), POLLIN, 0};
  const bool here = ::poll(&state, 1, 0) >= 0 && (state.revents & POLLHUP) == 0;
  if (has_client_ && !here) forget_unread();
  has_client_ = here;
}

/// Discards data that arrived while no port was open or that an earlier client left.
void PtyCarrier::forget_unread() {
  const UniqueFd terminal(::open(terminal_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (terminal) ::tcflush(terminal.get(), TCIOFLUSH);
}

void PtyCarrier::turn(Bytes& from_client) {
  if (!master_) return;
  std::array<std::uint8_t, 512> buffer{};
  ssize_t count = 0;
  while ((count = ::read(master_.get(), buffer.data(), buffer.size())) > 0) {
    from_client.insert(from_client.end(), buffer.begin(), buffer.begin() + count);
  }
  look_for_client();
}

void PtyCarrier::send(pioneer::ByteView bytes) {
  if (!master_ || !has_client_) return;
  [[maybe_unused]] const auto written = ::write(master_.get(), bytes.data(), bytes.size());  // full: nobody reads
}

std::optional<int> PtyCarrier::client_baud() const {
  termios settings{};
  if (!master_ || ::tcgetattr(master_.get(), &settings) != 0) return kUnknownBaud;
  const auto* const found = std::ranges::find(kSpeeds, ::cfgetospeed(&settings), &Speed::code);
  return found == kSpeeds.end() ? kUnknownBaud : found->baud;
}

FileResult<void> TcpCarrier::plug_in() {
  if (listener_) return {};
  UniqueFd listener(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!listener) return failure(system_error(address(), "no socket", errno));
  switch_on(listener.get(), SOL_SOCKET, SO_REUSEADDR);
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  where.sin_port = htons(port_);
  auto* const generic = reinterpret_cast<sockaddr*>(&where);
  socklen_t size = sizeof where;
  if (::bind(listener.get(), generic, size) != 0 || ::listen(listener.get(), kWaiting) != 0 ||
      ::getsockname(listener.get(), generic, &size) != 0) {
    return failure(system_error(address(), "cannot be listened on", errno));
  }
  port_ = ntohs(where.sin_port);
  listener_ = std::move(listener);
  return {};
}

void TcpCarrier::unplug() {
  forgotten_.clear();
  client_ = UniqueFd();
  listener_ = UniqueFd();
}

void TcpCarrier::watch(std::vector<pollfd>& watched) const {
  if (listener_) watched.push_back({listener_.get(), POLLIN, 0});
  if (client_) watched.push_back({client_.get(), POLLIN, 0});
}

void TcpCarrier::turn(Bytes& from_client) {
  if (client_) hear_client(from_client);
  if (listener_) accept_client();
}

void TcpCarrier::accept_client() {
  UniqueFd client(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!client || client_) return;  // A second client is rejected
  switch_on(client.get(), IPPROTO_TCP, TCP_NODELAY);
  client_ = std::move(client);
}

void TcpCarrier::hear_client(Bytes& from_client) {
  std::array<std::uint8_t, 512> buffer{};
  ssize_t count = 0;
  while ((count = ::recv(client_.get(), buffer.data(), buffer.size(), 0)) > 0) {
    from_client.insert(from_client.end(), buffer.begin(), buffer.begin() + count);
  }
  const bool gone = count == 0 || (errno != EAGAIN && errno != EINTR);
  if (gone) client_ = UniqueFd();
}

void TcpCarrier::send(pioneer::ByteView bytes) {
  if (!client_) return;
  const ssize_t sent = ::send(client_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  const bool gone = sent < 0 && errno != EAGAIN && errno != EINTR;
  if (gone) client_ = UniqueFd();
}

std::string TcpCarrier::address() const { return fmt::format("tcp:127.0.0.1:{}", port_); }

}  // namespace azimuth::sim
