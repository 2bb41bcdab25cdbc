// can_flood sends random frames to a CAN interface as fast as it accepts them. `can_flood --help` describes it.

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

#include "base/unique_fd.hpp"
#include "tests/guest/flood/pacing.hpp"
#include "tests/guest/flood/random_can_frame.hpp"

namespace {

namespace guest = azimuth::guest;
using azimuth::UniqueFd;

struct CanFloodWords {
  std::string interface, ids;
  double rate_hz = 0.0, seconds = 10.0;
  std::uint64_t seed = 1;
  bool classic = false;
  std::vector<std::string> spared;
};

struct CanFloodCounts {
  std::uint64_t sent = 0, waits = 0, down = 0;
};

[[noreturn]] void fail(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

std::uint32_t number(const std::string& text) { return static_cast<std::uint32_t>(std::stoul(text, nullptr, 0)); }

UniqueFd open_bus(const std::string& interface) {
  UniqueFd fd(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
  if (!fd) fail("socket");
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
  if (address.can_ifindex == 0) fail(interface);
  // Receives nothing, so that the frames of others do not fill a buffer.
  if (::setsockopt(fd.get(), SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0) != 0) fail("CAN_RAW_FILTER");
  if (::bind(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) fail(interface);
  return fd;
}

/// Enables CAN FD; false if the interface carries only classic frames.
bool switch_fd_on(int fd, const std::string& interface) {
  ifreq request{};
  interface.copy(request.ifr_name, IFNAMSIZ - 1);
  if (::ioctl(fd, SIOCGIFMTU, &request) != 0 || request.ifr_mtu != CANFD_MTU) return false;
  const int on = 1;
  return ::setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) == 0;
}

/// Sends a frame. Waits if the queue is full or the interface is down; ends the program if the interface is gone.
void send(int fd, const guest::FloodFrame& frame, CanFloodCounts& counts) {
  using namespace std::chrono_literals;
  if (::write(fd, &frame.frame, frame.bytes) >= 0) {
    ++counts.sent;
  } else if (errno == ENOBUFS || errno == EAGAIN || errno == EINTR) {
    ++counts.waits;
    std::this_thread::sleep_for(200us);
  } else if (errno == ENETDOWN) {
    ++counts.down;
    std::this_thread::sleep_for(10ms);
  } else {
    fail("write");
  }
}

int run(int argc, char** argv) {
  CanFloodWords words;
  CLI::App app("Random frames on a CAN interface: standard, extended, remote, and of CAN FD where it takes them.");
  app.add_option("INTERFACE", words.interface)->required();
  app.add_option("--rate", words.rate_hz, "Frames a second; 0: as many as it takes")->check(CLI::NonNegativeNumber);
  app.add_option("--seconds", words.seconds, "0: without end")->check(CLI::NonNegativeNumber)->capture_default_str();
  app.add_option("--id", words.ids, "LO-HI: only identifiers from LO to HI, e.g. 0x100-0x1ff");
  app.add_option("--spare", words.spared, "Identifiers that are never sent")->delimiter(',');
  app.add_option("--seed", words.seed)->capture_default_str();
  app.add_flag("--classic", words.classic, "No frames of CAN FD");
  CLI11_PARSE(app, argc, argv);

  guest::CanFloodKinds kinds;
  if (!words.ids.empty()) {
    const std::size_t dash = words.ids.find('-');
    kinds.first_id = number(words.ids.substr(0, dash));
    kinds.last_id = dash == std::string::npos ? kinds.first_id : number(words.ids.substr(dash + 1));
  }
  for (const std::string& text : words.spared) kinds.spared.push_back(number(text));
  if (!guest::leaves_identifiers(kinds)) throw std::invalid_argument("no identifiers are left to send");
  const UniqueFd bus = open_bus(words.interface);
  kinds.fd = !words.classic && switch_fd_on(bus.get(), words.interface);

  std::mt19937_64 random(words.seed);
  CanFloodCounts counts;
  guest::Pacing pacing(words.rate_hz, words.seconds);
  while (pacing.next()) send(bus.get(), guest::random_can_frame(kinds, random), counts);
  std::printf("sent=%llu waits=%llu down=%llu fd=%d seconds=%.3f\n", static_cast<unsigned long long>(counts.sent),
              static_cast<unsigned long long>(counts.waits), static_cast<unsigned long long>(counts.down), kinds.fd,
              pacing.passed_s());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "can_flood: %s\n", error.what());
    return 1;
  }
}
