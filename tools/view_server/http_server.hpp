#pragma once
// A read-only HTTP server for browsers with bounded resources, based on libmicrohttpd.

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
  std::uint16_t port = 0;             ///< 0: any free port
  unsigned connections = 200;         ///< largest number of simultaneous connections; the longest idle ones are closed
  std::size_t memory_per_connection = 32'768;
  /// Time limit for a complete request, for the next request on a keep-alive connection, and for a client that does not
  /// read.
  std::chrono::seconds patience{10};
};

/// A GET or HEAD request. Borrows data of the connection.
class HttpRequest {
 public:
  virtual ~HttpRequest() = default;
  virtual std::string_view path() const = 0;  ///< decoded, without the query
  virtual std::optional<std::string_view> argument(const char* name) const = 0;
  virtual std::optional<std::string_view> header(const char* name) const = 0;
  virtual std::optional<std::string_view> cookie(const char* name) const = 0;
  virtual bool is_head() const = 0;
};

/// An endless byte stream as a response. It is destroyed with its connection.
class HttpStream {
 public:
  virtual ~HttpStream() = default;
  virtual std::size_t read(std::span<char> into) = 0;  ///< 0 if there is nothing at present
  virtual bool has_something() const = 0;
};

struct HttpAnswer {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::shared_ptr<const std::string> body;
  std::vector<std::pair<std::string, std::string>> headers = {};
  std::unique_ptr<HttpStream> stream = {};  ///< replaces the body if set
};

/// A plain-text answer with one sentence.
HttpAnswer sentence(unsigned status, std::string_view text);

class HttpHandler {
 public:
  virtual ~HttpHandler() = default;
  virtual HttpAnswer answer(const HttpRequest& request) = 0;
};

/// Statistics of the server.
struct HttpCounts {
  std::uint64_t connections = 0, requests = 0;
  std::uint64_t given_up = 0;  ///< connections closed because the client was too slow or the limit was reached
};

/// The server runs in the thread that polls and has no thread of its own. Slow clients never block it. Methods other
/// than GET and HEAD are answered with 405. Every answer has security headers that isolate the page. Malformed requests
/// are answered by the library.
///
/// Thread contract: thread-bound. Borrows the handler. All streams are destroyed before the handler.
class HttpServer {
 public:
  using Clock = std::chrono::steady_clock;

  /// Opens the server. The error is a sentence for the user.
  static tl::expected<std::unique_ptr<HttpServer>, std::string> open(const HttpSettings& settings,
                                                                     HttpHandler& handler);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  std::uint16_t port() const;
  int descriptor() const;  ///< to poll for reading
  /// Time until turn() must be called even without an event on descriptor(); nothing if that is not necessary.
  std::optional<Clock::duration> due_in() const;
  void turn();

  const HttpCounts& counts() const;
  std::size_t connections() const;  ///< open connections

 private:
  class Library;
  explicit HttpServer(std::unique_ptr<Library> library);
  std::unique_ptr<Library> library_;
};

}  // namespace azimuth
