// azimuth-sim as a process with its command line.

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

#include "drivers/camera/shared_camera.hpp"
#include "tests/sim/azimuth_sim/sim_process.hpp"

namespace azimuth::sim {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using pioneer::Command;
using pioneer::encode_command;

class AzimuthSim : public testing::Test {
 public:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  std::string link() const { return (folder / "robot").string(); }

  fs::path folder = fs::path(testing::TempDir()) / ("azimuth_sim_" + std::to_string(::getpid()));
};

int sip_x(const PacketBytes& sip) { return sip[1] | (sip[2] << 8); }

TEST_F(AzimuthSim, GivesAMinuteOfSipsOverTheSerialPort) {
  SimProcess sim({"--device", link(), "--speed", "20"});
  ASSERT_TRUE(sim.output_until("robot at"));
  WireClient client(open_serial(link(), 9600));
  ASSERT_TRUE(client.open_session());
  int sips = 0;
  while (sips < 600 && client.await_sip()) {
    if (++sips % 10 == 0) {
      ASSERT_TRUE(client.send(encode_command(Command::pulse)));
    }
  }
  EXPECT_EQ(sips, 600);
  ASSERT_TRUE(client.send(encode_command(Command::close)));
  EXPECT_TRUE(sim.output_until("session over"));
  EXPECT_EQ(sim.end(SIGTERM), 0);
  EXPECT_FALSE(fs::exists(fs::symlink_status(link()))) << "the link goes with the robot";
}

TEST_F(AzimuthSim, ServesTheSameOverTcp) {
  SimProcess sim({"--tcp", "0"});
  const auto announced = sim.output_until("tcp:127.0.0.1:");
  ASSERT_TRUE(announced);
  WireClient client(connect_tcp(std::stoi(announced->substr(announced->rfind(':') + 1))));
  ASSERT_TRUE(client.open_session());
  ASSERT_TRUE(client.send(encode_command(Command::config)));
  EXPECT_TRUE(client.await(0x20));
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(client.await_sip());
  EXPECT_EQ(sim.end(SIGINT), 0);
  client.listen(100ms);
  EXPECT_TRUE(client.hung_up());
}

TEST_F(AzimuthSim, RaisesTheBaudOnRequest) {
  SimProcess sim({"--device", link()});
  ASSERT_TRUE(sim.output_until("robot at"));
  WireClient client(open_serial(link(), 9600));
  ASSERT_TRUE(client.open_session());
  ASSERT_TRUE(client.send(encode_command(Command::host_baud, 4)));
  ASSERT_TRUE(sim.output_until("115200 baud"));
  set_baud(client.fd(), 115200);
  client.listen(50ms);
  ASSERT_TRUE(client.send(encode_command(Command::pulse)));
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(client.await_sip());
  ASSERT_TRUE(client.send(encode_command(Command::close)));
  EXPECT_TRUE(sim.output_until("9600 baud")) << "falls back by itself";
}

TEST_F(AzimuthSim, SpeaksGarbageToTheWrongBaud) {
  SimProcess sim({"--device", link(), "--baud", "38400", "--fault", "old_session"});
  ASSERT_TRUE(sim.output_until("robot at"));
  WireClient client(open_serial(link(), 9600));
  EXPECT_TRUE(client.listen(1s).empty());
  EXPECT_GT(client.bytes(), 20U);
  set_baud(client.fd(), 38400);
  EXPECT_TRUE(client.await_sip());
}

TEST_F(AzimuthSim, ComesBackAfterAnUnplug) {
  SimProcess sim({"--device", link()});
  ASSERT_TRUE(sim.output_until("robot at"));
  WireClient client(open_serial(link(), 9600));
  ASSERT_TRUE(client.open_session());
  const int before = sip_x(*client.await_sip());
  sim.say("unplug=0.5");
  ASSERT_TRUE(sim.output_until("unplugged"));
  client.listen(5s);
  EXPECT_TRUE(client.hung_up());
  ASSERT_TRUE(sim.output_until("plugged in again"));
  WireClient again(open_serial(link(), 9600));
  const auto sip = again.await_sip();
  ASSERT_TRUE(sip) << "the old session is open still";
  EXPECT_GT(sip_x(*sip), before + 20);
}

TEST_F(AzimuthSim, TakesFaultsByScheduleInputAndSocket) {
  const std::string control = (folder / "control").string();
  SimProcess sim({"--device", link(), "--at", "0.2:noise=0.5", "--every", "0.5", "--cycle", "stall,stall=none",
                  "--control", control});
  EXPECT_TRUE(sim.output_until("fault noise=0.5"));
  EXPECT_TRUE(sim.output_until("fault stall=both"));
  EXPECT_TRUE(sim.output_until("fault stall=none"));
  sim.say("noise=0");
  EXPECT_TRUE(sim.output_until("noise=0"));
  EXPECT_TRUE(fs::is_socket(control));
  sim.say("quit");
  EXPECT_EQ(sim.end(0), 0);
  EXPECT_FALSE(fs::exists(control));
}

TEST_F(AzimuthSim, HandsBearingsOverWithStampsOfThisMachine) {
  const std::string socket = (folder / "camera").string();
  SimProcess sim({"--device", link(), "--camera-socket", socket});
  ASSERT_TRUE(sim.output_until("robot at"));
  SharedCamera camera(socket);
  std::vector<BearingSet> sets;
  for (int i = 0; i < 2000 && sets.size() < 10; ++i) {
    camera.turn(std::chrono::steady_clock::now());
    BearingSet set;
    while (camera.take(set)) sets.push_back(set);
    ::usleep(5000);
  }
  ASSERT_GE(sets.size(), 10U);
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  EXPECT_GE(now, sets.back().stamp.time_since_epoch());
  EXPECT_LT(now - sets.back().stamp.time_since_epoch(), 5s);
  for (std::size_t i = 1; i < sets.size(); ++i) EXPECT_GT(sets[i].sequence, sets[i - 1].sequence);
}

TEST_F(AzimuthSim, EndsWhenItsTimeIsUpAndLeavesItsFiles) {
  SimProcess sim({"--tcp", "0", "--speed", "50", "--duration", "30", "--truth", (folder / "truth.csv").string(),
                  "--run-folder", (folder / "run").string(), "--quiet"});
  EXPECT_EQ(sim.end(0), 0);
  std::ifstream truth(folder / "truth.csv");
  int lines = 0;
  for (std::string line; std::getline(truth, line);) ++lines;
  EXPECT_GE(lines, 3001) << "every 10 ms";
  EXPECT_LE(lines, 3600) << "on a busy machine it ends a little late";
  EXPECT_TRUE(fs::exists(folder / "run" / "landmarks.csv"));
}

TEST_F(AzimuthSim, RefusesWhatStandsInTheWay) {
  std::ofstream(folder / "robot") << "not a link";
  SimProcess sim({"--device", link()});
  EXPECT_EQ(sim.end(0), 1);
  SimProcess nonsense({"--device", link(), "--fault", "nonsense"});
  EXPECT_EQ(nonsense.end(0), 2);
}

}  // namespace
}  // namespace azimuth::sim
