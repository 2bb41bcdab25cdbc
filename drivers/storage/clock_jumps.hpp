#pragma once
// Repairs recordings of a machine whose clock was set during the recording. The order of arrival tells which samples
// belong to which setting of the clock, and the stamps are shifted so that they continue without a jump.
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

/// The arrival of a sample at the recorder.
struct Arrival {
  std::uint64_t place = 0;  ///< number of the sample among all recorded samples
  Stamp recorded{};         ///< time on the recorder's clock, which may have been set as well
};

/// The samples of one kind in the order of their arrival.
struct ArrivedStamps {
  std::vector<Stamp> stamps;
  std::vector<Arrival> arrivals;  ///< same length as `stamps`
};

struct ClockJump {
  double at_s = 0.0;  ///< since the first odometry reading
  double by_s = 0.0;  ///< negative: the clock was set back
  /// The robot was at a different place after the jump: another drive, or a restarted simulation. Only one of the parts
  /// can be used.
  bool ends_drive = false;
  friend bool operator==(const ClockJump&, const ClockJump&) = default;
};

/// Describes a jump, e.g. "the clock was set back 3600.0 s at 27.0 s (what came later is moved by as much)".
std::string text(const ClockJump& jump);

/// The result of mend_clock_jumps(). `left_out[stream][sample]` marks the samples of parts that are not used, if there
/// are any.
struct MendedClocks {
  std::vector<ClockJump> jumps;
  std::vector<std::vector<bool>> left_out;  ///< empty: no sample is left out
};

/// Finds where the clock of the samples was set by more than a few sample intervals. A clock set back shows in the
/// order of the stamps; a clock set forward shows in a recording that continued without a gap. An outage, a single wild
/// stamp, and a few late samples are not clock jumps. All later stamps are shifted so that they continue. The odometry
/// is the first stream; stamps on a clock other than the odometry's are left alone, or shifted separately. `goes_on(i)`
/// tells whether odometry reading i continues the drive of the previous reading. Where it does not, only the longest
/// part is used, the same for all streams.
MendedClocks mend_clock_jumps(std::vector<ArrivedStamps>& streams, const std::function<bool(std::size_t)>& goes_on);

/// True: the robot can have moved from the previous pose to this one, given its motion around there.
bool odometry_goes_on(const std::vector<OdometryReading>& readings, std::size_t index);

/// Like mend_clock_jumps(), but changes the samples themselves. Removes the samples that are not used, and counts them.
/// `others` are tuples of arrivals, samples and count.
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
