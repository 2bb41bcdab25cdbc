#pragma once
// The real driver and the simulated controller at the two ends of a TCP connection, with real sockets in virtual time.

#include <string>
#include <vector>

#include "drivers/pioneer/driver.hpp"
#include "sim/pioneer/carriers.hpp"
#include "sim/pioneer/simulated_pioneer.hpp"

namespace azimuth::test {

class TcpBench {
 public:
  /// `chassis` must outlive this object.
  explicit TcpBench(sim::Chassis& chassis, const sim::PioneerModel& model = {});
  ~TcpBench();
  TcpBench(const TcpBench&) = delete;
  TcpBench& operator=(const TcpBench&) = delete;

  /// Runs both ends every 5 ms. A stopped server does nothing, while its kernel continues to buffer bytes.
  void run(Duration duration);
  /// Runs until the driver has a reading, at most for `at_most`; returns the elapsed time.
  Duration run_to_reading(Duration at_most);

  bool stopped = false;                   ///< stopped as by SIGSTOP
  bool lets_die = false;                  ///< accepts clients and never serves them
  bool holds_back = false;                ///< the bridge stores the bytes while the controller does not read
  bool ends_session_with_client = false;  ///< as the manufacturer's simulator does; a bridge does not
  bool moves_when_hung_up_on = false;     ///< as AMRISim does: it then listens at the next port
  bool client_is_dead = false;            ///< no bytes pass while this client is connected
  bool speaks_telnet = false;             ///< as a bridge that is not in raw mode
  bool refuses_others = false;            ///< listens only while it has no client
  std::vector<OdometryReading> readings;
  std::vector<std::string> events;

  Stamp now() const { return now_; }
  sim::SimulatedPioneer& pioneer() { return pioneer_; }
  const PioneerState& state() const { return driver_.state(); }
  std::uint64_t connections() const { return connections_; }  ///< accepted by the server
  std::uint64_t moves() const { return moves_; }              ///< number of changes of the port

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
