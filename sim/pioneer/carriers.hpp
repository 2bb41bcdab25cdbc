#pragma once
// Connects the simulated line to clients outside the process.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <poll.h>
#include <string>
#include <utility>
#include <vector>

#include "base/file_result.hpp"
#include "base/unique_fd.hpp"
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

/// A pseudo-terminal behind a symbolic link. The link keeps its name while each plug-in makes another terminal, as in
/// /dev/serial/by-id. For the client the terminal behaves like a serial port in everything but the timing of a UART.
class PtyCarrier final : public Carrier {
 public:
  explicit PtyCarrier(std::filesystem::path link) : link_(std::move(link)) {}
  ~PtyCarrier() override { unplug(); }
  PtyCarrier(const PtyCarrier&) = delete;
  PtyCarrier& operator=(const PtyCarrier&) = delete;

  /// An existing link is replaced; any other file of that name is kept, and plugging in fails.
  FileResult<void> plug_in() override;
  void unplug() override;
  void watch(std::vector<pollfd>& watched) const override;
  std::chrono::milliseconds patience() const override;
  void turn(Bytes& from_client) override;
  void send(pioneer::ByteView bytes) override;
  bool has_client() const override { return has_client_; }
  std::optional<int> client_baud() const override;
  std::string address() const override { return link_.string(); }

 private:
  FileResult<void> open_terminal();
  FileResult<void> make_link();
  void forget_unread();
  void look_for_client();

  std::filesystem::path link_;
  std::string terminal_;  // Path of the client's side
  UniqueFd master_;
  bool has_client_ = false;
};

/// The line behind a serial-to-Ethernet bridge, for one client at a time. Only programs on this machine can connect.
class TcpCarrier final : public Carrier {
 public:
  /// Port 0: the system selects one, which is kept from plug to plug.
  explicit TcpCarrier(std::uint16_t port) : port_(port) {}

  FileResult<void> plug_in() override;
  void unplug() override;
  void watch(std::vector<pollfd>& watched) const override;
  std::chrono::milliseconds patience() const override { return std::chrono::seconds(1); }
  void turn(Bytes& from_client) override;
  void send(pioneer::ByteView bytes) override;
  bool has_client() const override { return static_cast<bool>(client_); }
  std::optional<int> client_baud() const override { return std::nullopt; }
  std::string address() const override;
  /// Refuses new connections until plug_in(), like a server with the greatest number of clients.
  void stop_listening() { listener_ = UniqueFd(); }
  /// Ignores the connected client, like a bridge that hangs: the connection stays open, but nobody serves it.
  void forget_client() { forgotten_.push_back(std::move(client_)); }
  /// The port; valid once plugged in.
  std::uint16_t port() const { return port_; }

 private:
  void accept_client();
  void hear_client(Bytes& from_client);

  std::uint16_t port_;
  UniqueFd listener_, client_;
  std::vector<UniqueFd> forgotten_;
};

}  // namespace azimuth::sim
