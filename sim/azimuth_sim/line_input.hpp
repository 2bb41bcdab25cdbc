#pragma once
// Commands from people and scripts: lines from standard input and from clients of a socket.

#include <filesystem>
#include <functional>
#include <optional>
#include <poll.h>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "base/unique_fd.hpp"

namespace azimuth::sim {

/// Cuts what is read from a descriptor into lines.
class LineReader {
 public:
  /// Takes what is there, at most one read(). False: no more will come, or the line is absurdly long.
  bool read(int fd);
  /// The next whole line, without its end.
  std::optional<std::string> next();

 private:
  std::string text_;
};

/// Answers each line with whatever the handler returns.
///
/// Thread contract: thread-bound.
class LineInput {
 public:
  using Handler = std::function<std::string(const std::string& line)>;

  explicit LineInput(Handler handler) : handler_(std::move(handler)) {}
  ~LineInput();
  LineInput(const LineInput&) = delete;
  LineInput& operator=(const LineInput&) = delete;

  /// Standard input; answers go to standard output.
  void open_standard_input();
  /// A socket others connect to; a stale one is replaced.
  [[nodiscard]] FileResult<void> open_socket(const std::filesystem::path& path);

  void watch(std::vector<pollfd>& watched) const;
  /// `watched` as poll() left it.
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
