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

/// Resets USB ports on a thread of its own, so that no source waits for a reset.
///
/// Thread contract: constructed and destroyed by one thread; each client number belongs to one thread. The destructor
/// waits for a reset in progress. The end of the process would wait as well, because the kernel does not interrupt a
/// reset.
class PortResetter {
 public:
  static constexpr std::size_t kClients = 2;  ///< number of sources that can request resets
  using Reset = std::function<PortResetResult(const UsbPort& port, PortReset::Clock::time_point now)>;

  /// Tests pass another `reset`. Throws std::system_error when the system refuses a thread.
  PortResetter();
  explicit PortResetter(Reset reset);
  ~PortResetter();
  PortResetter(const PortResetter&) = delete;
  PortResetter& operator=(const PortResetter&) = delete;

  /// Requests a reset and returns at once. The new request replaces an earlier one that has not been processed
  /// yet.
  void request(std::size_t client, const UsbPort& port);
  /// Takes the result of the client's last request, once. False: there is no new one.
  bool take(std::size_t client, PortResetResult& into);

 private:
  struct Lane {
    explicit Lane(Doorbell& resetter, Doorbell& client) : wishes(resetter), results(client) {}
    Newest<std::optional<UsbPort>> wishes;
    Newest<PortResetResult> results;
  };
  void turn();

  Doorbell bell_, nobodys_bell_;  // clients poll often enough for results and need no bell
  Reset reset_;
  std::array<Lane, kClients> lanes_;
  std::atomic<bool> ends_{false};
  StageThread thread_;  // declared last, so that it ends before the members it uses are destroyed
};

}  // namespace azimuth
