#pragma once
// HTTP for browsers, read only: what the kept library libmicrohttpd does, within bounds.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace azimuth {

struct HttpSettings {
  std::string address = "127.0.0.1";  ///< numeric, IPv4 or IPv6
  std::uint16_t port = 0;             ///< 0: any that is free
  unsigned connections = 200;         ///< at once; beyond, the longest idle give way
  std::size_t memory_per_connection = 32'768;
  /// For a whole request, for a keep-alive connection until the next one, and for a reader to take anything at all.
  std::chrono::seconds patience{10};
};

/// A request, GET or HEAD. Borrows what the connection has.
class HttpRequest {
 public:
  virtual ~HttpRequest() = default;
  virtual std::string_view path() const = 0;  ///< decoded, without what follows "?"
  virtual std::optional<std::string_view> argument(const char* name) const = 0;
  virtual std::optional<std::string_view> header(const char* name) const = 0;
  virtual std::optional<std::string_view> cookie(const char* name) const = 0;
  virtual bool is_head() const = 0;
};

/// Bytes without an end. Dies with its connection.
class HttpStream {
 public:
  virtual ~HttpStream() = default;
  virtual std::size_t read(std::span<char> into) = 0;  ///< 0: nothing at present
  virtual bool has_something() const = 0;
};

struct HttpAnswer {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::shared_ptr<const std::string> body;
  std::vector<std::pair<std::string, std::string>> headers = {};
  std::unique_ptr<HttpStream> stream = {};  ///< in place of a body
};

/// A sentence as an answer.
HttpAnswer sentence(unsigned status, std::string_view text);

class HttpHandler {
 public:
  virtual ~HttpHandler() = default;
  virtual HttpAnswer answer(const HttpRequest& request) = 0;
};

/// What it served so far.
struct HttpCounts {
  std::uint64_t connections = 0, requests = 0;
  std::uint64_t given_up = 0;  ///< connections that asked too slowly, or gave way
};

/// Serves from the thread that polls: nothing blocks, however slowly anybody asks or reads, and there is no thread of
/// its own. Other methods than GET and HEAD are answered 405, and every answer has the headers that keep a page to
/// itself; what is no HTTP at all the library answers in its own words.
///
/// Thread contract: thread-bound. Borrows the handler. Streams die before it does.
class HttpServer {
 public:
  using Clock = std::chrono::steady_clock;

  /// The error is a sentence.
  static tl::expected<std::unique_ptr<HttpServer>, std::string> open(const HttpSettings& settings,
                                                                     HttpHandler& handler);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  std::uint16_t port() const;
  int descriptor() const;  ///< to poll for reading
  /// When turn() is wanted without any event; none: never.
  std::optional<Clock::duration> due_in() const;
  void turn();

  const HttpCounts& counts() const;
  std::size_t connections() const;  ///< open now

 private:
  class Library;
  explicit HttpServer(std::unique_ptr<Library> library);
  std::unique_ptr<Library> library_;
};

}  // namespace azimuth
