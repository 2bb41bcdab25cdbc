// Twenty pages show a robot, and five of them have stopped reading. The streams of the others must not be delayed.

#include <gmock/gmock.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/tools/view_server/http_client.hpp"
#include "tests/tools/view_server/served.hpp"
#include "tools/view_server/window.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;

constexpr int kLookers = 20, kStopped = 5, kPoses = 90;

/// A map that is large enough to fill the buffers of a stopped reader.
map_chunk_t a_large_map(std::int64_t sequence) {
  map_chunk_t map{};
  map.seq = sequence;
  map.chunks = 1;
  map.landmarks.resize(map_chunk_t::MAX_LANDMARKS);
  for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
    map.landmarks[i].id = static_cast<std::int64_t>(i);
    map.landmarks[i].x_m = 1e-3 * static_cast<double>(sequence);
  }
  map.n = map_chunk_t::MAX_LANDMARKS;
  return map;
}

TEST(ManyLookers, ThoseThatStoppedDelayNobodyElse) {
  Lookers lookers;
  LiveView view("azimuth test", "nowhere", lookers, std::chrono::steady_clock::now());
  LiveWindow window({}, view, lookers, std::chrono::steady_clock::now());
  Served served({.patience = 60s}, window);
  std::vector<std::unique_ptr<HttpClient>> clients;
  for (int i = 0; i < kLookers; ++i) {
    clients.push_back(std::make_unique<HttpClient>(served.port(), i < kStopped ? 4096 : 0));
    clients.back()->send(get("/events"));
    clients.back()->read(5s, "event: hello");
  }
  std::vector<std::size_t> poses(kLookers);
  std::vector<std::thread> readers;
  for (int i = kStopped; i < kLookers; ++i)
    readers.emplace_back([&, i] {
      const std::string text = clients[static_cast<std::size_t>(i)]->read(20s, "\"seq\":" + std::to_string(kPoses));
      for (std::size_t at = 0; (at = text.find("event: pose\n", at)) != std::string::npos; ++at)
        ++poses[static_cast<std::size_t>(i)];
    });
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 1; i <= kPoses; ++i) {
    served.there([&](HttpServer&) {
      pose_cov_t pose{};
      pose.seq = i;
      pose.utime = 1000 * i;
      pose.x_m = i;
      const Reception now{std::chrono::steady_clock::now(), 0};
      view.take_map(a_large_map(i), now);
      view.take_pose(pose, now);
    });
    std::this_thread::sleep_for(35ms);
  }
  for (std::thread& reader : readers) reader.join();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 15s);
  for (int i = kStopped; i < kLookers; ++i)
    EXPECT_GE(poses[static_cast<std::size_t>(i)], static_cast<std::size_t>(kPoses) * 9 / 10) << i;
}

}  // namespace
}  // namespace azimuth::test
