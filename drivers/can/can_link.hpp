#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "drivers/can/can_frame.hpp"
#include "drivers/device/device_clock.hpp"

namespace azimuth {

/// A failure of a CAN interface.
struct CanTrouble {
  std::string interface;
  std::string what;      ///< the failed operation, e.g. "bind"
  int error_number = 0;  ///< errno; 0: none, `what` is the whole cause

  /// `interface: operation: cause`
  std::string text() const;
};

/// A frame and its time of arrival.
struct CanReception {
  CanFrame frame;
  DeviceClock::time_point at{};
};

/// Frames from a bus, without blocking: a socket of the kernel (CanSocket), or a script in tests.
///
/// Thread contract: thread-bound; allocates only in order to open and to report errors.
class CanLink {
 public:
  virtual ~CanLink() = default;

  virtual int descriptor() const = 0;  ///< for poll(2) with POLLIN; -1: none

  /// Writes frames to `into`, the oldest first. Fewer than `into` holds: there are no more at present.
  struct Received {
    std::size_t count = 0;
    bool is_down = false;             ///< the interface exists but is down; frames will come when it is up again
    std::optional<CanTrouble> error;  ///< the link can no longer be used
  };
  virtual Received receive(std::span<CanReception> into) = 0;

  /// True: the interface name still belongs to the interface of this link.
  virtual bool is_present() const = 0;

  struct Counts {
    std::uint64_t malformed = 0;        ///< datagrams that are not frames
    std::uint64_t dropped = 0;          ///< frames lost because the socket's buffer was full
    std::uint64_t stamps_replaced = 0;  ///< stamps replaced by the time of reading
  };
  virtual Counts counts() const = 0;
  virtual std::string note() const = 0;  ///< what was not granted at the opening; empty: nothing
};

using OpenedCanLink = tl::expected<std::unique_ptr<CanLink>, CanTrouble>;
/// Opens an interface for the frames with these identifiers and for error frames.
using CanLinkOpener = std::function<OpenedCanLink(const std::string& interface, std::span<const CanId> ids)>;

}  // namespace azimuth
