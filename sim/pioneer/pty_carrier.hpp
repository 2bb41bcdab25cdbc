#pragma once
#include <filesystem>

#include "base/unique_fd.hpp"
#include "sim/pioneer/carrier.hpp"

namespace azimuth::sim {

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

}  // namespace azimuth::sim
