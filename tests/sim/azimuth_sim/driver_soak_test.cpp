// The real driver with the simulated robot for half an hour of virtual time. Both ends run in one process, over a
// loopback connection.

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "drivers/pioneer/driver.hpp"
#include "sim/azimuth_sim/simulation.hpp"
#include "sim/pioneer/carriers.hpp"

namespace azimuth::sim {
namespace {

using namespace std::chrono_literals;

Fault fault(std::string_view text) { return parse_fault(text).value(); }

class DriverSoak {
 public:
  DriverSoak(const Scenario& scenario, std::vector<Fault> cycle, Duration period)
      : simulation({scenario, PioneerModel{}, FaultSchedule({}, std::move(cycle), period), std::nullopt}),
        reference_(scenario, PioneerModel{}.track_mm / 1000.0) {
    EXPECT_TRUE(carrier_.plug_in());
    PioneerSettings settings;
    settings.device = carrier_.address();
    settings.usb_latency_s = 0.0;
    settings.encoder = PioneerFeature::off;
    driver_.emplace(settings, Duration{});
  }

  void run(Duration duration) {
    constexpr Duration kStep = 5ms;
    for (const Stamp end = now_ + duration; now_ < end;) {
      now_ += kStep;
      let_robot_act();
      driver_->turn(pioneer::Clock::time_point(now_.time_since_epoch()));
      for (OdometryReading reading; driver_->take(reading);) check(reading);
    }
  }

  const PioneerState& state() const { return driver_->state(); }

  Simulation simulation;
  std::size_t readings = 0;
  double driven_m = 0.0;         // by the driver's odometry
  double largest_error_m = 0.0;  // of a step in a settled session where the driver reports no gap

 private:
  // The first SIPs of a session wait on the line behind a CONFIGpac, which is 124 bytes or 129 ms long at 9600 baud.
  // Over TCP the driver cannot detect this delay, so their stamps are late.
  static constexpr std::size_t kUnsettled = 5;

  void let_robot_act() {
    SimulatedPioneer& pioneer = simulation.pioneer();
    Bytes from_client, to_client;
    carrier_.turn(from_client);
    simulation.advance(now_, output_);
    output_.clear();
    if (!from_client.empty()) pioneer.client_sends(from_client, now_);
    pioneer.take_bytes(to_client);
    if (!to_client.empty()) carrier_.send(to_client);
    if (pioneer.plugged_in()) {
      EXPECT_TRUE(carrier_.plug_in());
    } else {
      carrier_.unplug();
    }
  }

  /// Compares the motion since the last reading with that of the wheels between the same stamps.
  void check(const OdometryReading& reading) {
    ++readings;
    const Pose2 T_wheels = reference_.pose_in_odom(std::max(reading.stamp, reference_now_));
    reference_now_ = std::max(reading.stamp, reference_now_);
    const bool gap = reading.sigma_gap_m > 0.0 || reading.origin != last_.origin;
    since_origin_ = reading.origin == last_.origin ? since_origin_ + 1 : 0;
    if (readings > 1 && reading.origin == last_.origin) {
      const double step_m = (reading.T_odom_body.position() - last_.T_odom_body.position()).norm();
      const double wheels_m = (T_wheels.position() - T_last_wheels_.position()).norm();
      driven_m += step_m;
      const double error_m = std::abs(step_m - wheels_m);
      if (!gap && since_origin_ > kUnsettled) largest_error_m = std::max(largest_error_m, error_m);
    }
    last_ = reading;
    T_last_wheels_ = T_wheels;
  }

  TcpCarrier carrier_{0};
  Rover reference_;
  std::optional<PioneerDriver> driver_;
  SimulationOutput output_;
  Stamp now_{}, reference_now_{};
  OdometryReading last_;
  std::size_t since_origin_ = 0;
  Pose2 T_last_wheels_;
};

TEST(DriverSoak, HalfAnHourWithoutFaults) {
  DriverSoak soak(lab(1, 40), {}, {});
  soak.run(30min);
  EXPECT_GT(soak.readings, 17'900U);
  EXPECT_EQ(soak.state().bad_checksums, 0U);
  EXPECT_EQ(soak.state().sessions, 1U);
  EXPECT_LT(soak.largest_error_m, 0.012) << "millimetres, and 5 ms of 0.5 m/s in the stamps";
  EXPECT_NEAR(soak.driven_m, 0.45 * 1800, 90);
}

TEST(DriverSoak, HalfAnHourWithEverythingInTurn) {
  DriverSoak soak(lab(2, 40),
                  {fault("noise=0.001"), fault("noise=0"), fault("lose_bytes=0.001"), fault("lose_bytes=0"),
                   fault("lose_sips=0.2"), fault("lose_sips=0"), fault("silence=0.7"), fault("reboot=0xFF"),
                   fault("unplug=1"), fault("reboot=0xFE"), fault("silence=3")},
                  13s);
  soak.run(30min);
  EXPECT_GT(soak.readings, 15'500U);
  EXPECT_EQ(soak.state().connection, Connection::running);
  EXPECT_GT(soak.state().sessions, 20U);
  EXPECT_GT(soak.state().resumed, 8U);
  EXPECT_LT(soak.largest_error_m, 0.012);
  EXPECT_GT(soak.state().bad_checksums, 0U);
}

}  // namespace
}  // namespace azimuth::sim
