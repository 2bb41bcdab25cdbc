#pragma once
// A browser's end of HTTP, to the byte.

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/unique_fd.hpp"

namespace azimuth::test {

/// A connection to this machine.
class HttpClient {
 public:
  explicit HttpClient(std::uint16_t port, int receive_buffer_bytes = 0);

  bool send(std::string_view bytes) const;
  /// What has come within `limit`, or until `enough` is in it, or the other end closes.
  std::string read(std::chrono::milliseconds limit, std::string_view enough = {});
  bool closed() const { return closed_; }  ///< by the other end, as read() found out
  bool connected() const { return connected_; }

 private:
  UniqueFd socket_;
  bool connected_ = false, closed_ = false;
};

/// Status line, headers and body of what a whole request is answered, as the connection then closes.
std::string asked(std::uint16_t port, const std::string& request);

/// "GET PATH" as browsers send it; `headers` are lines ending in "\r\n".
std::string get(const std::string& path, const std::string& headers = {}, const std::string& host = "localhost");

/// Of an answer; 0: it is none.
int status_of(const std::string& answer);
std::string body_of(const std::string& answer);

}  // namespace azimuth::test
