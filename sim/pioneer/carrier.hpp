#pragma once
// Connects the simulated line to clients outside the process.

#include <chrono>
#include <optional>
#include <poll.h>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "sim/pioneer/packets.hpp"

namespace azimuth::sim {

/// Never blocks. Clients may connect, leave and die at any time.
///
/// Thread contract: thread-bound.
class Carrier {
 public:
  virtual ~Carrier() = default;

  /// Makes the device appear; returns the errors. No effect if it is plugged in already.
  [[nodiscard]] virtual FileResult<void> plug_in() = 0;
  /// Makes the device disappear, even for a connected client.
  virtual void unplug() = 0;

  /// Appends the descriptors to wait for.
  virtual void watch(std::vector<pollfd>& watched) const = 0;
  /// Greatest time until the next turn().
  virtual std::chrono::milliseconds patience() const = 0;
  /// Accepts and drops clients, and appends the bytes that they sent.
  virtual void turn(Bytes& from_client) = 0;
  /// Sends bytes to the client. Bytes that nobody receives are lost, as on a wire.
  virtual void send(pioneer::ByteView bytes) = 0;

  virtual bool has_client() const = 0;
  /// The baud rate that the client has set; nullopt if the carrier has no baud rate.
  virtual std::optional<int> client_baud() const = 0;
  /// The address for clients: the value of --device or of the daemon's settings.
  virtual std::string address() const = 0;
};

}  // namespace azimuth::sim
