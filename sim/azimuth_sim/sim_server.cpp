#include "sim/azimuth_sim/sim_server.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <unistd.h>
#include <utility>

#include "base/clocks.hpp"

namespace azimuth::sim {
namespace {

using namespace std::chrono_literals;

/// Bytes of a burst are transferred in batches of this length, as by USB adapters; the first byte of a burst is on
/// time.
constexpr auto kBatch = 1ms;
constexpr auto kReplugRetry = 100ms;
constexpr Duration kStatusPeriod = 10s;

sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  return signals;
}

/// Carrier of a robot without a serial line: there is no client, and bytes sent are lost.
class NoCarrier final : public Carrier {
 public:
  explicit NoCarrier(std::string address) : address_(std::move(address)) {}

  FileResult<void> plug_in() override { return {}; }
  void unplug() override {}
  void watch(std::vector<pollfd>&) const override {}
  std::chrono::milliseconds patience() const override { return std::chrono::milliseconds(1000); }
  void turn(Bytes&) override {}
  void send(pioneer::ByteView) override {}
  bool has_client() const override { return false; }
  std::optional<int> client_baud() const override { return {}; }
  std::string address() const override { return address_; }

 private:
  std::string address_;
};

std::unique_ptr<Carrier> make_carrier(const Options& options) {
  if (!options.device.empty()) return std::make_unique<PtyCarrier>(options.device);
  if (options.tcp_port) return std::make_unique<TcpCarrier>(*options.tcp_port);
  return std::make_unique<NoCarrier>(options.can_interface);
}

std::string rig_text(const Options& options) {
  return options.images ? image_rig_toml(options.simulation.scenario, *options.images) : std::string{};
}

timespec to_timespec(std::chrono::nanoseconds duration) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(duration);
  return {.tv_sec = seconds.count(), .tv_nsec = (duration - seconds).count()};
}

}  // namespace

void block_stop_signals() {
  const sigset_t signals = stop_signals();
  ::sigprocmask(SIG_BLOCK, &signals, nullptr);
}

FileResult<SimDevices> open_devices(const Options& options, std::unique_ptr<FrameSource> frames) {
  std::unique_ptr<Carrier> carrier = make_carrier(options);
  if (auto plugged = carrier->plug_in(); !plugged) return failure(plugged.error());
  FileResult<RunFiles> files = RunFiles::create(options.files, options.simulation.scenario, rig_text(options));
  if (!files) return failure(files.error());
  SimDevices devices{std::move(carrier), *std::move(files), std::nullopt, std::nullopt};
  if (!options.can_interface.empty()) {
    auto opened = devices.can.emplace(options.can_interface).open();
    if (!opened) return failure(opened.error());
  }
  if (options.camera_socket.empty()) return devices;
  FileResult<CameraLink> camera = CameraLink::listen(options.camera_socket, std::move(frames));
  if (!camera) return failure(camera.error());
  devices.camera.emplace(*std::move(camera));
  return devices;
}

SimServer::SimServer(const Options& options, SimDevices devices)
    : options_(options),
      devices_(std::move(devices)),
      simulation_(options.simulation),
      console_(simulation_),
      lines_([this](const std::string& line) { return console_.obey(line, now_); }),
      clock_(Monotonic::now(), epoch_minus_monotonic(), options.speed) {
  const sigset_t signals = stop_signals();
  signals_ = UniqueFd(::signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC));
  told_.baud = simulation_.pioneer().firmware().baud();
  for (const Fault& fault : options.faults) fault.apply(simulation_.pioneer());
}

FileResult<void> SimServer::run() {
  ::prctl(PR_SET_TIMERSLACK, 1UL);  // Bytes must leave when they are due
  lines_.open_standard_input();
  if (!options_.control_socket.empty()) {
    if (auto opened = lines_.open_socket(options_.control_socket); !opened) return opened;
  }
  tell("robot at " + devices_.carrier->address());
  while (!over()) {
    turn();
    wait();
  }
  tell(fmt::format("ended: {}", status_text(simulation_, now_)));
  return devices_.files.finish();
}

bool SimServer::over() const {
  const bool time_is_up = options_.duration_s > 0.0 && to_seconds(now_) >= options_.duration_s;
  const bool arrived = options_.end_at_arrival && simulation_.rover().arrived();
  return stopped_ || console_.wants_to_quit() || time_is_up || arrived;
}

PacedClock::Monotonic::time_point SimServer::wake_at() const {
  Stamp due = simulation_.due();
  if (options_.duration_s > 0.0) due = std::min(due, Stamp(duration_from_seconds(options_.duration_s)));
  auto wake = std::max(clock_.to_monotonic(due), last_sent_ + kBatch);
  if (devices_.camera && devices_.camera->busy()) wake = Monotonic::now();
  if (!plugged_) wake = std::min(wake, Monotonic::now() + kReplugRetry);
  return std::min<Monotonic::time_point>(wake, Monotonic::now() + devices_.carrier->patience());
}

void SimServer::wait() {
  watched_.clear();
  watched_.push_back({signals_.get(), POLLIN, 0});
  if (devices_.camera) watched_.push_back({devices_.camera->descriptor(), POLLIN, 0});
  devices_.carrier->watch(watched_);
  lines_.watch(watched_);
  const auto left = std::max<std::chrono::nanoseconds>(wake_at() - Monotonic::now(), 0ns);
  const timespec limit = to_timespec(left);
  if (::ppoll(watched_.data(), watched_.size(), &limit, nullptr) <= 0) return;
  read_signals();
  lines_.turn(watched_);
}

void SimServer::read_signals() {
  signalfd_siginfo info{};
  stopped_ = stopped_ || ::read(signals_.get(), &info, sizeof info) == sizeof info;
}

void SimServer::turn() {
  now_ = std::max(now_, clock_.to_virtual(Monotonic::now()));
  exchange_bytes();
  follow_plug();
  hand_out();
  tell_changes();
}

void SimServer::exchange_bytes() {
  SimulatedPioneer& pioneer = simulation_.pioneer();
  from_client_.clear();
  devices_.carrier->turn(from_client_);
  pioneer.set_client_baud(devices_.carrier->client_baud());
  simulation_.advance(now_, output_);
  if (!from_client_.empty()) pioneer.client_sends(from_client_, now_);
  to_client_.clear();
  pioneer.take_bytes(to_client_);
  if (to_client_.empty()) return;
  devices_.carrier->send(to_client_);
  last_sent_ = Monotonic::now();
}

void SimServer::follow_plug() {
  if (simulation_.pioneer().plugged_in()) {
    plugged_ = devices_.carrier->plug_in();
  } else {
    devices_.carrier->unplug();
  }
}

void SimServer::hand_out() {
  if (devices_.camera) {
    devices_.camera->turn();
    devices_.camera->send(output_, clock_);
  }
  if (devices_.can) devices_.can->send(output_.can_frames);
  devices_.files.add(output_, clock_);
  for (const Fault& fault : output_.faults) tell("fault " + fault.text());
  output_.clear();
}

void SimServer::tell_changes() {
  const Firmware& firmware = simulation_.pioneer().firmware();
  const Told now{
      devices_.carrier->has_client(), firmware.in_session(), simulation_.pioneer().plugged_in(),
      simulation_.rover().arrived(),  firmware.baud(),       plugged_ ? "" : plugged_.error().front().text()};
  if (now.plugged != told_.plugged) tell(now.plugged ? "plugged in again" : "unplugged");
  if (now.client != told_.client) tell(now.client ? "a client is here" : "the client is gone");
  if (now.session != told_.session) tell(now.session ? "session open" : "session over");
  if (now.baud != told_.baud) tell(fmt::format("{} baud", now.baud));
  if (now.arrived != told_.arrived) tell("at the end of the path");
  if (now.trouble != told_.trouble && !now.trouble.empty()) fmt::print(stderr, "azimuth-sim: {}\n", now.trouble);
  told_ = now;
  if (!options_.verbose || now_ < next_status_) return;
  next_status_ = now_ + kStatusPeriod;
  tell(status_text(simulation_, now_));
}

void SimServer::tell(const std::string& news) const {
  if (options_.quiet) return;
  const bool ends = news.ends_with('\n');
  fmt::print("[{:9.3f}] {}{}", to_seconds(now_), news, ends ? "" : "\n");
  std::fflush(stdout);
}

}  // namespace azimuth::sim
