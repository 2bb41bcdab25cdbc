#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "base/unique_fd.hpp"
#include "sim/pioneer/carrier.hpp"

namespace azimuth::sim {

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
