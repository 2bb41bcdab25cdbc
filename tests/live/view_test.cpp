// azimuth view beside azimuthd, both as processes in a network namespace of their own. A viewer must see what another
// subscriber receives.

#include <algorithm>
#include <azimuth/pose_cov_t.hpp>
#include <azimuth/sightings_t.hpp>
#include <azimuth/status_t.hpp>
#include <csignal>
#include <gmock/gmock.h>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/daemon/child_process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/tools/view/seen_events.hpp"
#include "tests/tools/view_server/http_client.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr auto kPatience = 30s;

/// Collects the messages that another program receives.
class Subscriber {
 public:
  Subscriber() {
    lcm_.subscribe("AZIMUTH_POSE", &Subscriber::take_pose, this);
    lcm_.subscribe("AZIMUTH_STATUS", &Subscriber::take_status, this);
    lcm_.subscribe("AZIMUTH_SIGHTINGS", &Subscriber::take_sightings, this);
  }
  void hear(std::chrono::milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end) lcm_.handleTimeout(5);
  }

  std::map<std::int64_t, pose_cov_t> poses;  // by sequence number
  std::vector<status_t> statuses;
  std::vector<sightings_t> sightings;

 private:
  void take_pose(const lcm::ReceiveBuffer*, const std::string&, const pose_cov_t* pose) { poses[pose->seq] = *pose; }
  void take_status(const lcm::ReceiveBuffer*, const std::string&, const status_t* status) {
    statuses.push_back(*status);
  }
  void take_sightings(const lcm::ReceiveBuffer*, const std::string&, const sightings_t* message) {
    sightings.push_back(*message);
  }

  lcm::LCM lcm_{"udpm://239.255.76.67:7667?ttl=0"};
};

class ViewTest : public testing::Test {
 protected:
  void SetUp() override {
    view_ = std::make_unique<ChildProcess>(std::vector<std::string>{AZIMUTH, "view", "--port", "0"}, folder("view"));
    ASSERT_TRUE(
        eventually([&] { return view_->standard_output().find("http://localhost:") != std::string::npos; }, kPatience))
        << view_->standard_error();
    const std::string said = view_->standard_output();
    port_ = static_cast<std::uint16_t>(std::stoi(said.substr(said.find("localhost:") + 10)));
  }

  std::filesystem::path folder(const std::string& name) const {
    std::filesystem::create_directories(folder_.path() / name);
    return folder_.path() / name;
  }

  std::unique_ptr<ChildProcess> play(const std::string& speed, const std::string& name = "daemon") const {
    return std::make_unique<ChildProcess>(
        std::vector<std::string>{AZIMUTHD, "--play", AZIMUTH_RUNS "/lab", "--speed", speed}, folder(name));
  }

  /// Opens the event stream as a page does.
  std::unique_ptr<HttpClient> look() const {
    auto client = std::make_unique<HttpClient>(port_);
    client->send(get("/events"));
    return client;
  }

  /// The events so far, without the HTTP header and the chunk sizes.
  static std::vector<SeenEvent> events_of(const std::string& answer) {
    std::string rest = body_of(answer), text;
    for (std::size_t end = rest.find("\r\n"); end != std::string::npos; end = rest.find("\r\n")) {
      const std::size_t size = std::stoul(rest.substr(0, end), nullptr, 16);
      text += rest.substr(end + 2, size);
      if (rest.size() < end + 2 + size + 2) break;
      rest.erase(0, end + 2 + size + 2);
    }
    return take_events(text);
  }

  TemporaryFolder folder_;
  std::unique_ptr<ChildProcess> view_;
  std::uint16_t port_ = 0;
};

TEST_F(ViewTest, WhoLooksSeesWhatAnotherSubscriberHears) {
  Subscriber subscriber;
  const auto looker = look();
  std::string answer = looker->read(5s, "event: hello");
  const auto daemon = play("10");
  subscriber.hear(8s);
  answer += looker->read(1s);
  const std::vector<SeenEvent> events = events_of(answer);

  std::size_t compared = 0, used = 0;
  double greatest_used = 0;
  for (const SeenEvent& event : events) {
    if (event.name == "bearings")
      for (const auto& bearing : event.data["bearings"]) used += bearing[4] == "used" ? 1 : 0;
    if (event.name != "pose") continue;
    const auto heard = subscriber.poses.find(event.data["seq"].get<std::int64_t>());
    if (heard == subscriber.poses.end()) continue;  // lost on one of the two ways
    ++compared;
    const pose_cov_t& pose = heard->second;
    EXPECT_EQ(event.data["utime"], pose.utime);
    EXPECT_EQ(event.data["x"], pose.x_m) << "to the last bit";
    EXPECT_EQ(event.data["y"], pose.y_m);
    EXPECT_EQ(event.data["heading"], pose.heading_rad);
    EXPECT_EQ(event.data["covariance"][1], pose.covariance[1]);
    EXPECT_EQ(event.data["health"], pose.health);
    greatest_used = std::max(greatest_used, event.data["t"].get<double>());
  }
  EXPECT_GE(compared, 100U) << "30 a second for some seconds";
  EXPECT_GT(greatest_used, 30.0) << "the drive, at ten times its pace";
  EXPECT_GT(used, 100U) << "what became of bearings";
  ASSERT_FALSE(subscriber.statuses.empty());
  const auto status = std::ranges::find_if(events, [&](const SeenEvent& event) {
    return event.name == "status" && event.data["seq"] == subscriber.statuses.back().seq;
  });
  ASSERT_NE(status, events.end());
  EXPECT_EQ(status->data["accepted"], subscriber.statuses.back().accepted);
  EXPECT_EQ(status->data["landmarks"], subscriber.statuses.back().landmarks);
  EXPECT_EQ(status->data["rejected"], subscriber.statuses.back().rejected);
}

TEST_F(ViewTest, SightingsAreThoseThatTheStatusCounts) {
  Subscriber subscriber;
  const auto daemon = play("20");
  subscriber.hear(5s);
  ASSERT_GT(subscriber.sightings.size(), 50U);
  for (const sightings_t& each : subscriber.sightings) EXPECT_EQ(each.n, static_cast<int>(each.sightings.size()));
  for (std::size_t i = 1; i < subscriber.sightings.size(); ++i) {
    const sightings_t &before = subscriber.sightings[i - 1], &now = subscriber.sightings[i];
    EXPECT_GT(now.step, before.step);
    EXPECT_GE(now.accepted - before.accepted, 0);
  }
}

TEST_F(ViewTest, ADaemonThatStartsAnewIsSeenToDoSoAndSilenceIsTold) {
  const auto looker = look();
  std::string answer = looker->read(5s, "event: hello");
  auto daemon = play("10");
  answer += looker->read(kPatience, "event: pose");
  daemon->signal(SIGKILL);
  daemon->wait(kPatience);
  std::string silence = looker->read(5s, "event: silence");
  EXPECT_THAT(silence, HasSubstr("event: silence"));
  daemon = play("10", "another");
  const std::string after = looker->read(kPatience, "event: restarted");
  EXPECT_THAT(after, HasSubstr("event: restarted"));
  EXPECT_THAT(after + looker->read(kPatience, "event: pose"), HasSubstr("event: hello"));
}

TEST_F(ViewTest, EndsWhenItIsToldTo) {
  const auto looker = look();
  looker->read(5s, "event: hello");
  view_->signal(SIGTERM);
  EXPECT_EQ(view_->wait(kPatience), 0);
}

/// The stopped readers act like a laptop that sleeps.
TEST_F(ViewTest, LookersThatStandStillDelayNoOther) {
  std::vector<std::unique_ptr<ChildProcess>> stopped;
  for (int i = 0; i < 5; ++i) {
    stopped.push_back(std::make_unique<ChildProcess>(
        std::vector<std::string>{"python3", "-c",
                                 "import socket\ns = socket.create_connection(('127.0.0.1', " + std::to_string(port_) +
                                     "))\ns.send(b'GET /events HTTP/1.1\\r\\nHost: localhost\\r\\n\\r\\n')\n"
                                     "while s.recv(1000): print('.', flush=True)\n"},
        folder("stopped" + std::to_string(i))));
    ASSERT_TRUE(eventually([&] { return !stopped.back()->standard_output().empty(); }, kPatience));
    stopped.back()->signal(SIGSTOP);
  }
  const auto looker = look();
  looker->read(5s, "event: hello");
  const auto daemon = play("10");
  looker->read(kPatience, "event: pose");
  const std::string text = looker->read(4s);
  std::size_t poses = 0;
  for (std::size_t at = 0; (at = text.find("event: pose\n", at)) != std::string::npos; ++at) ++poses;
  EXPECT_GE(poses, 80U) << "30 a second";
  for (const auto& each : stopped) each->signal(SIGCONT);
}

}  // namespace
}  // namespace azimuth::test
