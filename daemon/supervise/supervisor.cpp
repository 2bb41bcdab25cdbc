#include "daemon/supervise/supervisor.hpp"

#include <algorithm>
#include <csignal>
#include <spdlog/spdlog.h>
#include <system_error>

#include "daemon/supervise/realtime.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// A stage that hangs is noticed within this time after its deadline.
constexpr std::chrono::microseconds kTick = 200ms;

void require(int result, const char* what) {
  if (result < 0) throw std::system_error(-result, std::generic_category(), what);
}

sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  return signals;
}

}  // namespace

void block_stop_signals() {
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

Supervisor::Supervisor(Pipeline& pipeline, Doorbell& bell, const Settings& settings)
    : pipeline_(pipeline), bell_(bell), settings_(settings), display_(settings.show_status) {
  sd_event* loop = nullptr;
  require(sd_event_new(&loop), "event loop");
  loop_.reset(loop);
  const auto watchdog = ServiceManager::watchdog_interval();
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
  require(sd_event_add_signal(loop_.get(), nullptr, SIGTERM, handler, this), "SIGTERM");
  require(sd_event_add_signal(loop_.get(), nullptr, SIGINT, handler, this), "SIGINT");
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
  require(sd_event_source_set_floating(timer, 1), "timer");  // the loop owns it
  sd_event_source_unref(timer);
}

void Supervisor::run() {
  pipeline_.start();
  manager_.ready("running");
  require(sd_event_loop(loop_.get()), "event loop");
  stop();
}

void Supervisor::on_bell() {
  bell_.silence();
  report_events();
  if (pipeline_.take_status(status_)) {
    const std::string line = status_line(status_);
    display_.show(line);
    manager_.status(line);
  }
  if (!pipeline_.finished() || end_reported_) return;
  end_reported_ = true;
  display_.end_line();
  spdlog::info("the recording has been played to its end");
  if (!settings_.hold) sd_event_exit(loop_.get(), 0);
}

void Supervisor::report_events() {
  while (pipeline_.take_event(event_)) {
    display_.end_line();
    spdlog::log(event_.trouble ? spdlog::level::warn : spdlog::level::info, "{}", event_.text);
  }
}

void Supervisor::on_tick() {
  report_refusals();
  const StageThread* const late = pipeline_.first_late(std::chrono::steady_clock::now());
  if (late != late_) {
    display_.end_line();
    if (late) {
      spdlog::error("{} has not finished a turn for {} ms: the watchdog is not fed", late->spec().name,
                    late->spec().deadline.count());
    } else {
      spdlog::info("{} goes on", late_->spec().name);
    }
    late_ = late;
  }
  if (!late) manager_.alive();
}

void Supervisor::on_signal(int number) {
  display_.end_line();
  spdlog::info("{}: stopping", number == SIGTERM ? "SIGTERM" : "SIGINT");
  sd_event_exit(loop_.get(), 0);
}

/// Once, on the second tick: by then every thread has asked for its scheduling.
void Supervisor::report_refusals() {
  if (++ticks_ != 2) return;
  for (const StageThread* stage : pipeline_.threads()) {
    for (const std::string& refusal : refusals(*stage)) spdlog::warn("{}", refusal);
  }
}

void Supervisor::stop() {
  manager_.stopping();
  // Whoever asks twice means it: the second signal ends the process at once, even if a stage hangs.
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGINT, SIG_DFL);
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  pipeline_.stop();
  report_events();
  if (pipeline_.take_status(status_)) display_.show(status_line(status_));
  display_.end_line();
  const WireLosses losses = pipeline_.losses();
  spdlog::info(
      "wires: {} odometry refused, {} frames replaced, {} bearings refused, {} estimates replaced, {} echoes refused",
      losses.odometry_refused, losses.frames_replaced, losses.bearings_refused, losses.estimates_replaced,
      losses.echoes_refused);
  spdlog::info("{} estimates, digest {}", pipeline_.digest().estimates(), digest_text(pipeline_.digest().value()));
}

}  // namespace azimuth
