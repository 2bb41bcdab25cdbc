#pragma once
// Command lines from standard input and from clients of a socket.

#include <filesystem>
#include <functional>
#include <optional>
#include <poll.h>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "base/unique_fd.hpp"

namespace azimuth::sim {

/// Splits the data read from a descriptor into lines.
class LineReader {
 public:
  /// Reads what is available, with one read() at most. Returns false at the end of input or if a line is too long.
  bool read(int fd);
  /// Returns the next complete line, without its line end.
  std::optional<std::string> next();

 private:
  std::string text_;
};

/// Answers each line with the text that the handler returns.
///
/// Thread contract: thread-bound.
class LineInput {
 public:
  using Handler = std::function<std::string(const std::string& line)>;

  explicit LineInput(Handler handler) : handler_(std::move(handler)) {}
  ~LineInput();
  LineInput(const LineInput&) = delete;
  LineInput& operator=(const LineInput&) = delete;

  /// Reads standard input; answers go to standard output.
  void open_standard_input();
  /// Opens a socket for clients; a stale socket file is replaced.
  [[nodiscard]] FileResult<void> open_socket(const std::filesystem::path& path);

  void watch(std::vector<pollfd>& watched) const;
  /// `watched` must be as poll() left it.
  void turn(const std::vector<pollfd>& watched);

 private:
  struct Client {
    UniqueFd fd;
    LineReader reader;
  };
  void accept_client();
  bool serve(Client& client);

  Handler handler_;
  bool standard_input_open_ = false;
  LineReader standard_input_;
  std::filesystem::path path_;
  UniqueFd listener_;
  std::vector<Client> clients_;
};

}  // namespace azimuth::sim
