#pragma once
// Recordings of a machine whose clock was set while it recorded: which samples are of which setting, by the order in
// which they came, and stamps that go on as if it had not been.
//
// Thread contract: reentrant.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "slam/sample/odometry.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// How a sample came to the recording.
struct Arrival {
  std::uint64_t place = 0;  ///< counts what was recorded, of all kinds
  Stamp recorded{};         ///< on the recorder's clock, which may have been set as well
};

/// The samples of one kind, in the order in which they came.
struct ArrivedStamps {
  std::vector<Stamp> stamps;
  std::vector<Arrival> arrivals;  ///< as many
};

struct ClockJump {
  double at_s = 0.0;  ///< since the first odometry reading
  double by_s = 0.0;  ///< negative: it was set back
  /// The robot was elsewhere after it: another drive, or a simulation that began anew. One part alone can be used.
  bool ends_drive = false;
  friend bool operator==(const ClockJump&, const ClockJump&) = default;
};

/// "the clock was set back 3600.0 s at 27.0 s (what came later is moved by as much)".
std::string text(const ClockJump& jump);

/// What mend_clock_jumps() found. Stamps were moved; `left_out[stream][sample]` are those of parts that are not used,
/// where there are any.
struct MendedClocks {
  std::vector<ClockJump> jumps;
  std::vector<std::vector<bool>> left_out;  ///< empty: none
};

/// Finds where the clock of the samples was set, by more than a few of their intervals: a set back shows in their
/// order, one forward in that the recording went on without a gap. An outage is none of these, nor is a single wild
/// stamp, or a few that came late. All later stamps are moved so that they go on; what is of another clock than the
/// odometry, which is the first stream, is left as it is, or moved by itself. `goes_on(i)` says whether odometry
/// reading i continues the drive of the one before. Where it does not, the longest part is used, of all streams the
/// same.
MendedClocks mend_clock_jumps(std::vector<ArrivedStamps>& streams, const std::function<bool(std::size_t)>& goes_on);

/// Whether the robot may have come from the one pose to the next, as it drives around there.
bool odometry_goes_on(const std::vector<OdometryReading>& readings, std::size_t index);

/// The same of samples in place, taking out what is not used and counting it: `others` are tuples of arrivals, samples
/// and count.
template <class... Others>
std::vector<ClockJump> mend_clock_jumps(const std::vector<Arrival>& arrivals, std::vector<OdometryReading>& odometry,
                                        std::uint64_t& gone, const Others&... others) {
  const auto stamps_of = [](const std::vector<Arrival>& came, const auto& samples) {
    ArrivedStamps arrived{{}, came};
    for (const auto& sample : samples) arrived.stamps.push_back(sample.stamp);
    return arrived;
  };
  std::vector<ArrivedStamps> streams{stamps_of(arrivals, odometry),
                                     stamps_of(std::get<0>(others), std::get<1>(others))...};
  const MendedClocks mended =
      mend_clock_jumps(streams, [&](std::size_t index) { return odometry_goes_on(odometry, index); });
  if (mended.jumps.empty()) return {};
  const auto use = [&mended, &streams](std::size_t stream, auto& samples, std::uint64_t& count) {
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i].stamp = streams[stream].stamps[i];
    if (mended.left_out.empty()) return;
    std::size_t index = 0;
    count += std::erase_if(samples, [&](const auto&) { return mended.left_out[stream][index++]; });
  };
  std::size_t stream = 0;
  use(stream, odometry, gone);
  (use(++stream, std::get<1>(others), std::get<2>(others)), ...);
  return mended.jumps;
}

}  // namespace azimuth
