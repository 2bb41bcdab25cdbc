// azimuth view: shows the robot or a recording in any browser.

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <poll.h>
#include <string>
#include <sys/signalfd.h>
#include <utility>
#include <vector>

#include "base/clocks.hpp"
#include "base/unique_fd.hpp"
#include "base/visible.hpp"
#include "drivers/lcm/lcm_receiver.hpp"
#include "drivers/storage/map_file.hpp"
#include "settings/configured_estimator.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/replay_outputs.hpp"
#include "tools/azimuth/view_options.hpp"
#include "tools/replay_page/page_map.hpp"
#include "tools/replay_page/page_run.hpp"
#include "tools/view/lcm_intake.hpp"

namespace azimuth {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds kLongestWait{500};
/// A running daemon sends a message within this time.
constexpr std::chrono::seconds kNothingAfter{3};

/// Blocks SIGTERM and SIGINT and returns a descriptor to poll for them.
UniqueFd stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  ::sigprocmask(SIG_BLOCK, &signals, nullptr);
  return UniqueFd(::signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC));
}

std::unique_ptr<HttpServer> opened(const ViewOptions& options, HttpHandler& handler) {
  auto server = HttpServer::open(http_settings(options), handler);
  if (!server) fail("azimuth view: " + server.error());
  return std::move(*server);
}

void say_address(const ViewOptions& options, const WindowSettings& window, const HttpServer& server,
                 const std::string& what) {
  fmt::print("{} is shown at {} (Ctrl-C ends that)\n", visible(what), address_of(options, window, server.port()));
  std::fflush(stdout);  // standard output may be a pipe whose reader waits
}

/// Timeout for poll() [ms]: at most until `due`; 0 if it is due.
int wait_ms(Clock::duration due) {
  const auto wait = std::clamp<Clock::duration>(due, Clock::duration::zero(), kLongestWait);
  return static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(wait).count());
}

/// Receives a running daemon's messages and serves them to browsers.
class LiveLoop {
 public:
  LiveLoop(const ViewOptions& options, WindowSettings window)
      : url_(options.lcm_url),
        view_("azimuth " AZIMUTH_VERSION, options.lcm_url, lookers_, Clock::now()),
        intake_(view_, options.replay.log.channel_prefix),
        receiver_(*parse_lcm_url(options.lcm_url), Duration{}),
        window_(std::move(window), view_, lookers_, Clock::now()),
        server_(opened(options, window_)) {}

  const HttpServer& server() const { return *server_; }

  /// Runs until a signal comes.
  void run(int signals) {
    for (;;) {
      pollfd ready[] = {{signals, POLLIN, 0}, {receiver_.descriptor(), POLLIN, 0}, {server_->descriptor(), POLLIN, 0}};
      ::poll(ready, 3, wait_ms(due_in(Clock::now())));
      if (ready[0].revents != 0) return;
      receiver_.turn(Clock::now(), intake_);
      view_.turn({Clock::now(), now_on(CLOCK_REALTIME).count()}, receiver_.state().trouble);
      tell_of_trouble();
      tell_of_nothing();
      server_->turn();
    }
  }

  /// Counts the messages that were shown and that were not, in a sentence for a person.
  std::string summary() const {
    std::string text = fmt::format("{} messages were shown", intake_.counts().messages);
    for (const auto& [channel, count] : intake_.counts().malformed)
      text += fmt::format("; {} on {} were none of that channel's", count, channel);
    if (intake_.counts().other_senders > 0)
      text += fmt::format("; {} came from a second daemon", intake_.counts().other_senders);
    if (receiver_.state().kernel_dropped > 0)
      text += fmt::format("; {} datagrams came too fast", receiver_.state().kernel_dropped);
    return text;
  }

 private:
  Clock::duration due_in(Clock::time_point now) const {
    const Clock::duration of_lcm = std::min(view_.next_turn(), receiver_.next_turn()) - now;
    return std::min(of_lcm, server_->due_in().value_or(kLongestWait));
  }

  void tell_of_trouble() {
    if (receiver_.state().trouble == told_trouble_) return;
    told_trouble_ = receiver_.state().trouble;
    print_error("azimuth view: " + (told_trouble_.empty() ? "LCM can be heard again" : told_trouble_));
  }

  /// Prints once, if no message comes, what must run to send messages.
  void tell_of_nothing() {
    const bool told_why = !told_trouble_.empty();
    if (told_of_nothing_ || told_why || intake_.counts().messages > 0 || Clock::now() - began_ < kNothingAfter) return;
    told_of_nothing_ = true;
    print_error("azimuth view: nothing has come from azimuthd yet on " + url_ +
                "; start it (`systemctl start azimuthd`, or without a robot `azimuthd --play RUN`). If it runs, both "
                "need one LCM address and prefix (--lcm-url, --prefix), with ttl=1 between machines; `azimuth doctor` "
                "looks what is wrong here");
  }

  std::string url_;
  Clock::time_point began_ = Clock::now();
  bool told_of_nothing_ = false;
  Lookers lookers_;
  LiveView view_;
  LcmIntake intake_;
  LcmReceiver receiver_;
  LiveWindow window_;
  std::unique_ptr<HttpServer> server_;
  std::string told_trouble_;
};

void show_live(const ViewOptions& options) {
  const UniqueFd signals = stop_signals();
  const WindowSettings window = window_settings(options);
  LiveLoop loop(options, window);
  say_address(options, window, loop.server(), "what azimuthd sends on " + options.lcm_url);
  loop.run(signals.get());
  print_error("azimuth view: " + loop.summary());
}

bool is_map(const std::filesystem::path& file) { return file.extension() == ".azmap"; }

Json map_page(const std::filesystem::path& file) {
  const FileResult<LoadedMap> loaded = read_map(file);
  if (!loaded) refuse(loaded.error());
  if (!loaded->troubles.empty())
    std::fputs((text(loaded->troubles) + "; used " + shown(loaded->file) + '\n').c_str(), stderr);
  return page_of_map(loaded->map, file.filename().string());
}

/// The page of a run. A run that ends lost is shown, too.
Json run_page(const ViewOptions& options, const std::filesystem::path& file) {
  ReplayOptions given = options.replay;
  given.run = file;
  const ReplaySetup setup = replay_setup(given);
  HtmlOutput page(options.page, options.recordings.size());
  const ReplayResult result = replay_with(setup, page.watch(setup));
  const Report report = report_of(
      setup, result, name(chosen_estimator(setup.rig, setup.configuration, setup.map ? &setup.map->map : nullptr)), {});
  page.add(setup, result, report);
  if (page.runs().empty())
    refuse(file.string() + ": no step was made" +
           (report.input_trouble.empty() ? std::string() : ": " + report.input_trouble));
  return page.runs().front();
}

/// Returns the data of the page of the recordings, as JSON. Refuses recordings that cannot be read, and runs without a
/// step.
std::string recorded_page(const ViewOptions& options) {
  std::vector<Json> runs;
  for (const std::filesystem::path& file : options.recordings)
    runs.push_back(is_map(file) ? map_page(file) : run_page(options, file));
  return page_data(runs, "azimuth " AZIMUTH_VERSION);
}

void show_recorded(const ViewOptions& options) {
  const WindowSettings settings = window_settings(options);
  RecordedWindow window(settings, recorded_page(options), Clock::now());
  const UniqueFd signals = stop_signals();  // only now, so that Ctrl-C stops a long replay
  const std::unique_ptr<HttpServer> server = opened(options, window);
  say_address(options, settings, *server, options.recordings.size() == 1 ? "the recording" : "both recordings");
  for (;;) {
    pollfd ready[] = {{signals.get(), POLLIN, 0}, {server->descriptor(), POLLIN, 0}};
    ::poll(ready, 2, wait_ms(server->due_in().value_or(kLongestWait)));
    if (ready[0].revents != 0) return;
    server->turn();
  }
}

}  // namespace

void add_view_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("view", "Show the robot or a recording in any browser");
  const auto options = std::make_shared<ViewOptions>();
  add_view_options(*command, *options);
  command->footer(
      "The command never sends anything to the robot. Exit codes: 0 stopped by a signal, 1 the address cannot be "
      "listened on, 2 wrong use or input.");
  command->callback([command, options] {
    check(*command, *options);
    options->is_live() ? show_live(*options) : show_recorded(*options);
  });
}

}  // namespace azimuth
