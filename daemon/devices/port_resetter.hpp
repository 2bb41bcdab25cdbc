#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>

#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/stage_thread.hpp"
#include "daemon/pipeline/wires.hpp"
#include "drivers/usb/port_reset.hpp"

namespace azimuth {

/// Resets USB ports on a thread of its own, so that no source ever waits for one.
///
/// Thread contract: made and destroyed by one thread; each client belongs to one thread. Destruction waits for a reset
/// that is under way: so would the end of the process, since the kernel does not let go of it.
class PortResetter {
 public:
  static constexpr std::size_t kClients = 2;  ///< sources that can wish for resets
  using Reset = std::function<PortResetResult(const UsbPort& port, PortReset::Clock::time_point now)>;

  /// `reset` is another one in tests only. Throws std::system_error when the system refuses a thread.
  PortResetter();
  explicit PortResetter(Reset reset);
  ~PortResetter();
  PortResetter(const PortResetter&) = delete;
  PortResetter& operator=(const PortResetter&) = delete;

  /// Returns at once. A wish that has not been looked at yet is replaced.
  void request(std::size_t client, const UsbPort& port);
  /// What became of the client's last wish, once. False: nothing new.
  bool take(std::size_t client, PortResetResult& into);

 private:
  struct Lane {
    explicit Lane(Doorbell& resetter, Doorbell& client) : wishes(resetter), results(client) {}
    Newest<std::optional<UsbPort>> wishes;
    Newest<PortResetResult> results;
  };
  void turn();

  Doorbell bell_, nobodys_bell_;  // sources turn often enough to look
  Reset reset_;
  std::array<Lane, kClients> lanes_;
  std::atomic<bool> ends_{false};
  StageThread thread_;  // last, so that it ends before what it touches
};

}  // namespace azimuth
