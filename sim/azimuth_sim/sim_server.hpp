#pragma once
// The simulation in real time: one loop that waits, advances virtual time and transfers bytes.

#include <memory>
#include <optional>
#include <poll.h>
#include <string>
#include <vector>

#include "base/unique_fd.hpp"
#include "sim/azimuth_sim/camera_link.hpp"
#include "sim/azimuth_sim/can_base.hpp"
#include "sim/azimuth_sim/console.hpp"
#include "sim/azimuth_sim/line_input.hpp"
#include "sim/azimuth_sim/options.hpp"
#include "sim/azimuth_sim/paced_clock.hpp"
#include "sim/azimuth_sim/run_files.hpp"
#include "sim/pioneer/carriers.hpp"

namespace azimuth::sim {

/// The devices and files of a simulation. open_devices() detects all errors before the robot drives.
struct SimDevices {
  std::unique_ptr<Carrier> carrier;  ///< Carrier that is already plugged in
  RunFiles files;
  std::optional<CameraLink> camera;
  std::optional<CanSender> can;
};
FileResult<SimDevices> open_devices(const Options& options, std::unique_ptr<FrameSource> frames);

/// Thread contract: thread-bound. Stop signals must be blocked (block_stop_signals()).
class SimServer {
 public:
  SimServer(const Options& options, SimDevices devices);

  /// Runs until a signal, `quit`, or the end that the options define. Returns the errors at the end.
  [[nodiscard]] FileResult<void> run();

 private:
  using Monotonic = PacedClock::Monotonic;

  void wait();
  Monotonic::time_point wake_at() const;
  void turn();
  void follow_plug();
  void exchange_bytes();
  void hand_out();
  void read_signals();
  void tell_changes();
  void tell(const std::string& news) const;
  bool over() const;

  /// The state that was last printed.
  struct Told {
    bool client = false, session = false, plugged = true, arrived = false;
    int baud = 0;
    std::string trouble;
    friend bool operator==(const Told&, const Told&) = default;
  };

  const Options& options_;
  SimDevices devices_;
  Simulation simulation_;
  Console console_;
  LineInput lines_;
  PacedClock clock_;
  UniqueFd signals_;
  std::vector<pollfd> watched_;
  SimulationOutput output_;
  Bytes from_client_, to_client_;
  Stamp now_{};
  Monotonic::time_point last_sent_{};
  FileResult<void> plugged_;
  Told told_;
  Stamp next_status_{};
  bool stopped_ = false;
};

/// Blocks SIGTERM and SIGINT, which SimServer reads from a signalfd.
void block_stop_signals();

}  // namespace azimuth::sim
