// lcm_flood sends damaged messages and datagrams to an LCM network. `lcm_flood --help` describes it.

#include <CLI/CLI.hpp>
#include <arpa/inet.h>
#include <cerrno>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <netinet/in.h>
#include <sys/socket.h>
#include <system_error>

#include "base/unique_fd.hpp"
#include "tests/guest/flood/pacing.hpp"
#include "tests/guest/flood/random_datagram.hpp"

namespace {

namespace guest = azimuth::guest;
using azimuth::UniqueFd;

struct LcmFloodWords {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  std::vector<std::string> channels{"CAMERA", "AZIMUTH_ODOM"};
  double rate_hz = 0.0, seconds = 10.0;
  std::uint64_t seed = 1;
};

/// The group and the port of an LCM URL "udpm://GROUP:PORT?...".
sockaddr_in address_of(const std::string& url) {
  const std::size_t group = url.find("//"), port = url.find(':', group);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  const bool parts = group != std::string::npos && port != std::string::npos;
  if (!parts || ::inet_pton(AF_INET, url.substr(group + 2, port - group - 2).c_str(), &address.sin_addr) != 1) {
    throw std::invalid_argument(url + ": is not udpm://GROUP:PORT");
  }
  address.sin_port = htons(static_cast<std::uint16_t>(std::stoul(url.substr(port + 1))));
  return address;
}

/// Opens a socket for datagrams that no LCM library would send. They stay on this machine.
UniqueFd open_socket() {
  UniqueFd fd(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const unsigned char hops = 0;
  if (!fd || ::setsockopt(fd.get(), IPPROTO_IP, IP_MULTICAST_TTL, &hops, sizeof hops) != 0) {
    throw std::system_error(errno, std::generic_category(), "socket");
  }
  return fd;
}

int run(int argc, char** argv) {
  LcmFloodWords words;
  CLI::App app("Damaged messages and datagrams on an LCM network, on the channels given.");
  app.add_option("URL", words.url, "Of the LCM network")->capture_default_str();
  app.add_option("--channel", words.channels)->delimiter(',')->capture_default_str();
  app.add_option("--rate", words.rate_hz, "Datagrams a second; 0: as many as the system takes")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--seconds", words.seconds, "0: without end")->check(CLI::NonNegativeNumber)->capture_default_str();
  app.add_option("--seed", words.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const sockaddr_in address = address_of(words.url);
  const UniqueFd socket = open_socket();
  lcm::LCM lcm(words.url);
  if (!lcm.good()) throw std::runtime_error(words.url + ": cannot be opened");
  guest::RandomMessages messages(words.seed);
  guest::Octets datagram;
  unsigned long long sent = 0, refused = 0;
  guest::Pacing pacing(words.rate_hz, words.seconds);
  while (pacing.next()) {
    const std::string& channel = words.channels[messages.random()() % words.channels.size()];
    bool good = false;
    if (messages.random()() % 2 == 0) {
      const guest::Octets& message = messages.next();
      good = lcm.publish(channel, message.data(), static_cast<unsigned>(message.size())) == 0;
    } else {
      guest::random_datagram(channel, messages.random(), datagram);
      good = ::sendto(socket.get(), datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&address),
                      sizeof address) >= 0;
    }
    ++(good ? sent : refused);
  }
  std::printf("sent=%llu refused=%llu seconds=%.3f\n", sent, refused, pacing.passed_s());
  return sent > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lcm_flood: %s\n", error.what());
    return 1;
  }
}
