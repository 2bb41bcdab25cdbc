#pragma once
// An HTTP client that gives control over every byte.

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/unique_fd.hpp"

namespace azimuth::test {

/// A TCP connection to a port of this machine.
class HttpClient {
 public:
  explicit HttpClient(std::uint16_t port, int receive_buffer_bytes = 0);

  bool send(std::string_view bytes) const;
  /// Reads until `limit` has passed, the text contains `enough`, or the server closes the connection.
  std::string read(std::chrono::milliseconds limit, std::string_view enough = {});
  bool closed() const { return closed_; }  ///< read() has found that the server closed it.
  bool connected() const { return connected_; }

 private:
  UniqueFd socket_;
  bool connected_ = false, closed_ = false;
};

/// Sends a whole request and returns status line, headers and body of the answer. The server then closes the
/// connection.
std::string asked(std::uint16_t port, const std::string& request);

/// The text of a GET request as browsers send it; `headers` are lines that end in "\r\n".
std::string get(const std::string& path, const std::string& headers = {}, const std::string& host = "localhost");

/// The HTTP status of an answer; 0 if the text is no answer.
int status_of(const std::string& answer);
std::string body_of(const std::string& answer);

}  // namespace azimuth::test
