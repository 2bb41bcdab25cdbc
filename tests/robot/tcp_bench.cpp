#include "tests/robot/tcp_bench.hpp"

#include <array>
#include <gtest/gtest.h>

#include "drivers/pioneer/protocol.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;
using Clock = PioneerDriver::Clock;

constexpr Duration kStep = 5ms;
constexpr Duration kTcpMonotonicAtStart = 1h;

Clock::time_point tcp_driver_time(Stamp now) {
  return Clock::time_point(now.time_since_epoch() + kTcpMonotonicAtStart);
}

PioneerSettings settings_for(sim::TcpCarrier& carrier) {
  EXPECT_TRUE(carrier.plug_in());
  PioneerSettings settings;
  settings.device = carrier.address();
  return settings;
}

}  // namespace

TcpBench::TcpBench(sim::Chassis& chassis, const sim::PioneerModel& model)
    : pioneer_(model, chassis, 1), driver_(settings_for(carrier_), -kTcpMonotonicAtStart) {}

TcpBench::~TcpBench() { driver_.close(Clock::time_point{}); }

void TcpBench::run(Duration duration) {
  for (const Stamp end = now_ + duration; now_ < end;) {
    now_ += kStep;
    if (!stopped) turn_server();
    turn_driver();
  }
}

Duration TcpBench::run_to_reading(Duration at_most) {
  const Stamp begin = now_;
  for (const std::size_t before = readings.size(); readings.size() == before && now_ < begin + at_most;) run(kStep);
  return now_ - begin;
}

void TcpBench::turn_server() {
  carrier_.turn(for_robot_);
  if (!had_client_ && carrier_.has_client()) {
    ++connections_;
    constexpr std::array<std::uint8_t, 12> kNegotiation{0xFF, 0xFB, 0x03, 0xFF, 0xFB, 0x01,
                                                        0xFF, 0xFE, 0x01, 0xFF, 0xFD, 0x00};
    if (speaks_telnet) carrier_.send(kNegotiation);
    if (refuses_others) carrier_.stop_listening();
  }
  if (had_client_ && !carrier_.has_client()) let_client_go();
  if (lets_die && carrier_.has_client()) carrier_.forget_client();
  had_client_ = carrier_.has_client();
  if (lets_die || client_is_dead) for_robot_.clear();
  if (!holds_back) turn_controller();
}

void TcpBench::let_client_go() {
  client_is_dead = false;
  if (ends_session_with_client) {
    const pioneer::Frame close = pioneer::encode_command(pioneer::Command::close);
    for_robot_.insert(for_robot_.end(), close.view().begin(), close.view().end());
  }
  if (moves_when_hung_up_on) {
    ++moves_;
    carrier_ = sim::TcpCarrier(static_cast<std::uint16_t>(carrier_.port() + 1));
  }
  EXPECT_TRUE(carrier_.plug_in());
}

void TcpBench::send_to_client() {
  sim::Bytes sent;
  for (const std::uint8_t byte : to_client_) sent.insert(sent.end(), speaks_telnet && byte == 0xFF ? 2 : 1, byte);
  carrier_.send(sent);
}

void TcpBench::turn_controller() {
  pioneer_.advance(now_);
  if (!for_robot_.empty()) pioneer_.client_sends(for_robot_, now_);
  for_robot_.clear();
  to_client_.clear();
  pioneer_.take_bytes(to_client_);
  if (!to_client_.empty() && !lets_die && !client_is_dead) send_to_client();
}

void TcpBench::turn_driver() {
  driver_.turn(tcp_driver_time(now_));
  for (OdometryReading reading; driver_.take(reading);) readings.push_back(reading);
  for (std::string event; driver_.take_event(event);) events.push_back(event);
}

}  // namespace azimuth::test
