#pragma once
// What brings the simulated line to clients outside the process.

#include <chrono>
#include <optional>
#include <poll.h>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "sim/pioneer/packets.hpp"

namespace azimuth::sim {

/// Never blocks. A client may come, go and die at any moment.
///
/// Thread contract: thread-bound.
class Carrier {
 public:
  virtual ~Carrier() = default;

  /// Makes the device appear; what stood in the way. Harmless when it is there.
  [[nodiscard]] virtual FileResult<void> plug_in() = 0;
  /// Makes it disappear under whoever uses it.
  virtual void unplug() = 0;

  /// Appends what to wait for.
  virtual void watch(std::vector<pollfd>& watched) const = 0;
  /// How long the next turn() may wait at most.
  virtual std::chrono::milliseconds patience() const = 0;
  /// Lets clients in and out, and appends the bytes they sent.
  virtual void turn(Bytes& from_client) = 0;
  /// Hands bytes on. Those that nobody takes are gone, as on a wire.
  virtual void send(pioneer::ByteView bytes) = 0;

  virtual bool has_client() const = 0;
  /// The baud rate the client has set; nothing when there is no such thing.
  virtual std::optional<int> client_baud() const = 0;
  /// Where clients connect to: what --device or daemon settings would say.
  virtual std::string address() const = 0;
};

}  // namespace azimuth::sim
