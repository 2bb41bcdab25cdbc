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

/// What an interface has against us.
struct CanTrouble {
  std::string interface;
  std::string what;      ///< what was tried, e.g. "bind"
  int error_number = 0;  ///< errno; 0: none, `what` says it all

  /// `interface: what: why`
  std::string text() const;
};

/// A frame and when it came.
struct CanReception {
  CanFrame frame;
  DeviceClock::time_point at{};
};

/// Frames from a bus, without blocking: a socket of the kernel (CanSocket), or a script.
///
/// Thread contract: thread-bound; allocates only to open and to report errors.
class CanLink {
 public:
  virtual ~CanLink() = default;

  virtual int descriptor() const = 0;  ///< to poll(2) for POLLIN; -1: none

  /// Frames into `into`, the oldest first. Less than `into` holds: there are no more at present.
  struct Received {
    std::size_t count = 0;
    bool is_down = false;             ///< the interface is there and off; frames will come when it is on again
    std::optional<CanTrouble> error;  ///< the link is of no more use
  };
  virtual Received receive(std::span<CanReception> into) = 0;

  /// Whether its interface still is the one that has that name.
  virtual bool is_present() const = 0;

  struct Counts {
    std::uint64_t malformed = 0;        ///< datagrams that were no frame
    std::uint64_t dropped = 0;          ///< frames for which the socket's buffer had no room
    std::uint64_t stamps_replaced = 0;  ///< of frames, by the time they were read
  };
  virtual Counts counts() const = 0;
  virtual std::string note() const = 0;  ///< what was not granted when it was opened; empty: nothing
};

using OpenedCanLink = tl::expected<std::unique_ptr<CanLink>, CanTrouble>;
/// Opens the interface of that name for frames of these ids, and for error frames.
using CanLinkOpener = std::function<OpenedCanLink(const std::string& interface, std::span<const CanId> ids)>;

}  // namespace azimuth
