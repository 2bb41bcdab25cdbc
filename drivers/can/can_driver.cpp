#include "drivers/can/can_driver.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <linux/can/error.h>
#include <poll.h>
#include <string_view>
#include <utility>

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = CanDriver::Clock;

constexpr Clock::duration kFirstBackOff = 20ms, kLongestBackOff = 200ms;
constexpr Clock::duration kLook = 200ms;  // interval of the checks that the interface is still the same
constexpr Clock::duration kBusNews = 1s;  // shortest time between two messages
constexpr Clock::duration kIdle = 1s;
constexpr std::string_view kOdometer = "can ";

}  // namespace

const char* text(CanBusState state) {
  switch (state) {
    case CanBusState::active:
      return "error-active";
    case CanBusState::warning:
      return "error-warning";
    case CanBusState::passive:
      return "error-passive";
    case CanBusState::off:
      return "bus-off";
  }
  return "";
}

void CanBus::add(const CanFrame& frame) {
  if (frame.kind != CanFrame::Kind::error) return;
  ++error_frames_;
  const std::uint32_t classes = frame.id.number;
  if ((classes & CAN_ERR_CRTL) != 0 && frame.size > 1) follow_controller(frame.data[1]);
  if ((classes & CAN_ERR_RESTARTED) != 0) {
    ++restarts_;
    state_ = CanBusState::active;
  }
  if ((classes & CAN_ERR_BUSOFF) != 0) {
    ++bus_offs_;
    state_ = CanBusState::off;
  }
}

void CanBus::follow_controller(std::uint8_t details) {
  if ((details & CAN_ERR_CRTL_RX_OVERFLOW) != 0) ++overruns_;
  if ((details & CAN_ERR_CRTL_ACTIVE) != 0) state_ = CanBusState::active;
  if ((details & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) != 0) state_ = CanBusState::warning;
  if ((details & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0) state_ = CanBusState::passive;
}

/// Traffic shows a restart, because not every driver reports it.
void CanBus::note_traffic() {
  if (state_ == CanBusState::off) state_ = CanBusState::active;
}

CanDriver::CanDriver(const CanSettings& settings, const CanLayout& layout, Duration epoch_minus_monotonic,
                     CanLinkOpener open_link)
    : settings_(settings),
      layout_(layout),
      ids_(layout.ids()),
      odometer_(layout, settings, epoch_minus_monotonic),
      open_link_(std::move(open_link)),
      back_off_(kFirstBackOff, kLongestBackOff),
      news_("odometry comes from " + settings.interface) {}

bool CanDriver::remember(OdometerMemory& out) const {
  out.odometer.assign(kOdometer).append(settings_.interface);
  out.robot.clear();
  return odometer_.remember(out);
}

void CanDriver::restore(const OdometerMemory& memory) {
  const bool is_ours =
      memory.odometer.starts_with(kOdometer) && memory.odometer.substr(kOdometer.size()) == settings_.interface;
  if (!is_ours || !odometer_.restore(memory)) odometer_.follow(memory.origin);
}

short CanDriver::poll_events() const { return link_ ? POLLIN : 0; }

Clock::duration CanDriver::due_in(Clock::time_point now) const {
  if (state_.connection == Connection::closed) return kIdle;
  if (is_full_) return {};
  Clock::time_point due = now + kIdle;
  if (!link_) due = std::min(due, back_off_.due());
  if (link_ && state_.connection != Connection::running) due = std::min(due, look_at_);
  if (state_.connection == Connection::running) due = std::min(due, last_reading_ + clock_duration(settings_.stale_s));
  return std::max(Clock::duration{}, due - now);
}

void CanDriver::turn(Clock::time_point now) {
  if (state_.connection == Connection::closed) return;
  if (!link_ && back_off_.is_due(now)) open(now);
  if (link_) read(now);
  follow_bus(now);
  watch(now);
  update_counters();
}

void CanDriver::open(Clock::time_point now) {
  OpenedCanLink opened = open_link_(settings_.interface, ids_);
  if (!opened) return drop_link(opened.error().text(), now);
  link_ = *std::move(opened);
  look_at_ = now + kLook;
  is_new_ = true;
  bus_.note_opened();
  if (const std::string note = link_->note(); note != told_note_) news_.tell(settings_.interface + ": " + note);
  told_note_ = link_->note();
  enter(Connection::starting, {});
}

void CanDriver::read(Clock::time_point now) {
  const CanLink::Received received = link_->receive(received_);
  is_full_ = received.count == received_.size();
  for (std::size_t i = 0; i < received.count; ++i) receive(received_.at(i), now);
  if (received.error) return drop_link(received.error->text(), now);
  if (!received.is_down) return;
  is_new_ = true;
  enter(Connection::away, settings_.interface + ": is down");
}

void CanDriver::receive(const CanReception& reception, Clock::time_point now) {
  const CanFrame& frame = reception.frame;
  if (frame.kind == CanFrame::Kind::error) {
    bus_.add(frame);
    return follow_bus(now);  // at once, because the next frame may already show the bus working again
  }
  if (frame.kind != CanFrame::Kind::data || !is_wanted(frame.id)) {
    ++state_.foreign;
    return;
  }
  ++state_.frames;
  bus_.note_traffic();
  read_robot(frame);
  const auto reading = odometer_.add(frame, reception.at);
  if (!reading) return;
  if (!readings_.push(*reading)) ++state_.refused_readings;
  last_reading_ = now;
  back_off_.succeeded();
  if (std::exchange(is_new_, false)) ++state_.sessions;
  enter(Connection::running, {});
}

bool CanDriver::is_wanted(const CanId& id) const { return std::ranges::find(ids_, id) != ids_.end(); }

void CanDriver::read_robot(const CanFrame& frame) {
  if (layout_.battery) {
    const CanDecoded battery = decode(*layout_.battery, frame);
    if (battery.found == CanFound::value) state_.battery_V = battery.value.value;
    if (battery.found == CanFound::too_short || battery.found == CanFound::not_finite) ++malformed_robot_;
  }
  read_flag(layout_.emergency_stop, frame, state_.emergency_stop);
  read_flag(layout_.bumper, frame, state_.bumper);
  read_flag(layout_.charging, frame, state_.charging);
}

void CanDriver::read_flag(const std::optional<CanSignal>& flag, const CanFrame& frame, bool& is_set) {
  if (!flag) return;
  const CanDecoded decoded = decode(*flag, frame);
  if (decoded.found == CanFound::too_short || decoded.found == CanFound::not_finite) ++malformed_robot_;
  if (decoded.found == CanFound::value) is_set = decoded.value.value != 0.0;
}

/// Error frames may arrive by the thousand, so the log gets at most one line per second.
void CanDriver::follow_bus(Clock::time_point now) {
  state_.bus = bus_.state();
  if (state_.bus == told_bus_ || (now < bus_told_at_ + kBusNews && state_.bus != CanBusState::off)) return;
  told_bus_ = state_.bus;
  bus_told_at_ = now;
  const std::string news = fmt::format("{}: {}", settings_.interface, text(state_.bus));
  if (state_.bus != CanBusState::off) return news_.tell(news);
  is_new_ = true;
  enter(Connection::away, news + ", until the kernel restarts it (restart-ms)");
}

void CanDriver::watch(Clock::time_point now) {
  if (state_.connection == Connection::running && now - last_reading_ >= clock_duration(settings_.stale_s)) {
    ++state_.stale;
    look_at_ = now;
    enter(Connection::silent, settings_.interface + ": no odometry");
  }
  if (!link_ || state_.connection == Connection::running || now < look_at_) return;
  look_at_ = now + kLook;
  if (!link_->is_present()) drop_link(settings_.interface + ": no such interface", now);
}

void CanDriver::drop_link(const std::string& trouble, Clock::time_point now) {
  if (link_) {
    const CanLink::Counts counts = link_->counts();
    closed_counts_.malformed += counts.malformed;
    closed_counts_.dropped += counts.dropped;
    closed_counts_.stamps_replaced += counts.stamps_replaced;
  }
  link_.reset();
  is_full_ = false;
  back_off_.failed(now);
  enter(Connection::away, trouble);
}

void CanDriver::update_counters() {
  const CanLink::Counts counts = link_ ? link_->counts() : CanLink::Counts{};
  state_.malformed = closed_counts_.malformed + counts.malformed + odometer_.malformed() + malformed_robot_;
  state_.dropped = closed_counts_.dropped + counts.dropped + bus_.overruns();
  state_.stamps_replaced = closed_counts_.stamps_replaced + counts.stamps_replaced;
  state_.error_frames = bus_.error_frames();
  state_.bus_offs = bus_.bus_offs();
  state_.missed = odometer_.missed();
  state_.doubted = odometer_.doubted();
  state_.restarts = odometer_.restarts();
  state_.gaps = odometer_.gaps();
  state_.speed_m_s = odometer_.speed_m_s();
}

void CanDriver::close() {
  link_.reset();
  state_.trouble.clear();
  state_.connection = Connection::closed;
}

}  // namespace azimuth
