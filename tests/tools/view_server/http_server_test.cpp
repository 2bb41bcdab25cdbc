// Sends arbitrary requests to the server. It must answer or close the connection, and continue.

#include "tools/view_server/http_server.hpp"

#include <gmock/gmock.h>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/tools/view_server/http_client.hpp"
#include "tests/tools/view_server/served.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;
using testing::AnyOf;
using testing::EndsWith;
using testing::Eq;
using testing::HasSubstr;
using testing::Not;

/// Answers with the path of the request.
class Echo : public HttpHandler {
 public:
  HttpAnswer answer(const HttpRequest& request) override {
    if (request.path() == "/large") return {.body = large_};
    return sentence(200, "path " + std::string(request.path()));
  }
  std::shared_ptr<const std::string> large_ = std::make_shared<const std::string>(20'000'000, 'x');
};

class HttpServerTest : public testing::Test {
 protected:
  std::string ask(const std::string& request) const { return asked(served_.port(), request); }
  void expect_alive() const { EXPECT_THAT(ask(get("/still")), EndsWith("path /still\n")); }

  Echo echo_;
  Served served_{{.patience = 2s}, echo_};
};

TEST_F(HttpServerTest, AnswersWithHeadersThatKeepAPageToItself) {
  const std::string answer = ask(get("/"));
  EXPECT_EQ(status_of(answer), 200);
  EXPECT_THAT(answer, HasSubstr("Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'"));
  EXPECT_THAT(answer, HasSubstr("X-Content-Type-Options: nosniff"));
  EXPECT_THAT(answer, HasSubstr("Referrer-Policy: no-referrer"));
  EXPECT_THAT(answer, HasSubstr("Cache-Control: no-store"));
}

TEST_F(HttpServerTest, NothingIsWritten) {
  for (const std::string method :
       {"POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT", "PROPFIND", "QUIT"}) {
    const std::string answer =
        ask(method + " / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Length: 0\r\n\r\n");
    EXPECT_EQ(status_of(answer), 405) << method;
    EXPECT_THAT(answer, HasSubstr("Allow: GET, HEAD")) << method;
    EXPECT_THAT(answer, HasSubstr("Content-Security-Policy")) << method;
  }
}

TEST_F(HttpServerTest, ABodyThatIsNotWantedIsNotRead) {
  HttpClient client(served_.port());
  client.send("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000000000\r\n\r\n");
  EXPECT_EQ(status_of(client.read(10s)), 405);
  EXPECT_TRUE(client.closed());
  expect_alive();
}

TEST_F(HttpServerTest, WhatComesBehindTheHeadersIsPassedOverAsLongAsPatienceLasts) {
  EXPECT_THAT(ask("GET /x HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Length: 5\r\n\r\nhello"),
              EndsWith("path /x\n"));
  HttpClient endless(served_.port());
  endless.send("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000000000\r\n\r\n");
  const auto begin = std::chrono::steady_clock::now();
  while (endless.send(std::string(1000, 'x')) && std::chrono::steady_clock::now() - begin < 8s) endless.read(20ms);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 6s);
  expect_alive();
}

TEST_F(HttpServerTest, HeadHasNoBody) {
  const std::string answer = ask("HEAD /x HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(status_of(answer), 200);
  EXPECT_EQ(body_of(answer), "");
}

TEST_F(HttpServerTest, MalformedRequestsAreRefusedAndNothingElseHappens) {
  const std::string nul = std::string("GET /") + '\0' + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
  for (const std::string& request : {
           std::string("\r\n\r\n\r\n"),
           std::string("GET\r\n\r\n"),
           std::string("GET /\r\n\r\n"),
           std::string("GET / HTTP/9.9\r\nHost: localhost\r\n\r\n"),
           std::string("GET / HTTP/1.1\r\n\r\n"),  // the Host header is missing
           std::string("GET  /  HTTP/1.1  \r\nHost: localhost\r\n\r\n"),
           std::string("GET / HTTP/1.1\r\nHost: localhost\r\nno colon\r\n\r\n"),
           std::string("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: -1\r\n\r\n"),
           std::string("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: zwei\r\n\r\n"),
           std::string("GET / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n"),
           std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03 a TLS hello\r\n\r\n"),
           std::string("GET /%00%0d%0aSet-Cookie:%20x HTTP/1.1\r\nHost: localhost\r\n\r\n"),
           std::string("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"),
           nul,
       }) {
    HttpClient client(served_.port());
    client.send(request);
    const std::string answer = client.read(300ms);
    EXPECT_THAT(answer, Not(HasSubstr("\nSet-Cookie"))) << request;
    EXPECT_THAT(status_of(answer), AnyOf(0, 200, AnyOf(400, 405, 411, 413, 501, 505))) << request;
  }
  expect_alive();
}

/// The HTTP library answers malformed requests itself, without our security headers. Such an answer must repeat nothing
/// of the request.
TEST_F(HttpServerTest, WhatIsAnsweredWithoutOurHeadersRepeatsNothingThatWasSent) {
  const std::string script = "<script>alert(1)</script>";
  std::size_t by_the_library = 0;
  for (const std::string& request : {
           "GET /" + script + " HTTP/9.9\r\nHost: localhost\r\n\r\n",
           "GET /" + script + " HTTP/1.1\r\n\r\n",
           script + " / HTTP/1.1\r\nHost: localhost\r\nContent-Length: -1\r\n\r\n",
           "GET / HTTP/1.1\r\nHost: localhost\r\n" + script + "\r\n\r\n",
           "GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + script + "\r\n\r\n",
           "GET /" + script + std::string(100'000, 'a') + " HTTP/1.1\r\nHost: localhost\r\n\r\n",
       }) {
    HttpClient client(served_.port());
    client.send(request);
    const std::string answer = client.read(300ms);
    if (answer.empty() || answer.find("Content-Security-Policy") != std::string::npos) continue;
    ++by_the_library;
    EXPECT_THAT(answer, Not(HasSubstr("script"))) << request;
    EXPECT_THAT(answer, HasSubstr("Connection: close")) << request;
    EXPECT_GE(status_of(answer), 400) << request;
  }
  EXPECT_GT(by_the_library, 0U) << "else every answer has our headers, and documents may say so";
}

TEST_F(HttpServerTest, OverlongLinesAndHeadersAreRefused) {
  EXPECT_THAT(status_of(ask(get("/" + std::string(100'000, 'a')))), AnyOf(0, 413, AnyOf(414, 431)));
  EXPECT_THAT(status_of(ask(get("/", "X: " + std::string(100'000, 'a') + "\r\n"))), AnyOf(0, 413, 431));
  std::string many;
  for (int i = 0; i < 10'000; ++i) many += "X" + std::to_string(i) + ": y\r\n";
  EXPECT_THAT(status_of(ask(get("/", many))), AnyOf(0, 413, 431));
  expect_alive();
}

TEST_F(HttpServerTest, AnyBytesAtAllDoNoHarm) {
  std::mt19937 random(17);
  for (int i = 0; i < 300; ++i) {
    std::string bytes = i % 2 == 0 ? get("/") : std::string();
    for (int k = 0; k < 40; ++k) {
      const auto at = bytes.empty() ? 0 : random() % bytes.size();
      bytes.insert(at, 1, static_cast<char>(random()));
    }
    HttpClient client(served_.port());
    client.send(bytes + "\r\n\r\n");
  }
  expect_alive();
}

TEST_F(HttpServerTest, WhoAsksTooSlowlyIsGivenUp) {
  HttpClient client(served_.port());
  const std::string request = get("/");
  const auto begin = std::chrono::steady_clock::now();
  bool goes_on = true;
  for (std::size_t i = 0; goes_on && i < request.size(); ++i) {  // a byte per 200 ms: never idle
    goes_on = client.send(request.substr(i, 1));
    client.read(200ms);
    goes_on = goes_on && !client.closed();
  }
  EXPECT_FALSE(goes_on);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 6s);
  expect_alive();
}

TEST_F(HttpServerTest, ThousandsOfIdleConnectionsGiveWayToOneThatAsks) {
  std::vector<std::unique_ptr<HttpClient>> idle;
  for (int i = 0; i < 2000; ++i) {
    idle.push_back(std::make_unique<HttpClient>(served_.port()));
    if (idle.size() > 400) idle.erase(idle.begin());  // the limit of file descriptors also holds for this process
  }
  const auto begin = std::chrono::steady_clock::now();
  expect_alive();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s);
  served_.there([](HttpServer& server) {
    EXPECT_LE(server.connections(), HttpSettings{}.connections);
    EXPECT_GE(server.counts().connections, 1000U);
  });
}

TEST_F(HttpServerTest, AReaderThatStopsDelaysNobodyAndIsGivenUp) {
  HttpClient stopped(served_.port(), 4096);
  stopped.send(get("/large"));
  for (int i = 0; i < 20; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    expect_alive();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 1s);
  }
  std::this_thread::sleep_for(4s);
  served_.there([](HttpServer& server) { EXPECT_EQ(server.connections(), 0U); });
}

TEST_F(HttpServerTest, ALargeAnswerComesWhole) {
  const std::string answer = ask(get("/large"));
  EXPECT_EQ(body_of(answer), *echo_.large_);
}

TEST_F(HttpServerTest, AConnectionServesMoreThanOnce) {
  HttpClient client(served_.port());
  for (int i = 0; i < 3; ++i) {
    client.send("GET /again HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_THAT(client.read(5s, "path /again\n"), EndsWith("path /again\n"));
  }
}

}  // namespace
}  // namespace azimuth::test
