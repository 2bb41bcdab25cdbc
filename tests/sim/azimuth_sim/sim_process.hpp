#pragma once
// azimuth-sim as a process, and a blocking client on a real descriptor, like other people's programs.

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

#include "base/unique_fd.hpp"
#include "drivers/pioneer/packet.hpp"
#include "drivers/pioneer/protocol.hpp"

namespace azimuth::sim {

class SimProcess {
 public:
  explicit SimProcess(std::vector<std::string> arguments);
  SimProcess(const SimProcess&) = delete;
  SimProcess& operator=(const SimProcess&) = delete;
  ~SimProcess();

  /// Writes a line to the standard input of the process.
  void say(const std::string& line) const;
  /// Returns the output up to `text`, or nothing after a timeout of several seconds.
  std::optional<std::string> output_until(const std::string& text);
  /// Sends `signal` to the process and returns its exit code, or -1 if it does not exit by itself.
  int end(int signal);

 private:
  pid_t pid_ = -1;
  UniqueFd input_, output_;
  std::string heard_;
};

UniqueFd open_serial(const std::string& path, int baud);
void set_baud(int fd, int baud);
UniqueFd connect_tcp(int port);

using PacketBytes = std::vector<std::uint8_t>;

class WireClient {
 public:
  explicit WireClient(UniqueFd fd) : fd_(std::move(fd)) {}

  int fd() const { return fd_.get(); }
  bool send(const pioneer::Frame& frame) const;
  /// Listens for `duration`, or until the line hangs up.
  std::vector<PacketBytes> listen(std::chrono::milliseconds duration);
  /// The next packet with this id; no value after a timeout of several seconds.
  std::optional<PacketBytes> await(std::uint8_t id);
  std::optional<PacketBytes> await_sip();
  /// The next packet of any kind; no value after `patience`.
  std::optional<PacketBytes> next(std::chrono::milliseconds patience);
  /// Opens a session (SYNC0 to OPEN) and switches sonar off; false: an answer is missing.
  bool open_session();
  bool hung_up() const { return hung_up_; }
  std::size_t bytes() const { return bytes_; }

 private:
  void read_for(std::chrono::milliseconds patience);
  std::optional<PacketBytes> await_any(std::uint8_t first_id, std::uint8_t last_id);

  UniqueFd fd_;
  pioneer::PacketScanner scanner_;
  std::vector<PacketBytes> packets_;
  std::size_t bytes_ = 0;
  bool hung_up_ = false;
};

}  // namespace azimuth::sim
