#include "drivers/pioneer/device_link.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <charconv>
#include <fcntl.h>
#include <linux/serial.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <string_view>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <system_error>
#include <termios.h>
#include <unistd.h>

namespace azimuth::pioneer {
namespace {

constexpr std::string_view kTcp = "tcp:";

/// Parses "HOST:PORT".
std::optional<sockaddr_in> parse_address(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const std::string host(text.substr(0, colon) == "localhost" ? "127.0.0.1" : text.substr(0, colon));
  const std::string_view port = text.substr(colon + 1);
  std::uint16_t number = 0;
  const auto [end, wrong] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (wrong != std::errc{} || end != port.data() + port.size() || number == 0) return std::nullopt;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(number);
  if (::inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1) return std::nullopt;
  return address;
}

bool means_later(int error_number) {
  return error_number == EAGAIN || error_number == EWOULDBLOCK || error_number == EINTR;
}

// The termios calls of Linux for a serial line. All functions with a result return 0 or errno.

struct Rate {
  int baud;
  speed_t speed;
};
constexpr std::array kRates{Rate{1200, B1200},     Rate{2400, B2400},     Rate{4800, B4800},    Rate{9600, B9600},
                            Rate{19200, B19200},   Rate{38400, B38400},   Rate{57600, B57600},  Rate{115200, B115200},
                            Rate{230400, B230400}, Rate{460800, B460800}, Rate{921600, B921600}};

int result(int returned) { return returned < 0 ? errno : 0; }

/// Raw 8N1 without flow control, receiver on, modem lines ignored; the rate is not changed.
int make_raw(int fd) {
  termios line{};
  if (::tcgetattr(fd, &line) < 0) return errno;
  ::cfmakeraw(&line);
  line.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS | PARENB);
  line.c_cflag |= CLOCAL | CREAD | CS8;
  line.c_iflag &= ~static_cast<tcflag_t>(IXON | IXOFF | IXANY | INPCK);
  line.c_cc[VMIN] = 1;  // so that a read of 0 bytes means that the line was hung up
  line.c_cc[VTIME] = 0;
  return result(::tcsetattr(fd, TCSANOW, &line));
}

/// Prevents other processes from opening the line. Pseudo-terminals, which are used in tests, stay open to all: a
/// pseudo-terminal keeps the claim after its last close, as long as its other side exists, so nobody could open it
/// again.
int claim_exclusively(int fd) {
  constexpr unsigned kFirstPty = 136, kLastPty = 143;  // major device numbers
  struct stat node {};
  if (::fstat(fd, &node) < 0) return errno;
  const unsigned kind = major(node.st_rdev);
  if (kind >= kFirstPty && kind <= kLastPty) return 0;
  return result(::ioctl(fd, TIOCEXCL));
}

/// Asks the adapter to pass bytes on without delay. A line that does not support this is not an error.
void ask_for_low_latency(int fd) {
  serial_struct serial{};
  if (::ioctl(fd, TIOCGSERIAL, &serial) < 0) return;
  serial.flags |= ASYNC_LOW_LATENCY;
  ::ioctl(fd, TIOCSSERIAL, &serial);
}

/// Sets the baud rate. EINVAL: termios does not have the rate.
int set_line_baud(int fd, int baud) {
  const auto rate = std::ranges::find(kRates, baud, &Rate::baud);
  if (rate == kRates.end()) return EINVAL;
  termios line{};
  if (::tcgetattr(fd, &line) < 0) return errno;
  ::cfsetispeed(&line, rate->speed);
  ::cfsetospeed(&line, rate->speed);
  return result(::tcsetattr(fd, TCSANOW, &line));
}

}  // namespace

std::string LinkError::text() const {
  const std::string begin = device + ": " + what;
  return error_number == 0 ? begin : begin + ": " + std::generic_category().message(error_number);
}

bool DeviceLink::is_serial(const std::string& device) { return !device.starts_with(kTcp); }

OpenedLink DeviceLink::open(const std::string& device) {
  return is_serial(device) ? open_serial(device) : open_tcp(device);
}

OpenedLink DeviceLink::make(const std::string& device, UniqueFd fd, Kind kind) {
  return std::unique_ptr<Link>(new DeviceLink(device, std::move(fd), kind));
}

OpenedLink DeviceLink::open_serial(const std::string& device) {
  UniqueFd fd(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!fd) return tl::unexpected(LinkError{device, "open", errno});
  if (const int error_number = make_raw(fd.get()))
    return tl::unexpected(LinkError{device, "not a serial line", error_number});
  if (const int error_number = claim_exclusively(fd.get()))
    return tl::unexpected(LinkError{device, "exclusive use", error_number});
  ask_for_low_latency(fd.get());
  ::tcflush(fd.get(), TCIOFLUSH);
  return make(device, std::move(fd), Kind::serial);
}

OpenedLink DeviceLink::open_tcp(const std::string& device) {
  const auto address = parse_address(std::string_view(device).substr(kTcp.size()));
  if (!address) return tl::unexpected(LinkError{device, "not tcp:HOST:PORT with an IPv4 address or localhost", 0});
  UniqueFd fd(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!fd) return tl::unexpected(LinkError{device, "socket", errno});
  const int on = 1;
  ::setsockopt(fd.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  const int returned = ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address);
  if (returned < 0 && errno != EINPROGRESS) return tl::unexpected(LinkError{device, "connect", errno});
  return make(device, std::move(fd), returned < 0 ? Kind::tcp_connecting : Kind::tcp);
}

std::optional<LinkError> DeviceLink::finish_connecting() {
  int failure = 0;
  socklen_t size = sizeof failure;
  if (::getsockopt(fd_.get(), SOL_SOCKET, SO_ERROR, &failure, &size) < 0) failure = errno;
  if (failure != 0) return error("connect", failure);
  sockaddr_in peer{};
  socklen_t peer_size = sizeof peer;
  connecting_ = ::getpeername(fd_.get(), reinterpret_cast<sockaddr*>(&peer), &peer_size) < 0;
  return std::nullopt;
}

DeviceLink::Read DeviceLink::read(std::span<std::uint8_t> into) {
  const ssize_t size = ::read(fd_.get(), into.data(), into.size());
  if (size > 0 && serial_) return {static_cast<std::size_t>(size), std::nullopt};
  if (size > 0) {
    const std::size_t robots = telnet_.undo(into.first(static_cast<std::size_t>(size)));
    return {robots, answer_telnet()};
  }
  if (size == 0) return {0, error("closed by the other side", 0)};
  if (means_later(errno)) return {};
  return {0, error("read", errno)};
}

std::optional<LinkError> DeviceLink::answer_telnet() {
  bool any = false;
  while (const auto answer = telnet_.take_answer())
    any = add_unsent(Telnet::kCommand) && add_unsent(answer->command) && add_unsent(answer->option);
  return any ? flush() : std::nullopt;
}

bool DeviceLink::add_unsent(std::uint8_t byte) {
  if (unsent_size_ == unsent_.size()) return false;
  unsent_[unsent_size_++] = byte;
  return true;
}

std::optional<LinkError> DeviceLink::write(std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) {
    const bool is_doubled = telnet_.is_spoken() && byte == Telnet::kCommand;
    if (!add_unsent(byte) || (is_doubled && !add_unsent(byte))) return error("write: the other side takes nothing", 0);
  }
  return flush();
}

std::optional<LinkError> DeviceLink::flush() {
  if (connecting_ || unsent_size_ == 0) return std::nullopt;
  const ssize_t sent = serial_ ? ::write(fd_.get(), unsent_.data(), unsent_size_)
                               : ::send(fd_.get(), unsent_.data(), unsent_size_, MSG_NOSIGNAL);
  if (sent < 0) return means_later(errno) ? std::nullopt : std::optional(error("write", errno));
  std::copy(unsent_.begin() + sent, unsent_.begin() + static_cast<std::ptrdiff_t>(unsent_size_), unsent_.begin());
  unsent_size_ -= static_cast<std::size_t>(sent);
  return std::nullopt;
}

bool DeviceLink::is_drained() const {
  int waiting = 0;
  return !has_unsent() && (::ioctl(fd_.get(), TIOCOUTQ, &waiting) < 0 || waiting == 0);
}

void DeviceLink::finish_sending() {
  if (!serial_) ::shutdown(fd_.get(), SHUT_WR);
}

std::optional<LinkError> DeviceLink::set_baud(int baud) {
  if (!serial_) return std::nullopt;
  if (const int error_number = set_line_baud(fd_.get(), baud)) return error("set the baud rate", error_number);
  return std::nullopt;
}

void DeviceLink::discard_input() {
  if (serial_) ::tcflush(fd_.get(), TCIFLUSH);
}

}  // namespace azimuth::pioneer
