#include "drivers/pioneer/serial_line.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>

namespace azimuth::pioneer {
namespace {

struct Rate {
  int baud;
  speed_t speed;
};
constexpr std::array kRates{Rate{1200, B1200},     Rate{2400, B2400},     Rate{4800, B4800},    Rate{9600, B9600},
                            Rate{19200, B19200},   Rate{38400, B38400},   Rate{57600, B57600},  Rate{115200, B115200},
                            Rate{230400, B230400}, Rate{460800, B460800}, Rate{921600, B921600}};

int result(int returned) { return returned < 0 ? errno : 0; }

}  // namespace

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

// A pseudo-terminal keeps the claim after its last close, as long as its other side exists, so nobody could open it
// again.
int claim_exclusively(int fd) {
  constexpr unsigned kFirstPty = 136, kLastPty = 143;  // major device numbers
  struct stat node {};
  if (::fstat(fd, &node) < 0) return errno;
  const unsigned kind = major(node.st_rdev);
  if (kind >= kFirstPty && kind <= kLastPty) return 0;
  return result(::ioctl(fd, TIOCEXCL));
}

void ask_for_low_latency(int fd) {
  serial_struct serial{};
  if (::ioctl(fd, TIOCGSERIAL, &serial) < 0) return;
  serial.flags |= ASYNC_LOW_LATENCY;
  ::ioctl(fd, TIOCSSERIAL, &serial);
}

int set_line_baud(int fd, int baud) {
  const auto rate = std::ranges::find(kRates, baud, &Rate::baud);
  if (rate == kRates.end()) return EINVAL;
  termios line{};
  if (::tcgetattr(fd, &line) < 0) return errno;
  ::cfsetispeed(&line, rate->speed);
  ::cfsetospeed(&line, rate->speed);
  return result(::tcsetattr(fd, TCSANOW, &line));
}

}  // namespace azimuth::pioneer
