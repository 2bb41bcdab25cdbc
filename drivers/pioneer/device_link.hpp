#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "base/unique_fd.hpp"
#include "drivers/pioneer/telnet.hpp"

namespace azimuth::pioneer {

/// A failure of a device or connection.
struct LinkError {
  std::string device;
  std::string what;      ///< the failed operation, e.g. "open"
  int error_number = 0;  ///< errno; 0: none, `what` is the whole cause

  /// `device: operation: cause`
  std::string text() const;
};

/// A byte stream to the robot that never blocks: a device of the kernel (DeviceLink), or a simulated line in virtual
/// time.
///
/// After a failed operation the peer is gone (unplugged or closed), and the link can no longer be used.
///
/// Thread contract: thread-bound; allocates only in order to open and to report errors.
class Link {
 public:
  virtual ~Link() = default;

  virtual int descriptor() const = 0;  ///< for poll(2); -1: none
  virtual bool connecting() const = 0;
  /// To be called when a connecting link has become writable, or from time to time.
  virtual std::optional<LinkError> finish_connecting() = 0;

  /// Reads the available bytes, at most the size of `into`.
  struct Read {
    std::size_t size = 0;
    std::optional<LinkError> error;
  };
  virtual Read read(std::span<std::uint8_t> into) = 0;

  /// Takes `bytes` and sends as many as the other side accepts. Later calls of flush() send the rest.
  virtual std::optional<LinkError> write(std::span<const std::uint8_t> bytes) = 0;
  virtual std::optional<LinkError> flush() = 0;
  /// True: wait until the descriptor is writable, then call flush().
  virtual bool has_unsent() const = 0;
  /// True: all bytes have left for the wire.
  virtual bool is_drained() const = 0;
  /// Tells the other side that no more bytes follow. Does nothing on a serial line.
  virtual void finish_sending() = 0;

  /// True: the connection leads through a bridge in telnet mode, whose changes are undone.
  virtual bool speaks_telnet() const { return false; }

  /// Sets one of the standard rates. Does nothing on a link without a baud rate.
  virtual std::optional<LinkError> set_baud(int baud) = 0;
  /// Discards received bytes that were not read. Does nothing on a link without a baud rate.
  virtual void discard_input() = 0;
};

using OpenedLink = tl::expected<std::unique_ptr<Link>, LinkError>;
/// Opens the named device without blocking.
using LinkOpener = std::function<OpenedLink(const std::string& device)>;

/// A serial line (raw, 8N1, exclusive, low latency if the adapter supports it), or a TCP connection to a
/// serial-to-Ethernet bridge or a simulator.
///
/// Thread contract: thread-bound; allocates only in order to open and to report errors.
class DeviceLink final : public Link {
 public:
  /// `device`: path of a tty, or "tcp:HOST:PORT" with an IPv4 address or "localhost" (other names would need a look-up,
  /// which can block). A TCP connection is not yet established on return.
  static OpenedLink open(const std::string& device);
  /// True: `device` is a serial line, which has a baud rate.
  static bool is_serial(const std::string& device);

  int descriptor() const override { return fd_.get(); }
  bool connecting() const override { return connecting_; }
  std::optional<LinkError> finish_connecting() override;
  Read read(std::span<std::uint8_t> into) override;
  std::optional<LinkError> write(std::span<const std::uint8_t> bytes) override;
  std::optional<LinkError> flush() override;
  bool has_unsent() const override { return unsent_size_ > 0; }
  bool is_drained() const override;
  void finish_sending() override;
  bool speaks_telnet() const override { return telnet_.is_spoken(); }
  std::optional<LinkError> set_baud(int baud) override;
  void discard_input() override;

 private:
  enum class Kind { serial, tcp_connecting, tcp };
  DeviceLink(std::string device, UniqueFd fd, Kind kind)
      : device_(std::move(device)),
        fd_(std::move(fd)),
        serial_(kind == Kind::serial),
        connecting_(kind == Kind::tcp_connecting) {}
  static OpenedLink make(const std::string& device, UniqueFd fd, Kind kind);
  static OpenedLink open_serial(const std::string& device);
  static OpenedLink open_tcp(const std::string& device);
  std::optional<LinkError> answer_telnet();
  bool add_unsent(std::uint8_t byte);
  LinkError error(const char* what, int error_number) const { return {device_, what, error_number}; }

  std::string device_;
  UniqueFd fd_;
  bool serial_;
  bool connecting_;
  Telnet telnet_;
  std::array<std::uint8_t, 1024> unsent_{};
  std::size_t unsent_size_ = 0;
};

}  // namespace azimuth::pioneer
