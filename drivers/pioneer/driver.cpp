#include "drivers/pioneer/driver.hpp"

#include <algorithm>
#include <poll.h>
#include <utility>

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using pioneer::Link;
using pioneer::LinkError;
using pioneer::SessionPhase;
using Clock = PioneerDriver::Clock;

constexpr Clock::duration kFirstBackOff = 50ms, kLongestBackOff = 1s;
constexpr Clock::duration kConnect = 2s;      // a TCP connection
constexpr Clock::duration kLastBytes = 20ms;  // from the kernel through the adapter onto the wire
constexpr Clock::duration kIdle = 1s;

Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

/// Sleeps on `fd`, but not past `deadline`.
void wait_for(int fd, short events, Clock::time_point deadline) {
  constexpr Clock::duration kLittle = 2ms;
  const auto at_most = std::min(kLittle, deadline - Clock::now());
  const timespec limit{.tv_sec = 0, .tv_nsec = std::max<long>(0, at_most.count())};
  pollfd ready{.fd = fd, .events = events, .revents = 0};
  ::ppoll(&ready, 1, &limit, nullptr);
}

/// Until the other side has all bytes, or the deadline.
void drain(Link& link, Clock::time_point deadline) {
  while (!link.is_drained() && Clock::now() < deadline) {
    if (link.flush()) return;
    wait_for(link.has_unsent() ? link.descriptor() : -1, POLLOUT, deadline);
  }
  link.finish_sending();
  std::array<std::uint8_t, 512> ignored{};
  const auto last = std::min(deadline, Clock::now() + kLastBytes);
  while (Clock::now() < last && !link.read(ignored).error) wait_for(-1, 0, last);
}

}  // namespace

PioneerDriver::PioneerDriver(const PioneerSettings& settings, Duration epoch_minus_monotonic)
    : settings_(settings),
      scanner_(pioneer::is_plausible_config),
      session_(settings, Link::is_serial(settings.device)),
      odometer_(settings, epoch_minus_monotonic),
      back_off_(kFirstBackOff) {}

PioneerDriver::~PioneerDriver() { close(Clock::now() + 100ms); }

int PioneerDriver::descriptor() const { return link_ ? link_->descriptor() : -1; }

short PioneerDriver::poll_events() const {
  if (!link_) return 0;
  if (link_->connecting()) return POLLOUT;
  return link_->has_unsent() ? POLLIN | POLLOUT : POLLIN;
}

Clock::duration PioneerDriver::due_in(Clock::time_point now) const {
  if (state_.connection == PioneerConnection::closed) return kIdle;
  auto due = now + kIdle;
  if (!link_) due = std::min(due, retry_at_);
  if (link_ && !began_) due = std::min(due, connect_until_);
  if (link_ && began_) due = std::min(due, now + std::min(kIdle, session_.due_in(now)));
  if (state_.connection == PioneerConnection::running) due = std::min(due, last_sip_ + seconds(settings_.stale_s));
  return std::max(Clock::duration{}, due - now);
}

void PioneerDriver::turn(Clock::time_point now) {
  if (state_.connection == PioneerConnection::closed) return;
  if (!link_ && now >= retry_at_) open(now);
  if (link_ && !began_) connect(now);
  if (link_ && began_) {
    read(now);
    session_.turn(now);
    follow_session();
    perform_actions(now);
  }
  if (link_) {
    if (const auto error = link_->flush()) drop_link(error->text(), now);
  }
  watch_staleness(now);
  update_counters();
}

void PioneerDriver::open(Clock::time_point now) {
  auto opened = Link::open(settings_.device);
  if (const auto* error = std::get_if<LinkError>(&opened)) return drop_link(error->text(), now);
  link_.emplace(std::get<Link>(std::move(opened)));
  began_ = false;
  connect_until_ = now + kConnect;
}

/// A serial line is connected when it is open.
void PioneerDriver::connect(Clock::time_point now) {
  if (link_->connecting()) {
    if (const auto error = link_->finish_connecting()) return drop_link(error->text(), now);
    if (link_->connecting() && now >= connect_until_) return drop_link(settings_.device + ": no connection", now);
    if (link_->connecting()) return;
  }
  began_ = true;
  enter(PioneerConnection::connecting, {});
  session_.begin(now);
  perform_actions(now);
}

void PioneerDriver::read(Clock::time_point now) {
  constexpr int kMostReads = 8;  // then let others have a turn
  std::array<std::uint8_t, pioneer::PacketScanner::kRoom> bytes{};
  for (int i = 0; i < kMostReads && link_; ++i) {
    const Link::Read read = link_->read(bytes);
    if (read.error) return drop_link(read.error->text(), now);
    if (read.size == 0) return;
    scanner_.add(pioneer::ByteView(bytes).first(read.size), now, byte_time());
    while (link_) {
      const auto packet = scanner_.next();
      if (!packet) break;
      receive(*packet, now);
    }
  }
}

void PioneerDriver::receive(const pioneer::Packet& packet, Clock::time_point now) {
  if (packet.verified) ++state_.packets;
  session_.receive(packet, now);
  follow_session();
  if (session_.is_open()) {
    if (const auto reading = odometer_.add(packet, byte_time()); reading && !readings_.push(*reading))
      ++state_.refused_readings;
    if (const auto sip = pioneer::decode_sip(packet.data)) look_at(*sip, now);
  }
  perform_actions(now);
}

void PioneerDriver::look_at(const pioneer::StandardSip& sip, Clock::time_point now) {
  last_sip_ = now;
  back_off_ = kFirstBackOff;
  enter(PioneerConnection::running, {});
  state_.battery_V = sip.battery_V();
  state_.charge_percent = sip.charge_percent.value_or(-1);
  state_.charge_state = sip.charge_state.value_or(255);
  state_.left_stall = sip.left_stall();
  state_.right_stall = sip.right_stall();
  state_.front_bumpers = sip.front_bumpers();
  state_.rear_bumpers = sip.rear_bumpers();
  state_.motors_enabled = sip.motors_enabled();
  state_.emergency_stop = sip.emergency_stop();
}

// ---- the session ------------------------------------------------------------------------------------------------

pioneer::OdometerSetup PioneerDriver::odometer_setup() const {
  pioneer::OdometerSetup setup{.parameters = session_.parameters(), .use_gyro = session_.uses_gyro()};
  const auto& config = session_.config();
  if (config) setup.sip_cycle_s = 1e-3 * std::max<int>(5, config->sip_cycle_ms);
  setup.ticks_per_mm = settings_.ticks_per_mm > 0.0 ? settings_.ticks_per_mm : config ? config->ticks_per_mm : 0.0;
  if (settings_.encoder == PioneerFeature::off) setup.ticks_per_mm = 0.0;
  return setup;
}

/// What a change in the session means for odometer, state and log.
void PioneerDriver::follow_session() {
  if (session_.reboots() != state_.reboots) {
    state_.reboots = session_.reboots();
    enter(PioneerConnection::connecting, settings_.device + ": the controller restarted");
  }
  if (session_.opened() != state_.sessions) {
    state_.sessions = session_.opened();
    followed_ = Followed::opening;
    state_.name = session_.robot().name;
    state_.subclass = session_.robot().subclass;
    odometer_.begin_session(odometer_setup());
    tell("session with \"" + state_.name + "\" (" + state_.subclass + ") on " + settings_.device);
  }
  const auto reached = session_.config() ? Followed::config : Followed::no_config;
  if (session_.phase() != SessionPhase::running || followed_ == reached) return;
  followed_ = reached;
  follow_config();
}

void PioneerDriver::follow_config() {
  odometer_.refine(odometer_setup());
  state_.uses_gyro = session_.uses_gyro();
  state_.config_unverified = session_.config_unverified();
  if (!session_.config()) return tell(state_.name + " does not tell its parameters: defaults are used");
  state_.firmware = session_.config()->firmware_version;
  if (state_.config_unverified)
    tell(state_.name + " sends its parameters with a wrong checksum; they are plausible and used");
  if (session_.baud_refused()) tell(state_.name + " does not follow to a higher baud rate");
}

void PioneerDriver::perform_actions(Clock::time_point now) {
  while (const auto action = session_.take()) {
    if (link_) perform(*action, now);
  }
}

void PioneerDriver::perform(const pioneer::SessionAction& action, Clock::time_point now) {
  std::optional<LinkError> error;
  switch (action.kind) {
    case pioneer::SessionAction::Kind::send:
      error = link_->write(action.frame.view());
      break;
    case pioneer::SessionAction::Kind::set_baud:
      error = link_->set_baud(action.baud);
      break;
    case pioneer::SessionAction::Kind::flush_input:
      link_->discard_input();
      scanner_.clear();
      break;
    case pioneer::SessionAction::Kind::give_up:
      return drop_link(settings_.device + ": " + session_.reason(), now);
    case pioneer::SessionAction::Kind::end:
      break;
  }
  if (error) drop_link(error->text(), now);
}

void PioneerDriver::drop_link(const std::string& trouble, Clock::time_point now) {
  link_.reset();
  began_ = false;
  session_.drop();
  scanner_.clear();
  retry_at_ = now + back_off_;
  back_off_ = std::min(2 * back_off_, kLongestBackOff);
  enter(PioneerConnection::disconnected, trouble);
}

// ---- the state --------------------------------------------------------------------------------------------------

void PioneerDriver::watch_staleness(Clock::time_point now) {
  if (state_.connection != PioneerConnection::running || now - last_sip_ < seconds(settings_.stale_s)) return;
  ++state_.stale;
  enter(PioneerConnection::stale, settings_.device + ": no odometry");
}

/// Every new trouble is told once, until the robot runs again.
void PioneerDriver::enter(PioneerConnection connection, const std::string& trouble) {
  const auto before = std::exchange(state_.connection, connection);
  if (connection == PioneerConnection::connecting && trouble.empty()) return;  // the trouble goes on, if there was one
  if (state_.trouble != trouble) state_.trouble = trouble;
  if (connection == PioneerConnection::running) {
    if (before != connection) tell("odometry comes from " + settings_.device);
    if (!told_trouble_.empty()) told_trouble_.clear();
  } else if (told_trouble_ != trouble) {
    told_trouble_ = trouble;
    tell(trouble);
  }
}

void PioneerDriver::update_counters() {
  state_.baud = session_.baud();
  state_.uses_ticks = odometer_.uses_ticks();
  state_.speed_m_s = odometer_.speed_m_s();
  state_.bad_checksums = scanner_.bad_checksums();
  state_.skipped_bytes = scanner_.skipped_bytes();
  state_.gaps = odometer_.gaps();
}

Clock::duration PioneerDriver::byte_time() const {
  return session_.baud() > 0 ? seconds(10.0 / session_.baud()) : Clock::duration{};
}

void PioneerDriver::close(Clock::time_point deadline) {
  if (state_.connection == PioneerConnection::closed) return;
  const auto now = Clock::now();
  if (link_ && began_) {
    session_.close(now);
    perform_actions(now);
  }
  if (link_ && began_) drain(*link_, deadline);
  link_.reset();
  state_.trouble.clear();
  state_.connection = PioneerConnection::closed;
}

const char* text(PioneerConnection connection) {
  switch (connection) {
    case PioneerConnection::disconnected:
      return "disconnected";
    case PioneerConnection::connecting:
      return "connecting";
    case PioneerConnection::running:
      return "running";
    case PioneerConnection::stale:
      return "stale";
    case PioneerConnection::closed:
      return "closed";
  }
  return "";
}

}  // namespace azimuth
