#include "drivers/pioneer/driver.hpp"

#include <algorithm>
#include <poll.h>
#include <utility>

#include "drivers/device/device_clock.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using pioneer::Link;
using pioneer::LinkError;
using Clock = PioneerDriver::Clock;

constexpr Clock::duration kFirstBackOff = 50ms, kLongestBackOff = 1s;
constexpr Clock::duration kLongestAfterRefusal = 30s;
constexpr Clock::duration kConnect = 1s;      // limit for a TCP connection; the kernel tries again no sooner
constexpr Clock::duration kLastBytes = 20ms;  // for bytes on their way from the kernel through the adapter to the wire
constexpr Clock::duration kIdle = 1s;
constexpr Clock::duration kLookAtStanding = 20ms, kAskStanding = 500ms;
// Longest time for which a silent TCP connection is kept. A bridge for one client may have lost the state of the
// connection, and accepts no other one before this is closed.
constexpr Clock::duration kLongestStanding = 30s;

/// Sleeps until `fd` is ready, a short time has passed, or `deadline` is reached.
void wait_for(int fd, short events, Clock::time_point deadline) {
  constexpr Clock::duration kLittle = 2ms;
  const auto at_most = std::min(kLittle, deadline - Clock::now());
  const timespec limit{.tv_sec = 0, .tv_nsec = std::max<long>(0, at_most.count())};
  pollfd ready{.fd = fd, .events = events, .revents = 0};
  ::ppoll(&ready, 1, &limit, nullptr);
}

/// Sends until the other side has all bytes, or until the deadline.
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

PioneerDriver::PioneerDriver(const PioneerSettings& settings, Duration epoch_minus_monotonic,
                             pioneer::LinkOpener open_link)
    : settings_(settings),
      epoch_minus_monotonic_(epoch_minus_monotonic),
      scanner_(pioneer::is_plausible_config),
      session_(settings, pioneer::DeviceLink::is_serial(settings.device)),
      odometer_(settings, epoch_minus_monotonic),
      open_link_(std::move(open_link)),
      back_off_(kFirstBackOff, kLongestBackOff),
      news_("odometry comes from " + settings.device) {}

PioneerDriver::~PioneerDriver() { close(Clock::now() + 100ms); }

int PioneerDriver::descriptor() const { return link_ ? link_->descriptor() : -1; }

short PioneerDriver::poll_events() const {
  if (!link_) return 0;
  if (link_->connecting()) return POLLOUT;
  return link_->has_unsent() ? POLLIN | POLLOUT : POLLIN;
}

Clock::duration PioneerDriver::due_in(Clock::time_point now) const {
  if (state_.connection == Connection::closed) return kIdle;
  auto due = now + kIdle;
  if (!link_) due = std::min(due, back_off_.due());
  if (link_ && !began_) due = std::min(due, connect_until_);
  if (link_ && began_) due = std::min(due, now + std::min(kIdle, session_.due_in(now)));
  if (standing_) due = std::min(due, now + kLookAtStanding);
  if (state_.connection == Connection::running) due = std::min(due, last_sip_ + clock_duration(settings_.stale_s));
  return std::max(Clock::duration{}, due - now);
}

void PioneerDriver::turn(Clock::time_point now) {
  if (state_.connection == Connection::closed) return;
  const bool ran = session_.phase() == pioneer::SessionPhase::running;
  if (standing_) watch_standing(now);
  if (!link_ && back_off_.is_due(now)) open(now);
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
  update_counters(ran);
}

void PioneerDriver::open(Clock::time_point now) {
  auto opened = open_link_(settings_.device);
  if (!opened) return fail_to_open(opened.error(), now);
  if (!silent_since_) silent_since_ = now;
  link_ = *std::move(opened);
  began_ = served_ = false;
  connect_until_ = now + kConnect;
}

void PioneerDriver::fail_to_open(const LinkError& error, Clock::time_point now) {
  if (!is_hung(error.error_number)) {
    silent_since_.reset();
  } else if (!silent_since_) {
    silent_since_ = now;
  }
  drop_link(error.text(), now);
}

void PioneerDriver::wake(Clock::time_point now) {
  back_off_.wake(now);
  refusal_back_off_ = kFirstAfterRefusal;
}

void PioneerDriver::release(Clock::time_point now, Clock::duration at_most) {
  if (state_.connection == Connection::closed) return;
  standing_.reset();
  drop_link(settings_.device + ": let go of, for a reset of its USB port", now);
  back_off_.postpone(now + at_most);
}

/// A serial line counts as connected when it is open.
void PioneerDriver::connect(Clock::time_point now) {
  if (link_->connecting()) {
    if (const auto error = link_->finish_connecting()) return drop_link(error->text(), now);
    if (link_->connecting() && now >= connect_until_) return drop_link(settings_.device + ": no connection", now);
    if (link_->connecting()) return;
  }
  began_ = true;
  if (!standing_) enter(Connection::starting, {});
  session_.begin(now);
  perform_actions(now);
}

void PioneerDriver::read(Clock::time_point now) {
  constexpr int kMostReads = 8;  // limits the work of one turn
  std::array<std::uint8_t, pioneer::PacketScanner::kRoom> bytes{};
  for (int i = 0; i < kMostReads && link_; ++i) {
    const Link::Read read = link_->read(bytes);
    if (read.error) return drop_link(read.error->text(), now);
    if (link_->speaks_telnet() && !std::exchange(told_telnet_, true)) tell_of_telnet();
    if (read.size == 0) return;
    take_bytes(pioneer::ByteView(bytes).first(read.size), now);
  }
}

void PioneerDriver::tell_of_telnet() {
  news_.tell(settings_.device +
             ": the serial bridge is in telnet mode: it doubles bytes of 0xFF and puts commands in between, which is "
             "undone here; set its port to raw TCP mode, where nothing has to be");
}

void PioneerDriver::take_bytes(pioneer::ByteView bytes, Clock::time_point now) {
  silent_since_ = now;
  scanner_.add(bytes, now, byte_time());
  while (link_) {
    const auto packet = scanner_.next();
    if (!packet) return;
    receive(*packet, now);
  }
}

/// Keeps a link that has delivered odometry and then fell silent for long. A kept link that falls silent again at once
/// is not kept.
void PioneerDriver::keep_standing(Clock::time_point now) {
  if (!served_ || standing_ || pioneer::DeviceLink::is_serial(settings_.device)) return;
  standing_ = std::move(link_);
  standing_until_ = now + kLongestStanding;
  standing_asked_ = now;
}

/// A byte received on the kept link makes it the active one again. Until then a SYNC0 is sent from time to time. An
/// open session treats it as a sign of life, and a restarted controller as the start of synchronisation.
void PioneerDriver::watch_standing(Clock::time_point now) {
  std::array<std::uint8_t, pioneer::PacketScanner::kRoom> bytes{};
  const Link::Read read = standing_->read(bytes);
  if (read.error || now >= standing_until_) return standing_.reset();
  if (read.size == 0) {
    if (now - standing_asked_ < kAskStanding) return;
    standing_asked_ = now;
    if (standing_->write(pioneer::encode_command(pioneer::kSync0).view())) standing_.reset();
    return;
  }
  session_.drop();
  scanner_.clear();
  link_ = std::move(standing_);
  began_ = true;
  served_ = false;
  session_.resume_at(now);
  perform_actions(now);
  if (link_) take_bytes(pioneer::ByteView(bytes).first(read.size), now);
}

void PioneerDriver::receive(const pioneer::Packet& packet, Clock::time_point now) {
  if (packet.verified) ++state_.packets;
  const pioneer::Message message = pioneer::decoded(packet);
  session_.receive(message, now);
  follow_session();
  if (session_.is_open()) {
    if (const auto reading = odometer_.add(message, byte_time()); reading && !readings_.push(*reading))
      ++state_.refused_readings;
    if (const pioneer::StandardSip* sip = message.sip()) look_at(*sip, now);
  }
  perform_actions(now);
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
      return give_up(now);
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
  back_off_.failed(now);
  if (!standing_) enter(Connection::away, trouble);
}

void PioneerDriver::give_up(Clock::time_point now) {
  const bool refused = session_.refused();
  if (!refused) keep_standing(now);
  drop_link(settings_.device + ": " + session_.reason(), now);
  if (!refused) return;
  back_off_.postpone(now + refusal_back_off_);
  refusal_back_off_ = std::min(2 * refusal_back_off_, kLongestAfterRefusal);
}

Clock::duration PioneerDriver::byte_time() const {
  return session_.baud() > 0 ? clock_duration(10.0 / session_.baud()) : Clock::duration{};
}

void PioneerDriver::close(Clock::time_point deadline) {
  if (state_.connection == Connection::closed) return;
  const auto now = Clock::now();
  if (link_ && began_) {
    if (settings_.keep_session)
      session_.leave(now);
    else
      session_.close(now);
    perform_actions(now);
  }
  if (link_ && began_) drain(*link_, deadline);
  link_.reset();
  standing_.reset();
  state_.trouble.clear();
  state_.connection = Connection::closed;
}

}  // namespace azimuth
