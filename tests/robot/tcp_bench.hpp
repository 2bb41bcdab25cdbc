#pragma once
// The real driver and the simulated controller at the two ends of a TCP connection: real sockets, virtual time.

#include <string>
#include <vector>

#include "drivers/pioneer/driver.hpp"
#include "sim/pioneer/simulated_pioneer.hpp"
#include "sim/pioneer/tcp_carrier.hpp"

namespace azimuth::test {

class TcpBench {
 public:
  /// `chassis` outlives this.
  explicit TcpBench(sim::Chassis& chassis, const sim::PioneerModel& model = {});
  ~TcpBench();
  TcpBench(const TcpBench&) = delete;
  TcpBench& operator=(const TcpBench&) = delete;

  /// Both ends get their turn every 5 ms; a stopped server does nothing, and its kernel goes on collecting bytes.
  void run(Duration duration);
  /// Until the driver has a reading, at most so long; how long it took.
  Duration run_to_reading(Duration at_most);

  bool stopped = false;                   ///< as by SIGSTOP
  bool lets_die = false;                  ///< takes clients in and never serves them, not even later
  bool holds_back = false;                ///< a bridge keeps what comes for a controller that reads nothing at present
  bool ends_session_with_client = false;  ///< as the makers' simulator does; a bridge does not
  bool moves_when_hung_up_on = false;     ///< as AMRISim does: then it listens at the next port
  bool client_is_dead = false;            ///< nothing passes between it and the robot, as long as it stays
  bool speaks_telnet = false;             ///< a bridge does that nobody has set to raw mode
  bool refuses_others = false;            ///< it listens only while it has no client
  std::vector<OdometryReading> readings;
  std::vector<std::string> events;

  Stamp now() const { return now_; }
  sim::SimulatedPioneer& pioneer() { return pioneer_; }
  const PioneerState& state() const { return driver_.state(); }
  std::uint64_t connections() const { return connections_; }  ///< that the server took in
  std::uint64_t moves() const { return moves_; }              ///< to another port

 private:
  void turn_server();
  void let_client_go();
  void send_to_client();
  void turn_controller();
  void turn_driver();

  sim::SimulatedPioneer pioneer_;
  sim::TcpCarrier carrier_{0};
  PioneerDriver driver_;
  sim::Bytes for_robot_, to_client_;
  bool had_client_ = false;
  std::uint64_t connections_ = 0, moves_ = 0;
  Stamp now_{};
};

}  // namespace azimuth::test
