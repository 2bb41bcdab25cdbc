#pragma once
// Shared by the tests of the simulated Pioneer: a chassis with constant speed, and a client written from the protocol
// description only.

#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "drivers/pioneer/packet.hpp"
#include "drivers/pioneer/protocol.hpp"
#include "sim/pioneer/simulated_pioneer.hpp"

namespace azimuth::sim {

using namespace std::chrono_literals;

class SteadyChassis final : public Chassis {
 public:
  SteadyChassis(double left, double right) : left_m_per_s(left), right_m_per_s(right) {}

  double left_m_per_s, right_m_per_s;
  double track_m = 2.0 / 5.6;
  std::optional<Twist> ordered;

  WheelMotion roll_to(Stamp until) override {
    const double passed_s = to_seconds(until - last_);
    last_ = until;
    const double speed = ordered ? ordered->speed_m_per_s : (left_m_per_s + right_m_per_s) / 2;
    const double turn = ordered ? ordered->turn_rate_rad_per_s : (right_m_per_s - left_m_per_s) / track_m;
    return {(speed - turn * track_m / 2) * passed_s, (speed + turn * track_m / 2) * passed_s, turn * passed_s};
  }
  void drive(const std::optional<Twist>& twist) override { ordered = twist; }
  void hurry(double speed_m_per_s) override { left_m_per_s = right_m_per_s = speed_m_per_s; }

 private:
  Stamp last_{};
};

struct Received {
  Bytes data;
  Stamp at{};  ///< arrival of the last byte
  std::uint8_t id() const { return data.front(); }
};

inline bool is_sip(const Received& packet) { return pioneer::packet_id::is_sip(packet.id()); }
inline int u16(const Bytes& data, std::size_t offset) { return data[offset] | (data[offset + 1] << 8); }
inline int i16(const Bytes& data, std::size_t offset) { return static_cast<std::int16_t>(u16(data, offset)); }
// Fields of a standard SIP, by their offset after the id.
inline int sip_x(const Received& sip) { return u16(sip.data, 1); }
inline int sip_y(const Received& sip) { return u16(sip.data, 3); }
inline int sip_heading(const Received& sip) { return i16(sip.data, 5); }

/// A client in virtual time that keeps every byte and every packet.
class PlainClient {
 public:
  explicit PlainClient(SimulatedPioneer& pioneer) : pioneer_(pioneer) {}

  Stamp now{};
  Bytes bytes;
  std::vector<Received> packets;

  void send(const pioneer::Frame& frame) { pioneer_.client_sends(frame.view(), now); }

  /// Listens for `duration` and returns the packets that arrived.
  std::vector<Received> listen(Duration duration) {
    const std::size_t before = packets.size();
    for (const Stamp end = now + duration; now < end;) {
      now = std::min(end, pioneer_.due());
      pioneer_.advance(now);
      take();
    }
    return {packets.begin() + static_cast<std::ptrdiff_t>(before), packets.end()};
  }

  std::vector<Received> ask(const pioneer::Frame& frame, Duration patience = 80ms) {
    send(frame);
    return listen(patience);
  }

  /// Opens a session: SYNC0, SYNC1, SYNC2, OPEN.
  void open() {
    for (const std::uint8_t sync : {pioneer::kSync0, pioneer::kSync1, pioneer::kSync2}) {
      const auto answer = ask(pioneer::encode_command(sync));
      ASSERT_EQ(answer.size(), 1U) << "SYNC" << int{sync};
      ASSERT_EQ(answer.front().id(), sync);
    }
    send(pioneer::encode_command(pioneer::Command::open));
    listen(8ms);
    ASSERT_TRUE(pioneer_.firmware().in_session());
  }
  /// Opens a session and switches sonar off.
  void open_quietly() {
    open();
    ask(pioneer::encode_command(pioneer::Command::sonar, 0), 20ms);
  }

  std::vector<Received> sips(Duration duration) {
    std::vector<Received> found = listen(duration);
    std::erase_if(found, [](const Received& packet) { return !is_sip(packet); });
    return found;
  }

  std::uint64_t bad_checksums() const { return scanner_.bad_checksums(); }

 private:
  void take() {
    const std::size_t before = bytes.size();
    pioneer_.take_bytes(bytes);
    pioneer::ByteView fresh = pioneer::ByteView(bytes).subspan(before);
    while (!fresh.empty()) {
      fresh = fresh.subspan(scanner_.add(fresh, {}));
      while (const auto packet = scanner_.next()) packets.push_back({{packet->data.begin(), packet->data.end()}, now});
    }
  }

  SimulatedPioneer& pioneer_;
  pioneer::PacketScanner scanner_;
};

/// A client and a controller whose robot rolls at constant speed.
struct FirmwareBench {
  explicit FirmwareBench(const PioneerModel& model = {}, double left = 0.0, double right = 0.0)
      : chassis(left, right), pioneer(model, chassis, 1), client(pioneer) {}
  SteadyChassis chassis;
  SimulatedPioneer pioneer;
  PlainClient client;
};

}  // namespace azimuth::sim
