// Runs `azimuth view` on recordings and sends the requests of a browser. tests/live/view_test.cpp tests the command on
// a running daemon.

#include <csignal>
#include <filesystem>
#include <gmock/gmock.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <sys/stat.h>
#include <vector>

#include "tests/daemon/child_process.hpp"
#include "tests/tools/azimuth/command_line.hpp"
#include "tests/tools/view_server/http_client.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;
using testing::HasSubstr;

/// Runs the command during the life of the object.
class Viewed {
 public:
  explicit Viewed(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {AZIMUTH_COMMAND, "view", "--port", "0"});
    process_ = std::make_unique<ChildProcess>(arguments, folder_.path());
    const auto is_up = [this] {
      return said().find(" is shown at http://") != std::string::npos || process_->wait(0ms);
    };
    eventually(is_up, 60s);
    const std::size_t host = said().find("http://");
    if (host != std::string::npos)
      port_ = static_cast<std::uint16_t>(std::stoi(said().substr(said().find(':', host + 5) + 1)));
  }

  std::string said() const { return process_->standard_output() + process_->standard_error(); }
  std::uint16_t port() const { return port_; }
  std::string ask(const std::string& path, const std::string& headers = {}) const {
    return asked(port_, get(path, headers));
  }
  Json run() const { return Json::parse(body_of(ask("/run.json"))); }
  std::optional<int> stop() {
    process_->signal(SIGTERM);
    return process_->wait(10s);
  }

 private:
  TemporaryFolder folder_;
  std::unique_ptr<ChildProcess> process_;
  std::uint16_t port_ = 0;
};

/// The data that a written page contains.
Json data_of_page(const std::string& file) {
  const std::string page = file_bytes(file), begin = R"(<script type="application/json" id="data">)";
  const std::size_t at = page.find(begin) + begin.size();
  return Json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST(ViewCommand, ShowsARunAsThePageOfAReplayDoes) {
  const ScratchFolder scratch;
  const std::string page = scratch / "page.html";
  ASSERT_EQ(azimuth({"replay", one_lap(), "--html", page, "--quiet"}).code, 0);
  Json written = data_of_page(page);
  Viewed viewed({one_lap(), "--quiet"});
  Json shown = viewed.run();
  for (Json* const each : {&written, &shown}) {
    (*each)["runs"][0]["series"].erase("step_us");  // differs between replays
    (*each)["runs"][0].erase("metrics");
  }
  EXPECT_EQ(shown, written);
  EXPECT_FALSE(shown["runs"][0]["series"]["x"].empty());
  EXPECT_EQ(viewed.stop(), 0);
}

TEST(ViewCommand, ShowsTwoRunsOverEachOther) {
  const Viewed viewed({one_lap(), one_lap(), "--quiet"});
  EXPECT_EQ(viewed.run()["runs"].size(), 2U);
  EXPECT_THAT(viewed.said(), HasSubstr("both recordings"));
}

TEST(ViewCommand, ShowsAMapFile) {
  const ScratchFolder scratch;
  const std::string map = scratch / "lab.azmap";
  ASSERT_EQ(azimuth({"map", "save", one_lap(), "--map", map, "--quiet"}).code, 0);
  const Viewed viewed({map});
  const Json run = viewed.run()["runs"][0];
  EXPECT_EQ(run["map"]["landmarks"].size(), 24U);
  EXPECT_EQ(run["name"], "lab.azmap");
  EXPECT_TRUE(run["series"]["t"].empty());
}

TEST(ViewCommand, ShowsARunThatEndsLost) {
  const Viewed viewed({one_lap(), "--quiet", "--set", "health.lost_sigma_m=0.0001"});
  EXPECT_EQ(viewed.run()["runs"][0]["health"].back()["health"], "lost");
}

TEST(ViewCommand, ALogThatWasCutOffSaysSo) {
  const ScratchFolder scratch;
  const std::string whole = scratch / "whole.lcm";
  ASSERT_EQ(azimuth({"import", one_lap(), whole}).code, 0);
  const std::string bytes = file_bytes(whole);
  EXPECT_EQ(Viewed({whole, "--quiet"}).run()["runs"][0]["unread"], "");
  for (const double part : {0.4, 0.9}) {
    const std::string cut = scratch / "cut.lcm";
    // Nearly every byte lies within an event, so this cut does too.
    write_file(cut, bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size()))));
    const Viewed viewed({cut, "--quiet"});
    const Json run = viewed.run()["runs"][0];
    EXPECT_THAT(run["unread"].get<std::string>(), HasSubstr("was cut off")) << part;
    EXPECT_FALSE(run["series"]["x"].empty()) << part;
  }
}

TEST(ViewCommand, ATokenOfAFileIsAskedFor) {
  const ScratchFolder scratch;
  const std::string token = "0123456789abcdef", file = scratch / "token";
  write_file(file, token + "\n");
  ::chmod(file.c_str(), S_IRUSR | S_IWUSR);
  const Viewed viewed({one_lap(), "--quiet", "--token-file", file});
  EXPECT_THAT(viewed.said(), HasSubstr("?token=" + token));
  EXPECT_EQ(status_of(viewed.ask("/run.json")), 403);
  EXPECT_EQ(status_of(viewed.ask("/run.json", "Cookie: azimuth_view_0=" + token + "\r\n")), 200);
}

TEST(ViewCommand, APortThatIsTakenIsSaid) {
  const Viewed first({one_lap(), "--quiet"});
  const Outcome second = azimuth({"view", one_lap(), "--quiet", "--port", std::to_string(first.port())});
  EXPECT_EQ(second.code, 1);
  EXPECT_THAT(second.err, HasSubstr("somebody else listens there already"));
}

}  // namespace
}  // namespace azimuth::test
