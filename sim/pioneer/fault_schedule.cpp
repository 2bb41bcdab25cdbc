#include "sim/pioneer/fault_schedule.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <utility>

#include "drivers/pioneer/protocol.hpp"
#include "settings/suggestion.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth::sim {

/// One row of the table. Values are numbers from `low` to `high`, or words that represent 0, 1, 2, ...
struct FaultKind {
  std::string_view name;
  std::span<const std::string_view> words;
  double low, high, usual;  ///< `usual` applies if no value is given
  std::string_view help;
  void (*apply)(SimulatedPioneer& pioneer, double value);
};

namespace {

constexpr std::array<std::string_view, 2> kOffOn{"off", "on"};
constexpr std::array<std::string_view, 2> kObeyRefuse{"obeyed", "refused"};
constexpr std::array<std::string_view, 2> kRebootIds{"0xFF", "0xFE"};
constexpr std::array<std::string_view, 3> kSipIds{"moving", "0x32", "0x33"};
constexpr std::array<std::string_view, 3> kStreams{"off", "on_request", "always"};
constexpr std::array<std::string_view, 4> kWheels{"none", "left", "right", "both"};
constexpr std::array<std::string_view, 4> kBumpers{"none", "rear", "front", "both"};
constexpr std::span<const std::string_view> kNumber;

constexpr double kLongest_s = 1e9;  // of a schedule

Duration seconds(double value) { return duration_from_seconds(value); }

void set_wrap(SimulatedPioneer& pioneer, int bits, double start_units) {
  pioneer.firmware().quirks.position_bits = bits;
  pioneer.firmware().quirks.start_units = start_units;
}

void set_watchdog(SimulatedPioneer& pioneer, double milliseconds) {
  FirmwareQuirks& quirks = pioneer.firmware().quirks;
  quirks.watchdog_holds_all = milliseconds > 0.0;
  quirks.watchdog_ms.reset();
  if (milliseconds > 0.0) quirks.watchdog_ms = static_cast<int>(milliseconds);
}

void reboot(SimulatedPioneer& pioneer, double with_data) {
  pioneer.reboot(with_data > 0.0 ? pioneer::packet_id::reboot_with_data : pioneer::packet_id::reboot);
}

void leave_session(SimulatedPioneer& pioneer, double baud) {
  pioneer.leave_session_open(baud > 0.0 ? std::optional(static_cast<int>(baud)) : std::nullopt);
}

void set_stall(SimulatedPioneer& pioneer, double wheels) {
  FirmwareQuirks& quirks = pioneer.firmware().quirks;
  const auto bits = static_cast<unsigned>(wheels);
  quirks.left_stall_bumpers = static_cast<std::uint8_t>((quirks.left_stall_bumpers & 0xFEU) | (bits & 1U));
  quirks.right_stall_bumpers = static_cast<std::uint8_t>((quirks.right_stall_bumpers & 0xFEU) | (bits >> 1U));
}

void set_bumpers(SimulatedPioneer& pioneer, double sides) {
  FirmwareQuirks& quirks = pioneer.firmware().quirks;
  const auto bits = static_cast<unsigned>(sides);
  const auto hit = [](unsigned bit) { return bit != 0 ? 0b0000'1000U : 0U; };  // The middle one of five bumpers
  quirks.left_stall_bumpers = static_cast<std::uint8_t>((quirks.left_stall_bumpers & 1U) | hit(bits & 1U));
  quirks.right_stall_bumpers = static_cast<std::uint8_t>((quirks.right_stall_bumpers & 1U) | hit(bits & 2U));
}

const std::array kFaults{
    FaultKind{"bad_config_checksum", kOffOn, 0, 0, 1, "CONFIGpac with a wrong checksum, as real P3DX-SH firmware",
              [](auto& pioneer, double on) { pioneer.firmware().quirks.bad_config_checksum = on > 0.0; }},
    FaultKind{"noise", kNumber, 0, 1, 0.001, "probability that a byte arrives with a wrong bit",
              [](auto& pioneer, double rate) { pioneer.set_noise(rate); }},
    FaultKind{"lose_bytes", kNumber, 0, 1, 0.001, "probability that a byte does not arrive",
              [](auto& pioneer, double rate) { pioneer.set_lost_bytes(rate); }},
    FaultKind{"lose_sips", kNumber, 0, 1, 0.1, "probability that a whole SIP is missing",
              [](auto& pioneer, double rate) { pioneer.set_lost_sips(rate); }},
    FaultKind{"wrap15", kNumber, 0, 32767, 32700, "positions of 15 bits, x and y starting at this after OPEN",
              [](auto& pioneer, double units) { set_wrap(pioneer, 15, units); }},
    FaultKind{"wrap16", kNumber, 0, 65535, 65400, "positions of 16 bits, x and y starting at this after OPEN",
              [](auto& pioneer, double units) { set_wrap(pioneer, 16, units); }},
    FaultKind{"heading", kNumber, -180, 180, 175, "heading after OPEN in degrees, so that it wraps soon",
              [](auto& pioneer, double deg) { pioneer.firmware().quirks.start_heading_rad = degrees_to_rad(deg); }},
    FaultKind{"reboot", kRebootIds, 0, 0, 0, "the controller restarts: session and odometry are gone", reboot},
    FaultKind{"watchdog", kNumber, 0, 60000, 2000,
              "ms without a command until all wheels stop, the session staying open; 0: only a client's own orders",
              set_watchdog},
    FaultKind{"hostbaud", kObeyRefuse, 0, 0, 1, "whether HOSTBAUD has an effect",
              [](auto& pioneer, double refused) { pioneer.firmware().quirks.refuses_host_baud = refused > 0.0; }},
    FaultKind{"sonar", kOffOn, 0, 0, 1, "every sonar in every SIP, whatever SONAR says: 89 bytes, a full line at 9600",
              [](auto& pioneer, double on) { pioneer.firmware().quirks.resends_sonar = on > 0.0; }},
    FaultKind{"old_session", kNumber, 0, 115200, 0,
              "a session is open that nobody closed, at this baud rate (0: as is)", leave_session},
    FaultKind{"unplug", kNumber, 0, 86400, 2, "seconds the cable is out: the device is gone",
              [](auto& pioneer, double duration_s) { pioneer.unplug(seconds(duration_s)); }},
    FaultKind{"silence", kNumber, 0, 86400, 2, "seconds nothing passes, the device staying",
              [](auto& pioneer, double duration_s) { pioneer.silence(seconds(duration_s)); }},
    FaultKind{"sip_id", kSipIds, 0, 0, 1, "id of SIPs: 0x33 only when moving, or always the same",
              [](auto& pioneer, double id) { pioneer.firmware().quirks.sip_id = static_cast<SipId>(id); }},
    FaultKind{"gyro", kStreams, 0, 0, 2, "GYROpacs",
              [](auto& pioneer, double stream) { pioneer.firmware().quirks.gyro = static_cast<Stream>(stream); }},
    FaultKind{"encoder", kStreams, 0, 0, 2, "ENCODERpacs",
              [](auto& pioneer, double stream) { pioneer.firmware().quirks.encoder = static_cast<Stream>(stream); }},
    FaultKind{"jump", kNumber, 0, 5, 1.5, "m/s: drives so fast that a SIP covers more than 100 mm; 0: as usual",
              [](auto& pioneer, double speed) { pioneer.chassis().hurry(speed); }},
    FaultKind{"stall", kWheels, 0, 0, 3, "stalled wheels", set_stall},
    FaultKind{"estop", kOffOn, 0, 0, 1, "the emergency stop is pressed, for those who are told",
              [](auto& pioneer, double on) { pioneer.firmware().quirks.emergency_stop = on > 0.0; }},
    FaultKind{"bumpers", kBumpers, 0, 0, 2, "bumpers that touch something", set_bumpers},
};

std::string values(const FaultKind& kind) {
  if (!kind.words.empty()) return fmt::format("{}", fmt::join(kind.words, "|"));
  return fmt::format("{}..{}", kind.low, kind.high);
}

std::string usual(const FaultKind& kind) {
  if (!kind.words.empty()) return std::string(kind.words[static_cast<std::size_t>(kind.usual)]);
  return fmt::format("{}", kind.usual);
}

std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> value_of(const FaultKind& kind, std::string_view text) {
  if (kind.words.empty()) {
    const std::optional<double> value = number(text);
    return value && *value >= kind.low && *value <= kind.high ? value : std::nullopt;
  }
  const auto word = std::ranges::find(kind.words, text);
  if (word == kind.words.end()) return std::nullopt;
  return static_cast<double>(word - kind.words.begin());
}

std::string unknown_fault(std::string_view name) {
  std::vector<std::string_view> names;
  for (const FaultKind& kind : kFaults) names.push_back(kind.name);
  const auto meant = nearest(name, names);
  return fmt::format("fault \"{}\" is not known; {}", name,
                     meant ? fmt::format("did you mean \"{}\"?", *meant) : std::string("try help"));
}

}  // namespace

void Fault::apply(SimulatedPioneer& pioneer) const { kind_->apply(pioneer, value_); }

std::string Fault::text() const {
  const std::string value =
      kind_->words.empty() ? fmt::format("{}", value_) : std::string(kind_->words[static_cast<std::size_t>(value_)]);
  return fmt::format("{}={}", kind_->name, value);
}

tl::expected<Fault, std::string> parse_fault(std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  const auto kind = std::ranges::find(kFaults, name, &FaultKind::name);
  if (kind == kFaults.end()) return tl::unexpected(unknown_fault(name));
  if (equals == std::string_view::npos) return Fault(*kind, kind->usual);
  const std::optional<double> value = value_of(*kind, text.substr(equals + 1));
  if (!value) {
    return tl::unexpected(fmt::format("{}: \"{}\" is not one of {}", name, text.substr(equals + 1), values(*kind)));
  }
  return Fault(*kind, *value);
}

std::string fault_help() {
  std::string help;
  for (const FaultKind& kind : kFaults) {
    help += fmt::format("{:<20} {:<24} {} [{}]\n", kind.name, values(kind), kind.help, usual(kind));
  }
  return help;
}

tl::expected<TimedFault, std::string> parse_timed_fault(std::string_view text) {
  double at_s = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), at_s);
  const auto rest = text.substr(static_cast<std::size_t>(end - text.data()));
  const bool in_range = at_s >= 0.0 && at_s <= kLongest_s;
  if (error != std::errc() || !rest.starts_with(':') || !in_range) {
    return tl::unexpected(fmt::format("\"{}\" is not SECONDS:FAULT", text));
  }
  return parse_fault(rest.substr(1)).map([&](const Fault& fault) {
    return TimedFault{Stamp(duration_from_seconds(at_s)), fault};
  });
}

FaultSchedule::FaultSchedule(std::vector<TimedFault> once, std::vector<Fault> cycle, Duration period)
    : once_(std::move(once)), cycle_(std::move(cycle)), period_(period), next_cycle_at_(period) {
  assert(cycle_.empty() || period_ > Duration{});
  std::ranges::stable_sort(once_, {}, &TimedFault::at);
}

Stamp FaultSchedule::due() const { return std::min(once_due(), cycle_due()); }

std::vector<Fault> FaultSchedule::take(Stamp now) {
  std::vector<Fault> faults;
  while (due() <= now) faults.push_back(take_one());
  return faults;
}

Fault FaultSchedule::take_one() {
  if (once_due() <= cycle_due()) return once_[next_once_++].fault;
  const Fault& fault = cycle_[next_in_cycle_];
  next_in_cycle_ = (next_in_cycle_ + 1) % cycle_.size();
  next_cycle_at_ += period_;
  return fault;
}

}  // namespace azimuth::sim
