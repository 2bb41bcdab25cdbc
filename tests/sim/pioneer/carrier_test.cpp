// The line as seen by a client of a pseudo-terminal or of a TCP port.

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include "base/unique_fd.hpp"
#include "sim/pioneer/carriers.hpp"

namespace azimuth::sim {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const Bytes kHello{0xFA, 0xFB, 3, 0, 0, 0};

UniqueFd open_port(const fs::path& path) { return UniqueFd(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)); }

UniqueFd connect_to(std::uint16_t port) {
  UniqueFd fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  where.sin_port = htons(port);
  if (::connect(fd.get(), reinterpret_cast<sockaddr*>(&where), sizeof where) != 0) return UniqueFd();
  return fd;
}

void write_all(int fd, const Bytes& bytes) {
  ASSERT_EQ(::write(fd, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
}

/// Returns up to `count` bytes that arrive within a second, without waiting for more.
Bytes read_some(int fd, std::size_t count) {
  Bytes bytes;
  pollfd ready{fd, POLLIN, 0};
  while (bytes.size() < count && ::poll(&ready, 1, 1000) == 1 && (ready.revents & POLLIN) != 0) {
    std::array<std::uint8_t, 256> buffer{};
    const ssize_t got = ::read(fd, buffer.data(), std::min(buffer.size(), count - bytes.size()));
    if (got <= 0) break;
    bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + got);
  }
  return bytes;
}

/// Calls turn() until `done`, at most for several seconds.
template <class Done>
bool turn_until(Carrier& carrier, Bytes& received, Done done) {
  for (int i = 0; i < 500 && !done(); ++i) {
    carrier.turn(received);
    if (!done()) ::usleep(10'000);
  }
  return done();
}

void set_speed(int fd, speed_t speed) {
  termios settings{};
  ASSERT_EQ(::tcgetattr(fd, &settings), 0);
  ::cfsetspeed(&settings, speed);
  ASSERT_EQ(::tcsetattr(fd, TCSANOW, &settings), 0);
}

class PtyCarrierTest : public testing::Test {
 public:
  void SetUp() override {
    fs::create_directories(folder);
    ASSERT_TRUE(carrier.plug_in());
  }
  void TearDown() override {
    carrier.unplug();
    fs::remove_all(folder);
  }

  fs::path folder = fs::path(testing::TempDir()) / ("pty_carrier_" + std::to_string(::getpid()));
  fs::path link = folder / "robot";
  PtyCarrier carrier{link};
  Bytes received;
};

TEST_F(PtyCarrierTest, CarriesBytesBothWaysUnchanged) {
  const UniqueFd port = open_port(link);
  ASSERT_TRUE(port);
  Bytes every_byte(256);
  for (std::size_t i = 0; i < 256; ++i) every_byte[i] = static_cast<std::uint8_t>(i);
  write_all(port.get(), every_byte);
  ASSERT_TRUE(turn_until(carrier, received, [&] { return received.size() == 256; }));
  EXPECT_EQ(received, every_byte);
  carrier.send(every_byte);
  EXPECT_EQ(read_some(port.get(), 256), every_byte);
}

TEST_F(PtyCarrierTest, KnowsTheClientsBaud) {
  const UniqueFd port = open_port(link);
  EXPECT_EQ(carrier.client_baud(), 9600);
  for (const auto& [speed, baud] : {std::pair{B38400, 38400}, {B115200, 115200}, {B19200, 19200}}) {
    set_speed(port.get(), static_cast<speed_t>(speed));
    EXPECT_EQ(carrier.client_baud(), baud);
  }
}

TEST_F(PtyCarrierTest, SeesClientsComeAndGo) {
  carrier.turn(received);
  EXPECT_FALSE(carrier.has_client());
  for (int i = 0; i < 3; ++i) {
    UniqueFd port = open_port(link);
    carrier.turn(received);
    EXPECT_TRUE(carrier.has_client());
    port = UniqueFd();
    carrier.turn(received);
    EXPECT_FALSE(carrier.has_client());
  }
}

TEST_F(PtyCarrierTest, NobodyReadsWhatCameBeforeThem) {
  carrier.turn(received);
  carrier.send(kHello);
  {
    const UniqueFd port = open_port(link);
    carrier.turn(received);
    carrier.send(Bytes(100, 7));  // left unread
  }
  carrier.turn(received);
  const UniqueFd port = open_port(link);
  carrier.turn(received);
  carrier.send(kHello);
  EXPECT_EQ(read_some(port.get(), kHello.size()), kHello);
}

TEST_F(PtyCarrierTest, AClientThatDoesNotReadBlocksNothing) {
  const UniqueFd port = open_port(link);
  carrier.turn(received);
  for (int i = 0; i < 1000; ++i) carrier.send(Bytes(100, 1));
  write_all(port.get(), kHello);
  EXPECT_TRUE(turn_until(carrier, received, [&] { return received == kHello; }));
}

TEST_F(PtyCarrierTest, UnplugTakesTheLinkAndHangsUp) {
  const UniqueFd port = open_port(link);
  carrier.turn(received);
  carrier.unplug();
  EXPECT_FALSE(fs::exists(fs::symlink_status(link)));
  pollfd state{port.get(), POLLIN, 0};
  ASSERT_EQ(::poll(&state, 1, 1000), 1);
  EXPECT_NE(state.revents & POLLHUP, 0);
  EXPECT_EQ(::write(port.get(), kHello.data(), kHello.size()), -1);
  EXPECT_EQ(errno, EIO);
  carrier.turn(received);
  carrier.send(kHello);

  ASSERT_TRUE(carrier.plug_in());
  const UniqueFd again = open_port(link);
  ASSERT_TRUE(again);
  write_all(again.get(), kHello);
  EXPECT_TRUE(turn_until(carrier, received, [&] { return received == kHello; }));
}

TEST_F(PtyCarrierTest, ReplacesALinkAndNothingElse) {
  carrier.unplug();
  fs::create_symlink("/nowhere", link);
  EXPECT_TRUE(carrier.plug_in());
  carrier.unplug();
  std::ofstream(link) << "precious";
  const auto plugged = carrier.plug_in();
  ASSERT_FALSE(plugged);
  EXPECT_NE(plugged.error().front().text().find("not a link"), std::string::npos);
  EXPECT_TRUE(fs::is_regular_file(link));
}

TEST_F(PtyCarrierTest, SaysWhereItCannotLink) {
  PtyCarrier nowhere(folder / "missing" / "robot");
  const auto plugged = nowhere.plug_in();
  ASSERT_FALSE(plugged);
  EXPECT_NE(plugged.error().front().text().find("missing"), std::string::npos);
}

TEST(TcpCarrierTest, CarriesBytesBothWays) {
  TcpCarrier carrier(0);
  ASSERT_TRUE(carrier.plug_in());
  ASSERT_NE(carrier.port(), 0);
  const UniqueFd client = connect_to(carrier.port());
  ASSERT_TRUE(client);
  write_all(client.get(), kHello);
  Bytes received;
  ASSERT_TRUE(turn_until(carrier, received, [&] { return received == kHello; }));
  carrier.send(kHello);
  EXPECT_EQ(read_some(client.get(), kHello.size()), kHello);
  EXPECT_FALSE(carrier.client_baud());
}

TEST(TcpCarrierTest, ServesOneClientAfterTheOther) {
  TcpCarrier carrier(0);
  ASSERT_TRUE(carrier.plug_in());
  Bytes received;
  for (int i = 0; i < 3; ++i) {
    const UniqueFd client = connect_to(carrier.port());
    ASSERT_TRUE(turn_until(carrier, received, [&] { return carrier.has_client(); }));
    const UniqueFd second = connect_to(carrier.port());
    carrier.turn(received);
    EXPECT_TRUE(read_some(second.get(), 1).empty()) << "turned away";
    ::shutdown(client.get(), SHUT_RDWR);
    ASSERT_TRUE(turn_until(carrier, received, [&] { return !carrier.has_client(); }));
    carrier.send(kHello);
  }
}

TEST(TcpCarrierTest, KeepsItsPortFromPlugToPlug) {
  TcpCarrier carrier(0);
  ASSERT_TRUE(carrier.plug_in());
  const std::uint16_t port = carrier.port();
  const UniqueFd client = connect_to(port);
  Bytes received;
  ASSERT_TRUE(turn_until(carrier, received, [&] { return carrier.has_client(); }));
  carrier.unplug();
  EXPECT_TRUE(read_some(client.get(), 1).empty());
  EXPECT_FALSE(connect_to(port)) << "refused meanwhile";
  ASSERT_TRUE(carrier.plug_in());
  EXPECT_EQ(carrier.port(), port);
  EXPECT_TRUE(connect_to(port));
}

TEST(TcpCarrierTest, SaysThatAPortIsTaken) {
  TcpCarrier first(0);
  ASSERT_TRUE(first.plug_in());
  TcpCarrier second(first.port());
  const auto plugged = second.plug_in();
  ASSERT_FALSE(plugged);
  EXPECT_NE(plugged.error().front().text().find(std::to_string(first.port())), std::string::npos);
}

}  // namespace
}  // namespace azimuth::sim
