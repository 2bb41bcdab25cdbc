// Tests the answer to each path, and the access control.

#include "tools/view_server/window.hpp"

#include <gmock/gmock.h>
#include <memory>
#include <span>
#include <string>
#include <thread>

#include "tests/tools/view_server/http_client.hpp"
#include "tests/tools/view_server/served.hpp"
#include "tools/page/html_page.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

const std::string kToken = "0123456789abcdef";

class WindowTest : public testing::Test {
 protected:
  std::string ask(const std::string& request) const { return asked(served_->port(), request); }
  std::string sentence_at(const std::string& path) const { return body_of(ask(get(path))); }

  void serve(WindowSettings settings = {}) {
    window_ = std::make_unique<LiveWindow>(std::move(settings), view_, lookers_, std::chrono::steady_clock::now());
    served_ = std::make_unique<Served>(HttpSettings{}, *window_);
  }

  Lookers lookers_;
  LiveView view_{"azimuth test", "nowhere", lookers_, std::chrono::steady_clock::now()};
  std::unique_ptr<LiveWindow> window_;
  std::unique_ptr<Served> served_;
};

TEST_F(WindowTest, ServesTheModulesByTheirExactNamesAlone) {
  serve();
  for (const PageFile& file : page_files()) {
    const std::string answer = ask(get("/modules/" + std::string(file.name)));
    EXPECT_EQ(body_of(answer), file.text) << file.name;
    if (file.name.ends_with(".js")) {
      EXPECT_THAT(answer, HasSubstr("Content-Type: text/javascript; charset=utf-8"));
    }
    if (file.name.ends_with(".css")) {
      EXPECT_THAT(answer, HasSubstr("Content-Type: text/css; charset=utf-8"));
    }
  }
}

TEST_F(WindowTest, NothingElseCanBeRead) {
  serve();
  for (const char* const path : {"/../../../../etc/passwd", "/modules/../../etc/passwd",
                                 "/modules/..%2f..%2fetc%2fpasswd", "/modules//etc/passwd", "/modules/", "/modules",
                                 "/modules/page.css/", "//etc/passwd", "/modules/%2e%2e/page.css", "/modules/PAGE.CSS",
                                 "/run.json", "/etc/passwd", "/modules/page.css\\..", "http://localhost/etc/passwd"}) {
    const std::string answer = ask(get(path));
    EXPECT_THAT(answer, Not(HasSubstr("root:"))) << path;
    EXPECT_NE(status_of(answer), 200) << path;
  }
}

TEST_F(WindowTest, SaysThatThereIsNoPicture) {
  serve();
  EXPECT_EQ(status_of(ask(get("/picture?n=1"))), 404);
  EXPECT_THAT(sentence_at("/picture"), HasSubstr("daemon.picture.rate_hz"));
  served_->there(
      [&](HttpServer&) { view_.take_picture(stamp_from_us(1), std::as_bytes(std::span(kToken)), 640, 480, {}); });
  const std::string answer = ask(get("/picture?n=1"));
  EXPECT_EQ(body_of(answer), kToken);
  EXPECT_THAT(answer, HasSubstr("Content-Type: image/jpeg"));
}

TEST_F(WindowTest, HealthIsPlainJson) {
  serve();
  EXPECT_THAT(sentence_at("/health"), HasSubstr("{\"shows\":\"live\",\"lookers\":0,\"uptime_s\":"));
}

TEST_F(WindowTest, AnotherNameForThisMachineIsRefused) {
  serve();
  const std::string answer = ask(get("/", "", "rebound.example"));
  EXPECT_EQ(status_of(answer), 403);
  EXPECT_THAT(body_of(answer), HasSubstr("localhost"));
}

TEST_F(WindowTest, PagesOfOtherSitesMayNotLookIn) {
  serve();
  EXPECT_EQ(status_of(ask(get("/events", "Sec-Fetch-Site: cross-site\r\n"))), 403);
  EXPECT_NE(status_of(ask(get("/health", "Sec-Fetch-Site: same-origin\r\n"))), 403);
}

TEST_F(WindowTest, WithoutTheTokenNothingIsShown) {
  serve({.token = kToken});
  for (const std::string path :
       {"/", "/events", "/health", "/picture", "/modules/page.css", "/?token=", "/?token=wrong",
        "/?token=0123456789abcde", "/?token=0123456789abcdeF", "/health?token=0123456789abcdef"}) {
    const std::string answer = ask(get(path));
    EXPECT_EQ(status_of(answer), 403) << path;
    EXPECT_THAT(body_of(answer), HasSubstr("token")) << path;
    EXPECT_THAT(answer, Not(HasSubstr(kToken))) << path;
  }
  EXPECT_EQ(status_of(ask(get("/health", "Cookie: azimuth_view=wrong\r\n"))), 403);
}

TEST_F(WindowTest, TheTokenIsChangedForACookieOnce) {
  serve({.token = kToken});
  const std::string answer = ask(get("/?token=" + kToken, "", "192.168.1.7:8017"));
  EXPECT_EQ(status_of(answer), 303);
  EXPECT_THAT(answer, HasSubstr("Location: /\r\n"));
  EXPECT_THAT(answer, HasSubstr("Set-Cookie: azimuth_view=" + kToken + "; HttpOnly; SameSite=Strict; Path=/"));
  EXPECT_EQ(status_of(ask(get("/health", "Cookie: azimuth_view=" + kToken + "\r\n", "192.168.1.7:8017"))), 200);
}

TEST_F(WindowTest, OnlySoManyMayLookAtOnce) {
  serve({.lookers = 2});
  HttpClient first(served_->port()), second(served_->port());
  for (HttpClient* const each : {&first, &second}) {
    each->send(get("/events"));
    EXPECT_THAT(each->read(5s, "event: hello"), HasSubstr("text/event-stream"));
  }
  const std::string answer = ask(get("/events"));
  EXPECT_EQ(status_of(answer), 503);
  EXPECT_THAT(body_of(answer), HasSubstr("2 look already"));
  EXPECT_EQ(status_of(ask("HEAD /events HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")), 200);
}

TEST_F(WindowTest, WhoGoesMakesRoom) {
  serve({.lookers = 1});
  for (int i = 0; i < 5; ++i) {
    HttpClient looker(served_->port());
    looker.send(get("/events"));
    EXPECT_THAT(looker.read(5s, "event: hello"), HasSubstr("event: hello")) << i;
    looker = HttpClient(served_->port());                     // the page is gone
    served_->there([&](HttpServer&) { view_.restart({}); });  // the server notices this when it sends an event
    for (int k = 0; k < 100; ++k) {
      std::size_t looking = 1;
      served_->there([&](HttpServer&) {
        view_.restart({});
        looking = lookers_.size();
      });
      if (looking == 0) break;
      std::this_thread::sleep_for(10ms);
    }
  }
}

TEST_F(WindowTest, ARecordingHasItsDataAndNoEvents) {
  RecordedWindow window({}, "{\"runs\":[]}", std::chrono::steady_clock::now());
  Served served(HttpSettings{}, window);
  EXPECT_EQ(body_of(asked(served.port(), get("/run.json"))), "{\"runs\":[]}");
  EXPECT_EQ(status_of(asked(served.port(), get("/events"))), 404);
}

}  // namespace
}  // namespace azimuth::test
