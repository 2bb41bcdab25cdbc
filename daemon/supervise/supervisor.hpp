#pragma once
#include <chrono>
#include <memory>
#include <systemd/sd-event.h>

#include "daemon/pipeline/pipeline.hpp"
#include "daemon/supervise/service_manager.hpp"
#include "daemon/supervise/status_display.hpp"

namespace azimuth {

/// Blocks SIGTERM and SIGINT, so that the event loop receives them. Before the first thread starts: threads inherit it.
void block_stop_signals();

/// Runs a pipeline from start to stop: signals, the service manager with its watchdog, refused scheduling, the status.
///
/// The watchdog is fed only while no stage is past its deadline; a timer alone would prove only that timers work.
///
/// Thread contract: thread-bound, to the main thread.
class Supervisor {
 public:
  struct Settings {
    bool hold = false;         ///< keep running when the recording has ended
    bool show_status = false;  ///< a status line each second also where there is no terminal
  };

  /// `bell` is the one the pipeline rings. Throws std::system_error when there can be no event loop.
  Supervisor(Pipeline& pipeline, Doorbell& bell, const Settings& settings);

  /// Starts the pipeline, waits for its end or a signal, and stops it. A second signal while it stops ends the process.
  void run();

 private:
  void watch_signals();
  void watch_bell();
  void watch_time();
  void on_bell();
  void on_tick();
  void on_signal(int number);
  void report_refusals();
  void report_events();
  void stop();

  using EventLoop = std::unique_ptr<sd_event, sd_event* (*)(sd_event*)>;

  Pipeline& pipeline_;
  Doorbell& bell_;
  Settings settings_;
  ServiceManager manager_;
  StatusDisplay display_;
  EventLoop loop_{nullptr, sd_event_unref};
  std::chrono::microseconds tick_{};
  const StageThread* late_ = nullptr;
  std::uint64_t ticks_ = 0;
  bool end_reported_ = false;
  Status status_;
  DeviceEvent event_;
};

}  // namespace azimuth
