#include "sim/pioneer/simulated_pioneer.hpp"

#include <algorithm>
#include <utility>

namespace azimuth::sim {
namespace {

constexpr std::int64_t kBitsPerByte = 10;

/// Size of the controller's send buffer; a packet that does not fit is not sent.
constexpr std::size_t kTransmitBuffer = 256;

// The wires and the lost SIPs have random streams of their own.
constexpr std::uint64_t kToClientSeed = 0x10000, kSipSeed = 0x20000;

}  // namespace

void Wire::send(pioneer::ByteView bytes, int baud, Stamp now) {
  free_at_ = std::max<Time>(free_at_, now.time_since_epoch());
  for (const std::uint8_t byte : bytes) {
    free_at_ += Time(kBitsPerByte * 1'000'000'000 / baud);
    bytes_.push_back({byte, baud, free_at_});
  }
}

Stamp Wire::due() const {
  if (bytes_.empty()) return Stamp::max();
  return Stamp(std::chrono::ceil<Duration>(bytes_.front().whole_at));
}

void Wire::receive(Stamp now, std::optional<int> baud, Bytes& received) {
  while (due() <= now) {
    arrive(bytes_.front(), baud, received);
    bytes_.pop_front();
  }
}

void Wire::arrive(const InFlight& byte, std::optional<int> baud, Bytes& received) {
  if (noise.lose > 0.0 && random_.chance(noise.lose)) return;
  if (baud && *baud != byte.baud) return garble(byte, *baud, received);
  const bool flipped = noise.flip > 0.0 && random_.chance(noise.flip);
  const auto bit = static_cast<std::uint8_t>(flipped ? 1U << random_.index(8) : 0U);
  received.push_back(byte.byte ^ bit);
}

/// A faster receiver reads the bits of one byte as several bytes, a slower one those of several bytes as one.
void Wire::garble(const InFlight& byte, int baud, Bytes& received) {
  for (garbage_due_ += static_cast<double>(baud) / byte.baud; garbage_due_ >= 1.0; garbage_due_ -= 1.0) {
    received.push_back(static_cast<std::uint8_t>(random_.index(256)));
  }
}

SimulatedPioneer::SimulatedPioneer(const PioneerModel& model, Chassis& chassis, std::uint64_t seed)
    : chassis_(chassis),
      firmware_(model, seed),
      to_robot_(seed),
      to_client_(seed + kToClientSeed),
      random_(seed + kSipSeed, RandomPurpose::line) {}

void SimulatedPioneer::client_sends(pioneer::ByteView bytes, Stamp now) {
  advance(now);
  counts_.bytes_from_client += bytes.size();
  to_robot_.send(bytes, client_baud_.value_or(firmware_.baud()), now);
}

void SimulatedPioneer::take_bytes(Bytes& bytes) {
  bytes.insert(bytes.end(), spoken_.begin(), spoken_.end());
  counts_.bytes_to_client += spoken_.size();
  spoken_.clear();
}

Stamp SimulatedPioneer::due() const {
  const Stamp replug = plugged_in() ? Stamp::max() : unplugged_until_;
  return std::min({firmware_.due(), to_robot_.due(), to_client_.due(), replug});
}

void SimulatedPioneer::advance(Stamp now) {
  while (due() < now) step(std::max(due(), now_));
  step(std::max(now, now_));
}

void SimulatedPioneer::step(Stamp now) {
  now_ = now;
  hear();
  // The wheels are read only at the controller's own instants, so the result does not depend on how often advance() is
  // called.
  if (!heard_.empty() || firmware_.due() <= now_) run_firmware();
  speak();
}

void SimulatedPioneer::hear() {
  heard_.clear();
  // A bridge without a rate of its own follows the robot's rate.
  to_robot_.receive(now_, client_baud_ ? std::optional(firmware_.baud()) : std::nullopt, heard_);
  if (!passes()) heard_.clear();
}

void SimulatedPioneer::run_firmware() {
  firmware_.roll(chassis_.roll_to(now_));
  firmware_.receive(heard_, now_);
  firmware_.advance(now_);
  chassis_.drive(firmware_.holds_all() ? Twist{} : firmware_.driven());
}

void SimulatedPioneer::speak() {
  for (const Outgoing& packet : firmware_.take_output()) put_on_line(packet);
  const std::size_t before = spoken_.size();
  to_client_.receive(now_, client_baud_, spoken_);
  if (!passes()) spoken_.resize(before);
}

void SimulatedPioneer::put_on_line(const Outgoing& packet) {
  if (packet.latch && lose_sips_ > 0.0 && random_.chance(lose_sips_)) {
    ++counts_.lost_sips;
    return;
  }
  if (to_client_.backlog() + packet.frame.size > kTransmitBuffer) {
    ++counts_.crowded_out;
    return;
  }
  to_client_.send(packet.frame.view(), packet.baud, now_);
  if (!packet.latch) return;
  ++counts_.sips;
  latches_.push_back(*packet.latch);
}

void SimulatedPioneer::set_noise(double flip_probability) {
  to_robot_.noise.flip = to_client_.noise.flip = flip_probability;
}

void SimulatedPioneer::set_lost_bytes(double probability) {
  to_robot_.noise.lose = to_client_.noise.lose = probability;
}

void SimulatedPioneer::reboot(std::uint8_t packet_id) {
  firmware_.reboot(packet_id, now_);
  chassis_.drive(std::nullopt);
  ++counts_.reboots;
  speak();
}

void SimulatedPioneer::silence(Duration duration) { silent_until_ = std::max(silent_until_, now_ + duration); }
void SimulatedPioneer::unplug(Duration duration) { unplugged_until_ = std::max(unplugged_until_, now_ + duration); }

void SimulatedPioneer::leave_session_open(std::optional<int> baud) {
  if (baud) firmware_.set_baud(*baud);
  firmware_.open(now_);
}

std::vector<SipLatch> SimulatedPioneer::take_latches() { return std::exchange(latches_, {}); }

}  // namespace azimuth::sim
