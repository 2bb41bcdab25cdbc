#include "tools/view_server/http_server.hpp"

#include <algorithm>
#include <cassert>
#include <list>
#include <microhttpd.h>
#include <sys/socket.h>

#include "tools/view_server/listening_socket.hpp"

namespace azimuth {
namespace {

/// Send buffer of a connection. It is small, because data that the kernel buffers for a slow client becomes outdated.
constexpr int kSendBuffer_bytes = 131'072;
constexpr std::size_t kStreamBlock_bytes = 16'384;
/// Number of connections that are kept free for new clients.
constexpr std::size_t kSpareConnections = 16;

constexpr std::pair<const char*, const char*> kHeaders[] = {{"Content-Security-Policy",
                                                             "default-src 'none'; script-src 'self'; style-src 'self'; "
                                                             "img-src 'self' data: blob:; connect-src 'self'; base-uri "
                                                             "'none'; form-action 'none'; frame-ancestors 'none'"},
                                                            {"X-Content-Type-Options", "nosniff"},
                                                            {"Referrer-Policy", "no-referrer"},
                                                            {"Cache-Control", "no-store"},
                                                            {"Cross-Origin-Resource-Policy", "same-origin"}};

}  // namespace

namespace mhd {

struct Connection {
  int socket = -1;
  MHD_Connection* handle = nullptr;
  HttpServer::Clock::time_point idle_since{};
  bool is_answering = false;  // false while the server waits for a request
  bool is_shut = false;
  std::unique_ptr<HttpStream> stream;
  bool is_suspended = false;
};

class Request final : public HttpRequest {
 public:
  Request(MHD_Connection* connection, std::string_view path, bool is_head)
      : connection_(connection), path_(path), is_head_(is_head) {}

  std::string_view path() const override { return path_; }
  std::optional<std::string_view> argument(const char* name) const override {
    return value(MHD_GET_ARGUMENT_KIND, name);
  }
  std::optional<std::string_view> header(const char* name) const override { return value(MHD_HEADER_KIND, name); }
  std::optional<std::string_view> cookie(const char* name) const override { return value(MHD_COOKIE_KIND, name); }
  bool is_head() const override { return is_head_; }

 private:
  std::optional<std::string_view> value(MHD_ValueKind kind, const char* name) const {
    const char* const text = MHD_lookup_connection_value(connection_, kind, name);
    return text ? std::optional<std::string_view>(text) : std::nullopt;
  }

  MHD_Connection* connection_;
  std::string_view path_;
  bool is_head_;
};

}  // namespace mhd

namespace {

using mhd::Connection;

/// Keeps a body alive as long as the response needs it.
struct HeldBody {
  std::shared_ptr<const std::string> text;
};

ssize_t read_body(void* held, std::uint64_t position, char* into, std::size_t room) {
  const std::string& text = *static_cast<HeldBody*>(held)->text;
  if (position >= text.size()) return MHD_CONTENT_READER_END_OF_STREAM;
  const std::size_t count = std::min<std::size_t>(room, text.size() - position);
  std::copy_n(text.data() + position, count, into);
  return static_cast<ssize_t>(count);
}

/// Reads from the stream. If there is nothing at present, suspends the connection until there is.
ssize_t read_stream(void* context, std::uint64_t, char* into, std::size_t room) {
  auto& connection = *static_cast<Connection*>(context);
  const std::size_t count = connection.stream->read({into, room});
  if (count == 0) {
    MHD_suspend_connection(connection.handle);
    connection.is_suspended = true;
  }
  return static_cast<ssize_t>(count);
}

MHD_Response* response_of(HttpAnswer& answer, Connection& connection) {
  if (answer.stream) {
    connection.stream = std::move(answer.stream);
    return MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, kStreamBlock_bytes, read_stream, &connection, nullptr);
  }
  if (!answer.body || answer.body->empty()) return MHD_create_response_from_buffer(0, nullptr, MHD_RESPMEM_PERSISTENT);
  return MHD_create_response_from_callback(answer.body->size(), kStreamBlock_bytes, read_body,
                                           new HeldBody{answer.body},
                                           [](void* held) { delete static_cast<HeldBody*>(held); });
}

MHD_Result queue(HttpAnswer answer, Connection& connection) {
  MHD_Response* const response = response_of(answer, connection);
  if (!response) return MHD_NO;
  for (const auto& [name, value] : kHeaders) MHD_add_response_header(response, name, value);
  MHD_add_response_header(response, "Content-Type", answer.type.c_str());
  for (const auto& [name, value] : answer.headers) MHD_add_response_header(response, name.c_str(), value.c_str());
  const MHD_Result queued = MHD_queue_response(connection.handle, answer.status, response);
  MHD_destroy_response(response);
  return queued;
}

}  // namespace

HttpAnswer sentence(unsigned status, std::string_view text) {
  return {.status = status, .body = std::make_shared<const std::string>(std::string(text) + '\n')};
}

/// Owns the libmicrohttpd daemon and contains its callbacks.
class HttpServer::Library {
 public:
  Library(const HttpSettings& settings, HttpHandler& handler, UniqueFd socket)
      : settings_(settings), handler_(handler), port_(port_of(socket)) {
    // If the daemon starts, the library uses the socket. Callbacks may come immediately, so all other members must be
    // initialised before.
    // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer)
    daemon_ = MHD_start_daemon(MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME, 0, nullptr, nullptr, on_request, this,
                               MHD_OPTION_LISTEN_SOCKET, socket.get(), MHD_OPTION_CONNECTION_LIMIT,
                               settings.connections, MHD_OPTION_CONNECTION_MEMORY_LIMIT, settings.memory_per_connection,
                               MHD_OPTION_CONNECTION_TIMEOUT, static_cast<unsigned>(settings.patience.count()),
                               MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_NOTIFY_CONNECTION, on_connection, this,
                               MHD_OPTION_NOTIFY_COMPLETED, on_completed, this, MHD_OPTION_END);
    if (daemon_) socket_ = std::move(socket);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  ~Library() {
    if (!daemon_) return;
    for (Connection& connection : connections_) resume(connection);
    const int listening = MHD_quiesce_daemon(daemon_);
    assert(listening == socket_.get());
    static_cast<void>(listening);
    MHD_stop_daemon(daemon_);
  }

  bool runs() const { return daemon_ != nullptr; }
  std::uint16_t port() const { return port_; }
  const HttpCounts& counts() const { return counts_; }
  std::size_t connections() const { return connections_.size(); }

  int descriptor() const {
    const MHD_DaemonInfo* const info = MHD_get_daemon_info(daemon_, MHD_DAEMON_INFO_EPOLL_FD);
    return info ? info->epoll_fd : -1;
  }

  std::optional<Clock::duration> due_in() const {
    std::optional<Clock::duration> due;
    MHD_UNSIGNED_LONG_LONG milliseconds = 0;
    if (MHD_get_timeout(daemon_, &milliseconds) == MHD_YES) due = std::chrono::milliseconds(milliseconds);
    if (!connections_.empty()) due = std::min<Clock::duration>(due.value_or(kLookEvery), kLookEvery);
    return due;
  }

  void turn() {
    for (Connection& connection : connections_)
      if (connection.is_suspended && connection.stream->has_something()) resume(connection);
    MHD_run(daemon_);
    give_up_idle(Clock::now());
  }

 private:
  static constexpr std::chrono::milliseconds kLookEvery{500};

  static void resume(Connection& connection) {
    if (!connection.is_suspended) return;
    connection.is_suspended = false;
    MHD_resume_connection(connection.handle);
  }

  /// The library calls this function when the headers are complete, for each part of the body, and at the end. An
  /// answer during the first call closes the connection, so only other methods than GET and HEAD are refused then.
  /// Bodies of GET and HEAD requests are ignored within the time limit.
  static MHD_Result on_request(void* self, MHD_Connection* handle, const char* path, const char* method, const char*,
                               const char*, std::size_t* body_bytes, void** request) {
    static int seen = 0;
    auto& library = *static_cast<Library*>(self);
    if (!std::exchange(*request, &seen)) return is_read_only(method) ? MHD_YES : library.refuse(handle);
    if (std::exchange(*body_bytes, 0) > 0) return MHD_YES;
    return library.serve(handle, path, method == std::string_view(MHD_HTTP_METHOD_HEAD));
  }

  static bool is_read_only(std::string_view method) {
    return method == MHD_HTTP_METHOD_GET || method == MHD_HTTP_METHOD_HEAD;
  }

  Connection& begin_answer(MHD_Connection* handle) {
    ++counts_.requests;
    Connection& connection = *of(handle);
    connection.is_answering = true;
    return connection;
  }

  MHD_Result refuse(MHD_Connection* handle) {
    HttpAnswer answer = sentence(405, "This server is read only: GET and HEAD alone.");
    answer.headers.emplace_back("Allow", "GET, HEAD");
    return queue(std::move(answer), begin_answer(handle));
  }

  MHD_Result serve(MHD_Connection* handle, std::string_view path, bool is_head) {
    return queue(handler_.answer(mhd::Request(handle, path, is_head)), begin_answer(handle));
  }

  static Connection* of(MHD_Connection* handle) {
    const auto* const info = MHD_get_connection_info(handle, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
    return static_cast<Connection*>(info->socket_context);
  }

  static void on_connection(void* self, MHD_Connection* handle, void** context, MHD_ConnectionNotificationCode what) {
    auto& library = *static_cast<Library*>(self);
    if (what == MHD_CONNECTION_NOTIFY_STARTED) {
      const int socket = MHD_get_connection_info(handle, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd;
      ::setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &kSendBuffer_bytes, sizeof kSendBuffer_bytes);
      library.connections_.push_back({.socket = socket, .handle = handle, .idle_since = Clock::now(), .stream = {}});
      *context = &library.connections_.back();
      ++library.counts_.connections;
    } else {
      library.connections_.remove_if([&](const Connection& each) { return &each == *context; });
    }
  }

  /// A request is complete or its connection failed: destroys its stream.
  static void on_completed(void*, MHD_Connection* handle, void**, MHD_RequestTerminationCode) {
    Connection& connection = *of(handle);
    connection.is_answering = false;
    connection.idle_since = Clock::now();
    connection.stream.reset();
  }

  /// Closes idle connections. The timeout of the library does not suffice, since it restarts with every byte.
  void give_up_idle(Clock::time_point now) {
    for (Connection& connection : connections_)
      if (!connection.is_answering && now - connection.idle_since > settings_.patience) give_up(connection);
    if (connections_.size() + kSpareConnections <= settings_.connections) return;
    const std::size_t too_many = connections_.size() + kSpareConnections - settings_.connections;
    std::size_t given_up = 0;
    for (Connection& connection : connections_) {
      if (given_up == too_many) break;
      if (connection.is_answering) continue;
      give_up(connection);  // the oldest connections come first
      ++given_up;
    }
  }

  void give_up(Connection& connection) {
    if (std::exchange(connection.is_shut, true)) return;
    ++counts_.given_up;
    ::shutdown(connection.socket, SHUT_RDWR);
  }

  HttpSettings settings_;
  HttpHandler& handler_;
  std::uint16_t port_;
  UniqueFd socket_;  // borrowed by the library
  std::list<Connection> connections_;
  MHD_Daemon* daemon_ = nullptr;
  HttpCounts counts_;
};

HttpServer::HttpServer(std::unique_ptr<Library> library) : library_(std::move(library)) {}
HttpServer::~HttpServer() = default;

tl::expected<std::unique_ptr<HttpServer>, std::string> HttpServer::open(const HttpSettings& settings,
                                                                        HttpHandler& handler) {
  auto socket = listening_socket(settings.address, settings.port);
  if (!socket) return tl::unexpected(std::move(socket).error());
  auto library = std::make_unique<Library>(settings, handler, std::move(*socket));
  if (!library->runs()) return tl::unexpected(std::string("the HTTP server cannot be started: too few descriptors?"));
  return std::unique_ptr<HttpServer>(new HttpServer(std::move(library)));
}

std::uint16_t HttpServer::port() const { return library_->port(); }
int HttpServer::descriptor() const { return library_->descriptor(); }
std::optional<HttpServer::Clock::duration> HttpServer::due_in() const { return library_->due_in(); }
void HttpServer::turn() { library_->turn(); }
const HttpCounts& HttpServer::counts() const { return library_->counts(); }
std::size_t HttpServer::connections() const { return library_->connections(); }

}  // namespace azimuth
