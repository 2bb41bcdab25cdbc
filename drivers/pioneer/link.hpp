#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "drivers/io/unique_fd.hpp"

namespace azimuth::pioneer {

/// What a device or connection has against us.
struct LinkError {
  std::string device;
  std::string what;      ///< what was tried, e.g. "open"
  int error_number = 0;  ///< errno; 0: none, `what` says it all

  /// `device: what: why`
  std::string text() const;
};

/// A byte stream to the robot, never blocking: a serial line (raw, 8N1, exclusive, low latency where the adapter can)
/// or a TCP connection to a serial-to-Ethernet bridge or a simulator.
///
/// Once an operation failed the peer is gone (unplugged, hung up, closed): the link is of no more use.
///
/// Thread contract: thread-bound; allocates only to open and to report errors.
class Link {
 public:
  using Opened = std::variant<Link, LinkError>;
  /// `device`: path of a tty, or "tcp:HOST:PORT" with an IPv4 address or "localhost" (a name would have to be looked
  /// up, which can block). A TCP connection is still being made on return.
  static Opened open(const std::string& device);
  /// Whether `device` names a serial line, which has a baud rate.
  static bool is_serial(const std::string& device);

  int descriptor() const { return fd_.get(); }
  bool connecting() const { return connecting_; }
  /// To be called when a connecting link became writable, or from time to time.
  std::optional<LinkError> finish_connecting();

  /// Reads what is there into `into`, at most its size.
  struct Read {
    std::size_t size = 0;
    std::optional<LinkError> error;
  };
  Read read(std::span<std::uint8_t> into);

  /// Takes `bytes` in and sends as many as the kernel takes, the rest with later calls of flush().
  std::optional<LinkError> write(std::span<const std::uint8_t> bytes);
  std::optional<LinkError> flush();
  bool has_unsent() const { return unsent_size_ > 0; }  ///< wait for writability, then flush()
  /// Whether all bytes have left the kernel as well.
  bool is_drained() const;
  /// Tells the other side that no more comes; does nothing on a serial line.
  void finish_sending();

  /// One of the standard rates; does nothing over TCP.
  std::optional<LinkError> set_baud(int baud);
  /// Forgets what the kernel received so far; does nothing over TCP.
  void discard_input();

 private:
  Link(std::string device, UniqueFd fd, bool serial, bool connecting)
      : device_(std::move(device)), fd_(std::move(fd)), serial_(serial), connecting_(connecting) {}
  static Opened open_serial(const std::string& device);
  static Opened open_tcp(const std::string& device);
  LinkError error(const char* what, int error_number) const { return {device_, what, error_number}; }

  std::string device_;
  UniqueFd fd_;
  bool serial_;
  bool connecting_;
  std::array<std::uint8_t, 1024> unsent_{};
  std::size_t unsent_size_ = 0;
};

}  // namespace azimuth::pioneer
