// Notifications to the service manager's socket, whether or not it is read.

#include "daemon/supervise/service_manager.hpp"

#include <cstdlib>
#include <functional>
#include <gmock/gmock.h>
#include <memory>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>
#include <sstream>

#include "tests/daemon/notify_socket.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using ::testing::StartsWith;

/// Sets the environment variable NOTIFY_SOCKET during its lifetime.
class NotifyVariable {
 public:
  explicit NotifyVariable(const std::string& value) { setenv("NOTIFY_SOCKET", value.c_str(), 1); }
  ~NotifyVariable() { unsetenv("NOTIFY_SOCKET"); }
  NotifyVariable(const NotifyVariable&) = delete;
  NotifyVariable& operator=(const NotifyVariable&) = delete;
};

class Notifications : public ::testing::Test {
 protected:
  /// Sends pings until the socket is full.
  void fill() {
    for (int i = 0; i < 100'000; ++i) manager_.alive();
  }
  int drop_all() const {
    int count = 0;
    while (!socket_.receive(0ms).empty()) ++count;
    return count;
  }

  test::TemporaryFolder folder_;
  test::NotifySocket socket_{folder_.path()};
  NotifyVariable variable_{folder_.path() / "notify"};
  ServiceManager manager_;
};

TEST_F(Notifications, Arrive) {
  manager_.ready("running");
  EXPECT_EQ(socket_.receive(1s), "READY=1\nSTATUS=running");
  manager_.reloading();
  EXPECT_THAT(socket_.receive(1s), StartsWith("RELOADING=1\nMONOTONIC_USEC="));
  manager_.status("busy");
  EXPECT_EQ(socket_.receive(1s), "STATUS=busy");
  manager_.alive();
  EXPECT_EQ(socket_.receive(1s), "WATCHDOG=1");
  manager_.stopping();
  EXPECT_THAT(socket_.receive(1s), StartsWith("STOPPING=1"));
}

TEST_F(Notifications, NobodyReadsAreNotWaitedFor) {
  fill();  // a blocking send would never return
  manager_.status("unread");
  const int taken = drop_all();
  EXPECT_GT(taken, 0);
  EXPECT_LT(taken, 100'000);
}

TEST_F(Notifications, ThatMatterAreTriedAgain) {
  fill();
  manager_.ready("running");
  manager_.status("lost");
  drop_all();
  manager_.alive();
  EXPECT_EQ(socket_.receive(1s), "READY=1\nSTATUS=running") << "first what could not be sent";
  EXPECT_EQ(socket_.receive(1s), "WATCHDOG=1");
  EXPECT_EQ(socket_.receive(0ms), "");
}

TEST_F(Notifications, OnlyTheNewestOfThemIsTriedAgain) {
  fill();
  manager_.reloading();
  manager_.ready("with another configuration");
  drop_all();
  manager_.alive();
  EXPECT_THAT(socket_.receive(1s), StartsWith("READY=1"));
  EXPECT_EQ(socket_.receive(1s), "WATCHDOG=1");
}

/// The log of everything that happens while `done` runs.
std::string logged(const std::function<void()>& done) {
  std::ostringstream text;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text)));
  spdlog::set_pattern("%v");
  done();
  spdlog::set_default_logger(before);
  return text.str();
}

/// The log of notifications that are sent with NOTIFY_SOCKET set to `value`.
std::string logged_of(const std::string& value) {
  const NotifyVariable variable(value);
  return logged([] {
    ServiceManager manager;
    manager.ready("running");
    manager.alive();
    manager.stopping();
  });
}

TEST(NotificationsElsewhere, GoNowhereWithoutAManager) {
  EXPECT_EQ(logged_of(""), "");
  EXPECT_EQ(logged_of("vsock"), "") << "no socket of a file system";
}

TEST(NotificationsElsewhere, ThatReachNobodyAreLoggedOnce) {
  EXPECT_EQ(logged_of("/nonexistent/notify"), "service manager: cannot notify: No such file or directory\n");
  EXPECT_EQ(logged_of("/" + std::string(200, 'x')), "service manager: cannot notify: File name too long\n");
}

TEST(NotificationsElsewhere, KnowAbstractSockets) {
  const std::string name = "azimuth-notify-" + std::to_string(getpid());
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  name.copy(address.sun_path + 1, name.size());
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  ASSERT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&address), size), 0);
  const NotifyVariable variable("@" + name);
  ServiceManager manager;
  manager.alive();
  char buffer[64];
  EXPECT_EQ(recv(fd, buffer, sizeof buffer, MSG_DONTWAIT), 10);
  close(fd);
}

}  // namespace
}  // namespace azimuth
