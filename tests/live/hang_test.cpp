// A robot over TCP that hangs for seconds and, once its client disconnects, never listens on the same port again. Runs
// in real time.

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

#include "base/unique_fd.hpp"
#include "tests/live/live.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr int kHangs = 20;
constexpr Duration kBack = 500ms;

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  return address;
}

UniqueFd tcp_socket() { return UniqueFd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)); }

/// Forwards a robot's connection to one client and ends when that client disconnects. For a client that knows only this
/// port, a server that moves to the next port is gone.
class OneClientServer {
 public:
  explicit OneClientServer(std::uint16_t robot_port) : robot_(tcp_socket()), listener_(tcp_socket()) {
    sockaddr_in there = loopback(robot_port);
    sockaddr_in own = loopback(0);
    socklen_t size = sizeof own;
    const auto generic = [](auto& address) { return reinterpret_cast<sockaddr*>(&address); };
    EXPECT_EQ(::connect(robot_.get(), generic(there), sizeof there), 0);
    EXPECT_EQ(::bind(listener_.get(), generic(own), sizeof own), 0);
    EXPECT_EQ(::listen(listener_.get(), 16), 0);
    EXPECT_EQ(::getsockname(listener_.get(), generic(own), &size), 0);
    port_ = ntohs(own.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~OneClientServer() {
    ends_ = true;
    thread_.join();
  }
  OneClientServer(const OneClientServer&) = delete;
  OneClientServer& operator=(const OneClientServer&) = delete;

  /// Forwards nothing in either direction for this time.
  void hang(std::chrono::milliseconds duration) {
    hangs_ = true;
    std::this_thread::sleep_for(duration);
    hangs_ = false;
  }
  std::uint16_t port() const { return port_; }
  bool was_hung_up_on() const { return hung_up_; }

 private:
  void serve() {
    UniqueFd client;
    while (!ends_ && !hung_up_) {
      std::array<pollfd, 2> ready{pollfd{client ? client.get() : listener_.get(), POLLIN, 0},
                                  pollfd{robot_.get(), POLLIN, 0}};
      ::poll(ready.data(), ready.size(), 5);
      if (hangs_) {
        // discards the robot's output, because a simulator at standstill does not send it later either
        if (ready[1].revents != 0) pass(robot_, UniqueFd());
        std::this_thread::sleep_for(1ms);
        continue;
      }
      if (ready[1].revents != 0) pass(robot_, client);
      if (ready[0].revents == 0) continue;
      if (!client)
        client = UniqueFd(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
      else if (!pass(client, robot_))
        hung_up_ = true;
    }
    listener_ = UniqueFd();
  }
  static bool pass(const UniqueFd& from, const UniqueFd& to) {
    std::array<char, 4096> bytes{};
    const ssize_t size = ::recv(from.get(), bytes.data(), bytes.size(), 0);
    if (size <= 0) return false;
    if (to) ::send(to.get(), bytes.data(), static_cast<std::size_t>(size), MSG_NOSIGNAL);
    return true;
  }

  UniqueFd robot_, listener_;
  std::uint16_t port_ = 0;
  std::atomic<bool> hangs_ = false, hung_up_ = false, ends_ = false;
  std::thread thread_;
};

Stamp wall_clock() {
  return Stamp{std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch())};
}

using Hang = test::Live;

TEST_F(Hang, OfARobotThatMovesItsPortIsOverWithinHalfASecond) {
  const test::Robot robot(folder(), {"--tcp", "0"});
  OneClientServer server(robot.port());
  auto daemon = recording_daemon({"--set", fmt::format("daemon.pioneer.device=tcp:127.0.0.1:{}", server.port())});
  ASSERT_TRUE(daemon->has_odometry()) << daemon->standard_error();
  std::vector<Stamp> ends;
  for (int hang = 0; hang < kHangs; ++hang) {
    std::this_thread::sleep_for(1500ms);
    server.hang(4000ms + hang * 3000ms / (kHangs - 1));
    ends.push_back(wall_clock());
  }
  std::this_thread::sleep_for(1500ms);
  EXPECT_FALSE(server.was_hung_up_on()) << daemon->standard_error();
  EXPECT_EQ(daemon->stop(), 0);
  const test::FieldLog log(test::only_session(records()));
  Duration worst{};
  for (const Stamp end : ends) {
    const auto back = std::ranges::upper_bound(log.run.odometry, end, {}, &OdometryReading::stamp);
    ASSERT_NE(back, log.run.odometry.end());
    EXPECT_LT(back->stamp - end, kBack);
    EXPECT_EQ(back->origin, log.run.odometry.front().origin);
    worst = std::max(worst, back->stamp - end);
  }
  fmt::print("{} hangs of 4 to 7 s: back after {:.2f} s at worst\n", ends.size(), to_seconds(worst));
}

}  // namespace
}  // namespace azimuth
