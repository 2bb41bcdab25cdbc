#include "daemon/pipeline/played_source.hpp"

#include <utility>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// Longest sleep: the thread beats at least this often.
constexpr auto kNap = 100ms;

}  // namespace

PlayedSource::PlayedSource(Recording recording, double speed) : player_(std::move(recording), speed) {
  set_.bearings.reserve(kTypicalBearings);
}

bool PlayedSource::turn(Doorbell& bell, SourceWires& wires) {
  if (player_.over()) {
    bell.wait(kNap);
    return false;
  }
  const auto due_in = player_.due_in(RunPlayer::Clock::now(), kNap);
  if (due_in > 0ns) {
    bell.wait(due_in);
  } else if (hand_over(player_.peek(), wires)) {
    player_.advance();
  } else {
    bell.wait(kNap);
  }
  return true;
}

/// False: no room yet; the bell will ring.
bool PlayedSource::hand_over(const RunPlayer::Sample& sample, SourceWires& wires) {
  if (sample.bearings) {
    if (!wires.bearings) return true;  // they are found in the frames anew
    if (!wires.bearings->has_room()) return false;
    set_ = *sample.bearings;  // a copy: what goes round on the wires has room for more than the recording's own
    return wires.bearings->push(set_);
  }
  if (!wires.odometry.has_room()) return false;
  OdometryReading reading = *sample.odometry;
  return wires.odometry.push(reading);
}

}  // namespace azimuth
