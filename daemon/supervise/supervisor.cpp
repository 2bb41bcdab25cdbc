#include "daemon/supervise/supervisor.hpp"

#include <algorithm>
#include <csignal>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <system_error>
#include <utility>

#include "daemon/journal/journal.hpp"
#include "daemon/supervise/realtime.hpp"
#include "settings/sample_sentence.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// A hanging stage is noticed within this time after its deadline.
constexpr std::chrono::microseconds kTick = 50ms;
/// A stage that is late at this many consecutive ticks is given up. A process that was suspended as a whole is late at
/// one tick only.
constexpr int kGraceTicks = 2;
/// Ticks after which settle() runs even without a first pose, for which devices may be missing.
constexpr std::uint64_t kSettledTicks = 100;

void require(int result, const char* what) {
  if (result < 0) throw std::system_error(-result, std::generic_category(), what);
}

sigset_t handled_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGHUP);
  return signals;
}

}  // namespace

void block_signals() {
  const sigset_t signals = handled_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

Supervisor::Supervisor(Pipeline& pipeline, Doorbell& bell, ServiceManager& manager, Settings settings)
    : pipeline_(pipeline),
      bell_(bell),
      settings_(std::move(settings)),
      manager_(manager),
      display_(settings_.show_status) {
  sd_event* loop = nullptr;
  require(sd_event_new(&loop), "event loop");
  loop_.reset(loop);
  const auto watchdog = ServiceManager::watchdog_interval();
  has_watchdog_ = watchdog.has_value();
  tick_ = watchdog ? std::clamp<std::chrono::microseconds>(*watchdog / 3, 1ms, kTick) : kTick;
  watch_signals();
  watch_bell();
  watch_time();
}

void Supervisor::watch_signals() {
  const auto handler = [](sd_event_source*, const signalfd_siginfo* info, void* self) {
    static_cast<Supervisor*>(self)->on_signal(static_cast<int>(info->ssi_signo));
    return 0;
  };
  for (const int number : {SIGTERM, SIGINT, SIGHUP})
    require(sd_event_add_signal(loop_.get(), nullptr, number, handler, this), "signals");
}

void Supervisor::watch_bell() {
  const auto handler = [](sd_event_source*, int, std::uint32_t, void* self) {
    static_cast<Supervisor*>(self)->on_bell();
    return 0;
  };
  require(sd_event_add_io(loop_.get(), nullptr, bell_.descriptor(), EPOLLIN, handler, this), "doorbell");
}

void Supervisor::watch_time() {
  const auto handler = [](sd_event_source* source, std::uint64_t, void* self) {
    auto* const supervisor = static_cast<Supervisor*>(self);
    supervisor->on_tick();
    return sd_event_source_set_time_relative(source, static_cast<std::uint64_t>(supervisor->tick_.count()));
  };
  sd_event_source* timer = nullptr;
  require(sd_event_add_time_relative(loop_.get(), &timer, CLOCK_MONOTONIC, 0, 1000, handler, this), "timer");
  require(sd_event_source_set_enabled(timer, SD_EVENT_ON), "timer");
  require(sd_event_source_set_floating(timer, 1), "timer");  // the loop owns the timer
  sd_event_source_unref(timer);
}

PipelineEnd Supervisor::run() {
  pipeline_.start();
  manager_.ready("running");
  require(sd_event_loop(loop_.get()), "event loop");
  stop();
  const Health health = status_.estimate.health;
  return {.reload = reload_,
          .played_out = end_reported_,
          .steps = pipeline_.digest().estimates(),
          .samples = status_.samples,
          .pose_known = status_.any_estimate && (health == Health::tracking || health == Health::degraded),
          .lost = status_.any_estimate && health == Health::lost};
}

void Supervisor::on_bell() {
  bell_.silence();
  report_events();
  if (pipeline_.take_status(status_)) {
    report_samples();
    report_pace();
    const std::string line = status_line(status_, uptime());
    display_.show(line);
    manager_.status(line);
    if (status_.any_estimate) settle();
  }
  if (!pipeline_.finished() || end_reported_) return;
  end_reported_ = true;
  display_.end_line();
  spdlog::info("the recording has been played to its end");
  if (!settings_.hold) sd_event_exit(loop_.get(), 0);
}

std::chrono::seconds Supervisor::uptime() const {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - settings_.started);
}

void Supervisor::report_events() {
  while (pipeline_.take_event(event_)) {
    display_.end_line();
    const JournalEvent kind = event_.port_reset ? JournalEvent::port_reset
                              : event_.trouble  ? JournalEvent::device_trouble
                                                : JournalEvent::device_recovered;
    log_event(kind, event_.text, {.device = event_.device});
  }
}

/// Logs each change once.
void Supervisor::report_samples() {
  const SampleTrouble trouble = status_.samples.trouble;
  if (trouble == std::exchange(sample_trouble_, trouble)) return;
  display_.end_line();
  if (trouble == SampleTrouble::none)
    spdlog::info("samples: as they should be again");
  else
    log_event(JournalEvent::sample_trouble, "samples: " + sentence(status_.samples));
}

/// Logs each change once. The numbers in the text change all the time and are not compared.
void Supervisor::report_pace() {
  const bool is_slow = !status_.pace.empty();
  if (is_slow == std::exchange(told_slow_, is_slow)) return;
  display_.end_line();
  if (is_slow)
    log_event(JournalEvent::sample_trouble, "samples: " + status_.pace);
  else
    spdlog::info("samples: all that come are used again");
}

void Supervisor::on_tick() {
  if (++ticks_ == kSettledTicks) settle();
  const StageThread* const late = pipeline_.first_late(std::chrono::steady_clock::now());
  if (late != late_) report_late(late);
  if (!late) manager_.alive();
  late_ticks_ = late ? late_ticks_ + 1 : 0;
  if (has_watchdog_ && late_ticks_ == kGraceTicks) give_up(*late);
}

void Supervisor::report_late(const StageThread* late) {
  display_.end_line();
  const StageSpec& spec = (late ? late : late_)->spec();
  if (late) {
    log_event(
        JournalEvent::stage_late,
        fmt::format("{} has not finished a turn for {} ms: the watchdog is not fed", spec.name, spec.deadline.count()),
        {.stage = spec.name});
  } else {
    log_event(JournalEvent::stage_goes_on, fmt::format("{} goes on", spec.name), {.stage = spec.name});
  }
  late_ = late;
}

void Supervisor::give_up(const StageThread& hung) {
  display_.end_line();
  const char* const name = hung.spec().name;
  log_event(JournalEvent::stage_late, fmt::format("{} hangs: the service manager is asked to end this", name),
            {.stage = name});
  manager_.give_up();
}

void Supervisor::on_signal(int number) {
  display_.end_line();
  if (number == SIGHUP && !display_.terminal_is_gone()) return on_hangup();
  spdlog::info("{}: stopping", number == SIGTERM ? "SIGTERM" : number == SIGINT ? "SIGINT" : "the terminal is gone");
  sd_event_exit(loop_.get(), 0);
}

void Supervisor::on_hangup() {
  spdlog::info("SIGHUP: reading the configuration anew");
  manager_.reloading();
  // A hanging stage would keep the pipeline from stopping; the watchdog handles that case.
  process_.configuration = late_ ? std::string(late_->spec().name) + " hangs, so nothing is read" : settings_.reload();
  manager_.alive();
  if (process_.configuration.empty()) {
    reload_ = true;
    sd_event_exit(loop_.get(), 0);
    return;
  }
  log_event(JournalEvent::configuration_refused,
            "the configuration is as it was before SIGHUP: " + process_.configuration);
  pipeline_.tell(process_);
  manager_.ready("configuration refused: " + process_.configuration);
}

/// Runs once, when every thread has requested its scheduling. Locking reads the whole process into memory, and
/// meanwhile no thread can allocate memory. Before the first pose this would delay the opening of every device.
void Supervisor::settle() {
  if (std::exchange(settled_, true)) return;
  std::optional<std::string> lock_refusal;
  if (settings_.lock_memory) lock_refusal = lock_memory();
  const RealTime outcome = real_time(pipeline_.threads(), settings_.lock_memory, lock_refusal);
  for (const std::string& refusal : outcome.refusals) log_event(JournalEvent::realtime_refused, refusal);
  process_.realtime = outcome.text;
  process_.realtime_refused = !outcome.refusals.empty();
  pipeline_.tell(process_);
}

/// A second signal ends the process at once, even if a stage hangs.
void Supervisor::take_signals_as_they_come() {
  sigset_t signals = handled_signals();
  sigdelset(&signals, SIGHUP);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGINT, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

void Supervisor::stop() {
  if (!reload_) {
    manager_.stopping();
    take_signals_as_they_come();
  }
  pipeline_.stop();
  report_events();
  manager_.alive();
  if (pipeline_.take_status(status_)) {
    report_samples();
    display_.show(status_line(status_, uptime()));
  }
  display_.end_line();
  const WireLosses losses = pipeline_.losses();
  spdlog::info(
      "wires: {} odometry refused, {} frames replaced, {} bearings refused, {} estimates replaced, {} echoes refused",
      losses.odometry_refused, losses.frames_replaced, losses.bearings_refused, losses.estimates_replaced,
      losses.echoes_refused);
  spdlog::info("{} estimates, digest {}", pipeline_.digest().estimates(), digest_text(pipeline_.digest().value()));
}

}  // namespace azimuth
