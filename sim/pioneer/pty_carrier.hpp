#pragma once
#include <filesystem>

#include "base/unique_fd.hpp"
#include "sim/pioneer/carrier.hpp"

namespace azimuth::sim {

/// A pseudo-terminal behind a link that keeps its name while the terminal behind it changes from plug to plug, as
/// /dev/serial/by-id does. To the client it is a serial port in every respect but the timing of its UART.
class PtyCarrier final : public Carrier {
 public:
  explicit PtyCarrier(std::filesystem::path link) : link_(std::move(link)) {}
  ~PtyCarrier() override { unplug(); }
  PtyCarrier(const PtyCarrier&) = delete;
  PtyCarrier& operator=(const PtyCarrier&) = delete;

  /// A link that is there already is replaced; anything else of that name is left alone and refused.
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
  std::string terminal_;  // path of the client's side
  UniqueFd master_;
  bool has_client_ = false;
};

}  // namespace azimuth::sim
