#pragma once
#include <array>
#include <string>
#include <utility>

#include "base/unique_fd.hpp"
#include "drivers/pioneer/link.hpp"
#include "drivers/pioneer/telnet.hpp"

namespace azimuth::pioneer {

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
