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

/// Blocks SIGTERM, SIGINT and SIGHUP, so that the event loop receives them. Before the first thread starts: threads
/// inherit it.
void block_signals();

/// Why a pipeline ended.
struct PipelineEnd {
  bool reload = false;      ///< to be built anew; else for good
  bool played_out = false;  ///< a recording came to its end
  std::uint64_t steps = 0;  ///< of the estimator
  SampleFinding samples;    ///< what was wrong with them last
  bool pose_known = false;  ///< the robot was where its last estimate said
  bool lost = false;
};

/// Runs a pipeline from start to stop: signals, the service manager with its watchdog, refused scheduling, the status.
///
/// The watchdog is fed only while no stage is past its deadline; a timer alone would prove only that timers work. A
/// stage that stays late is not waited for: the service manager is asked to do at once what it would do when its time
/// is up.
///
/// Thread contract: thread-bound, to the main thread.
class Supervisor {
 public:
  struct Settings {
    bool hold = false;         ///< keep running when the recording has ended
    bool show_status = false;  ///< a status line each second also where there is no terminal
    /// Keep the process in memory, from its first pose on: to read all of it takes longer than a robot should wait.
    bool lock_memory = false;
    /// When the process began, for how long it has run.
    std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
    /// Reads the configuration anew, for SIGHUP. Returns what is wrong with it in a few words, everything having been
    /// logged; empty: the pipeline is to be built anew.
    std::function<std::string()> reload = [] { return std::string("not possible"); };
  };

  /// `bell` is the one the pipeline rings. Throws std::system_error when there can be no event loop.
  Supervisor(Pipeline& pipeline, Doorbell& bell, ServiceManager& manager, Settings settings);

  /// Starts the pipeline, waits for its end or a signal, and stops it. While it stops for good a second signal ends the
  /// process; while it stops to be built anew signals wait for the next supervisor.
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
  int late_ticks_ = 0;  // in a row
  std::uint64_t ticks_ = 0;
  bool has_watchdog_ = false;
  bool settled_ = false;
  bool end_reported_ = false;
  bool reload_ = false;
  ProcessStatus process_;
  Status status_;
  SampleTrouble sample_trouble_ = SampleTrouble::none;  // that was reported
  bool told_slow_ = false;
  DeviceEvent event_;
};

}  // namespace azimuth
