#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>

namespace azimuth::pioneer {

/// What a device or connection has against us.
struct LinkError {
  std::string device;
  std::string what;      ///< what was tried, e.g. "open"
  int error_number = 0;  ///< errno; 0: none, `what` says it all

  /// `device: what: why`
  std::string text() const;
};

/// A byte stream to the robot, never blocking: a device of the kernel (DeviceLink), or a line in virtual time.
///
/// Once an operation failed the peer is gone (unplugged, hung up, closed): the link is of no more use.
///
/// Thread contract: thread-bound; allocates only to open and to report errors.
class Link {
 public:
  virtual ~Link() = default;

  virtual int descriptor() const = 0;  ///< to poll(2); -1: none
  virtual bool connecting() const = 0;
  /// To be called when a connecting link became writable, or from time to time.
  virtual std::optional<LinkError> finish_connecting() = 0;

  /// Reads what is there into `into`, at most its size.
  struct Read {
    std::size_t size = 0;
    std::optional<LinkError> error;
  };
  virtual Read read(std::span<std::uint8_t> into) = 0;

  /// Takes `bytes` in and sends as many as the other side takes, the rest with later calls of flush().
  virtual std::optional<LinkError> write(std::span<const std::uint8_t> bytes) = 0;
  virtual std::optional<LinkError> flush() = 0;
  virtual bool has_unsent() const = 0;  ///< wait for writability, then flush()
  /// Whether all bytes have left for the wire.
  virtual bool is_drained() const = 0;
  /// Tells the other side that no more comes; does nothing on a serial line.
  virtual void finish_sending() = 0;

  /// Whether a bridge in telnet mode is between, which is made up for.
  virtual bool speaks_telnet() const { return false; }

  /// One of the standard rates; does nothing where there is no baud rate.
  virtual std::optional<LinkError> set_baud(int baud) = 0;
  /// Forgets what was received and not read; does nothing where there is no baud rate.
  virtual void discard_input() = 0;
};

using OpenedLink = tl::expected<std::unique_ptr<Link>, LinkError>;
/// Opens the device of that name without blocking.
using LinkOpener = std::function<OpenedLink(const std::string& device)>;

}  // namespace azimuth::pioneer
