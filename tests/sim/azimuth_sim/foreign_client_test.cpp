// azimuth-sim with clients that behave like other programs: ARIA's position commands, and soar's search for its robot.

#include <cmath>
#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/pose2.hpp"
#include "tests/sim/azimuth_sim/sim_process.hpp"

namespace azimuth::sim {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using pioneer::Command;
using pioneer::encode_command;

constexpr auto kQuick = "10";  // speed relative to real time

int u16(const PacketBytes& data, std::size_t at) { return data.at(at) | (data.at(at + 1) << 8); }
double signed_u16(const PacketBytes& data, std::size_t at) { return static_cast<std::int16_t>(u16(data, at)); }

Pose2 pose_of(const PacketBytes& sip) {
  return {signed_u16(sip, 1) / 1000, signed_u16(sip, 3) / 1000, wrap(signed_u16(sip, 5) * 2 * kPi / 4096)};
}
bool says_moving(const PacketBytes& sip) { return sip.front() == 0x33; }

/// Sends a command and waits until the SIPs have reported for a while that the robot stands.
Pose2 drive(WireClient& client, Command command, int argument) {
  client.send(encode_command(command, argument));
  PacketBytes sip;
  for (int standing = 0; standing < 8;) {
    client.send(encode_command(Command::pulse));
    sip = client.await_sip().value_or(PacketBytes(22));
    standing = says_moving(sip) ? 0 : standing + 1;
  }
  return pose_of(sip);
}

TEST(ForeignClient, PositionCommandsReachTheirGoals) {
  SimProcess sim({"--tcp", "0", "--stand-still", "--speed", kQuick});
  const auto announced = sim.output_until("tcp:127.0.0.1:");
  ASSERT_TRUE(announced);
  WireClient client(connect_tcp(std::stoi(announced->substr(announced->rfind(':') + 1))));
  ASSERT_TRUE(client.open_session());
  client.send(encode_command(Command::set_max_velocity, 600));
  client.send(encode_command(Command::set_acceleration, 400));
  client.send(encode_command(Command::set_acceleration, -400));
  client.send(encode_command(Command::set_max_rotation, 90));
  client.send(encode_command(Command::set_rotation_acceleration, 120));
  client.send(encode_command(Command::enable, 1));

  const std::vector<std::pair<Command, int>> orders{
      {Command::move, 1000}, {Command::heading, 90},  {Command::move, 750},     {Command::relative_heading, -135},
      {Command::move, -500}, {Command::heading, 180}, {Command::heading, -170}, {Command::relative_heading, 25},
      {Command::move, 1500},
  };
  Pose2 goal, before;
  double worst_m = 0.0, worst_deg = 0.0;
  for (const auto& [command, argument] : orders) {
    const double angle_rad = degrees_to_rad(argument);
    if (command == Command::move) goal = before * Pose2{argument / 1000.0, 0.0, 0.0};
    if (command == Command::heading) goal = {before.x_m, before.y_m, wrap(angle_rad)};
    if (command == Command::relative_heading) goal = {before.x_m, before.y_m, wrap(before.heading_rad + angle_rad)};
    const Pose2 reached = drive(client, command, argument);
    worst_m = std::max(worst_m, (reached.position() - goal.position()).norm());
    worst_deg = std::max(worst_deg, std::abs(rad_to_degrees(wrap(reached.heading_rad - goal.heading_rad))));
    before = reached;
  }
  std::printf("off the goal by %.1f mm and %.2f deg at worst, of %zu\n", 1000 * worst_m, worst_deg, orders.size());
  EXPECT_LT(worst_m, 0.01);
  EXPECT_LT(worst_deg, 1.0);
}

/// soar's connection procedure: CLOSE at each rate from the highest down, closing and reopening the port, then SYNC0 to
/// SYNC2. soar takes the next packet as the answer to each and gives up after four failures.
class Soar {
 public:
  explicit Soar(std::string device) : device_(std::move(device)) {}

  bool connect() {
    for (const int baud : {115200, 57600, 38400, 19200, 9600}) {
      WireClient(open_serial(device_, baud)).send(encode_command(Command::close));
      client_.emplace(open_serial(device_, baud));
      if (synchronise()) return client_->send(encode_command(Command::open));
    }
    return false;
  }
  WireClient& client() { return *client_; }

 private:
  bool synchronise() {
    int tries = 4;
    for (const std::uint8_t sync : {pioneer::kSync0, pioneer::kSync1, pioneer::kSync2}) {
      while (client_->send(encode_command(sync)) && next_id() != sync) {
        if (--tries < 0) return false;
      }
    }
    return true;
  }
  int next_id() {
    const auto packet = client_->next(200ms);
    return packet ? packet->front() : -1;
  }

  std::string device_;
  std::optional<WireClient> client_;
};

class SoarTest : public testing::Test {
 public:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  fs::path folder = fs::path(testing::TempDir()) / ("foreign_client_" + std::to_string(::getpid()));
};

TEST_F(SoarTest, FindsTheRobotAndReadsItsInputsAndConfiguration) {
  const std::string device = folder / "robot";
  SimProcess sim({"--device", device, "--stand-still", "--speed", kQuick});
  ASSERT_TRUE(sim.output_until("robot at"));
  Soar soar(device);
  ASSERT_TRUE(soar.connect());
  WireClient& client = soar.client();
  auto sip = client.await_sip();
  ASSERT_TRUE(sip);
  EXPECT_EQ(u16(*sip, 16) & 0x2, 0x2) << "sonar is on";
  client.send(encode_command(Command::enable, 0));
  client.send(encode_command(Command::io_request, 2));
  const auto io = client.await(0xF0);
  ASSERT_TRUE(io);
  ASSERT_EQ(io->size(), 9U + 2 * 8);
  EXPECT_EQ(io->at(8), 8) << "analog inputs, of which it takes the upper four";
  client.send(encode_command(Command::config));
  EXPECT_TRUE(client.await(0x20));
  EXPECT_TRUE(client.await(0xF0)) << "again and again";
  sip = client.await_sip();
  ASSERT_TRUE(sip);
  EXPECT_EQ(u16(*sip, 16) & 0x1, 0) << "the motors are off";

  client.send(encode_command(Command::enable, 1));
  client.send(encode_command(Command::set_origin));
  client.send(encode_command(Command::velocity, 200));
  client.listen(300ms);
  client.send(encode_command(Command::stop));
  client.send(encode_command(Command::close));
  EXPECT_TRUE(sim.output_until("session over"));
  EXPECT_TRUE(Soar(device).connect()) << "and the next one, too";
}

}  // namespace
}  // namespace azimuth::sim
