#include "tests/equipment/usb_camera/camera_bench.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <ctime>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "base/clocks.hpp"
#include "tests/equipment/usb_camera/log_line.hpp"

namespace azimuth::sim {
namespace {

/// A command word with an optional number.
struct BenchCommand {
  std::string_view word;
  std::uint32_t count = 1;
  bool understood = true;
};

BenchCommand parse(std::string_view line) {
  BenchCommand command{line.substr(0, line.find(' '))};
  if (command.word.size() == line.size()) return command;
  const std::string_view rest = line.substr(command.word.size() + 1);
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), command.count);
  command.understood = error == std::errc{} && end == rest.data() + rest.size();
  return command;
}

timespec until(CameraBench::Clock::time_point when) {
  using std::chrono::nanoseconds;
  const auto now = CameraBench::Clock::now();
  const auto wait = when <= now ? nanoseconds{0} : std::min<nanoseconds>(when - now, std::chrono::hours(1));
  return {static_cast<time_t>(wait.count() / 1'000'000'000), static_cast<long>(wait.count() % 1'000'000'000)};
}

std::string answer(const std::optional<std::string>& error) { return error.value_or("done"); }

}  // namespace

int CameraBench::run(int signals) {
  if (const auto error = output_->plug()) {
    log_line("plug: " + *error);
    return 1;
  }
  log_line("plugged in");
  while (!ended_) wait_and_serve(signals);
  if (output_->plugged()) log_line("unplug: " + answer(output_->unplug()));
  log_line(status());
  return 0;
}

void CameraBench::wait_and_serve(int signals) {
  std::array<pollfd, 4> watched{pollfd{output_->descriptor(), POLLIN, 0}, pollfd{feed_->descriptor(), POLLIN, 0},
                                pollfd{console_open_ ? STDIN_FILENO : -1, POLLIN, 0}, pollfd{signals, POLLIN, 0}};
  const bool clock = paced_by_clock() && output_->plugged();
  const timespec wait = until(clock ? next_image_ : feed_->next_turn());
  if (::ppoll(watched.data(), watched.size(), &wait, nullptr) < 0) return;
  if (watched[0].revents != 0) output_->turn();
  const Clock::time_point now = Clock::now();
  if (clock && now >= next_image_) tick(now);
  if (!paced_by_clock() && feed_->turn(now)) make_image();
  if (watched[2].revents != 0) read_console();
  if (watched[3].revents != 0) ended_ = true;
}

/// Makes an image and schedules the next one. Missed periods are not made up for.
void CameraBench::tick(Clock::time_point now) {
  const auto period = clock_duration(1 / output_->rate_hz());
  next_image_ = std::max(next_image_ + period, now);
  make_image();
}

void CameraBench::make_image() {
  if (!output_->ready()) {
    late_ += output_->plugged() ? 1 : 0;
    return;
  }
  if (to_drop_ > 0) {
    --to_drop_;
    ++number_;
    return;
  }
  if (!feed_->fill(output_->shape(), number_, image_)) return;
  ++number_;
  ++images_;
  output_->send(image_, next_flaw());
}

ImageFlaw CameraBench::next_flaw() {
  if (to_cut_ > 0) {
    --to_cut_;
    return ImageFlaw::cut_short;
  }
  if (to_mark_ > 0) {
    --to_mark_;
    return ImageFlaw::marked_bad;
  }
  return ImageFlaw::none;
}

void CameraBench::read_console() {
  console_open_ = console_.read(STDIN_FILENO);
  while (const std::optional<std::string> line = console_.next()) {
    const std::string said = obey(*line);
    if (!said.empty()) log_line(*line + ": " + said);
  }
}

std::string CameraBench::obey(const std::string& line) {
  const BenchCommand command = parse(line);
  if (!command.understood) return "is not understood";
  if (command.word == "plug") return answer(output_->plug());
  if (command.word == "unplug") return answer(output_->unplug());
  if (command.word == "hang") return output_->hang() ? "done" : "this device knows no reset";
  if (command.word == "freeze" || command.word == "run") {
    output_->freeze(command.word == "freeze");
  } else if (command.word == "drop") {
    to_drop_ += command.count;
  } else if (command.word == "short") {
    to_cut_ += command.count;
  } else if (command.word == "error") {
    to_mark_ += command.count;
  } else if (command.word == "quit") {
    ended_ = true;
  } else if (command.word == "status") {
    std::puts(status().c_str());
    std::fflush(stdout);
    return {};
  } else {
    return "is not a command";
  }
  return "done";
}

std::string CameraBench::status() const {
  return fmt::format("{} images={} next={} not_ready={}{}", output_->status(), images_, number_, late_,
                     feed_->status());
}

}  // namespace azimuth::sim
