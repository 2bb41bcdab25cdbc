#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <systemd/sd-event.h>

#include "daemon/pipeline/pipeline.hpp"
#include "daemon/supervise/service_manager.hpp"
#include "daemon/supervise/status_display.hpp"

namespace azimuth {

/// Blocks SIGTERM, SIGINT and SIGHUP, so that the event loop receives them. To be called before the first thread
/// starts, because threads inherit the signal mask.
void block_signals();

/// The reason for the end of a pipeline, and its last state.
struct PipelineEnd {
  /// True: the pipeline is to be built again; false: the daemon ends.
  bool reload = false;
  bool played_out = false;  ///< a recording has been played to its end
  std::uint64_t steps = 0;  ///< number of steps of the estimator
  SampleFinding samples;    ///< the last trouble with the samples
  bool pose_known = false;  ///< the last estimate of the pose was correct
  bool lost = false;
};

/// Runs a pipeline from start to stop. It handles signals, the service manager with its watchdog, refused scheduling,
/// and the status.
///
/// The watchdog is fed only while no stage has exceeded its deadline; a timer alone would prove only that timers work.
/// The supervisor does not wait for a stage that stays late: it asks the service manager to act at once as if the
/// watchdog had expired.
///
/// Thread contract: bound to the main thread.
class Supervisor {
 public:
  struct Settings {
    bool hold = false;         ///< keep running after the end of the recording
    bool show_status = false;  ///< print a status line each second even without a terminal
    /// Lock the memory of the process, from its first pose on. Reading all pages before that would delay the first
    /// pose.
    bool lock_memory = false;
    /// When the process started; for the time since the start.
    std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
    /// Reads the configuration again, for SIGHUP. Returns a short text of what is wrong (all errors have been logged);
    /// empty: the pipeline is to be built again.
    std::function<std::string()> reload = [] { return std::string("not possible"); };
  };

  /// The pipeline rings `bell`. Throws std::system_error when there can be no event loop.
  Supervisor(Pipeline& pipeline, Doorbell& bell, ServiceManager& manager, Settings settings);

  /// Starts the pipeline, waits for its end or a signal, and stops it. During a final stop, a second signal ends the
  /// process. During a stop for a reload, signals wait for the next supervisor.
  PipelineEnd run();

 private:
  void watch_signals();
  void watch_bell();
  void watch_time();
  void on_bell();
  void on_tick();
  void on_signal(int number);
  void on_hangup();
  void report_late(const StageThread* late);
  void give_up(const StageThread& hung);
  void settle();
  void report_events();
  std::chrono::seconds uptime() const;
  void report_samples();
  void report_pace();
  void stop();
  void take_signals_as_they_come();

  using EventLoop = std::unique_ptr<sd_event, sd_event* (*)(sd_event*)>;

  Pipeline& pipeline_;
  Doorbell& bell_;
  Settings settings_;
  ServiceManager& manager_;
  StatusDisplay display_;
  EventLoop loop_{nullptr, sd_event_unref};
  std::chrono::microseconds tick_{};
  const StageThread* late_ = nullptr;
  int late_ticks_ = 0;  // consecutive ticks with a late stage
  std::uint64_t ticks_ = 0;
  bool has_watchdog_ = false;
  bool settled_ = false;
  bool end_reported_ = false;
  bool reload_ = false;
  ProcessStatus process_;
  Status status_;
  SampleTrouble sample_trouble_ = SampleTrouble::none;  // the trouble reported last
  bool told_slow_ = false;
  DeviceEvent event_;
};

}  // namespace azimuth
