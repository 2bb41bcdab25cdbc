#include "drivers/storage/clock_jumps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <utility>

namespace azimuth {
namespace {

constexpr std::size_t kLook = 8;      // samples examined on each side of a possible clock jump
constexpr std::size_t kEnough = 3;    // samples of these that must agree; fewer are wild or late stamps
constexpr std::size_t kLookFar = 50;  // samples over which a lead must stay the same
constexpr std::size_t kBorder = 20;   // odometry readings near a jump, where samples of both settings may occur
constexpr Duration kLeastForward{1'000'000};

using Durations = std::vector<Duration>;

std::optional<Duration> median(Durations values) {
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The median of the intervals; zero when there are none.
template <class Stamps, class StampOf>
Duration usual_interval(const Stamps& stamps, StampOf stamp_of) {
  Durations intervals;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const Duration interval = stamp_of(stamps[i]) - stamp_of(stamps[i - 1]);
    if (interval > Duration{}) intervals.push_back(interval);
  }
  return median(std::move(intervals)).value_or(Duration{});
}

Duration usual_interval(const std::vector<Stamp>& stamps) {
  return usual_interval(stamps, [](Stamp stamp) { return stamp; });
}

std::size_t look_back(std::size_t i, std::size_t count) { return i - std::min(i, count); }
std::size_t look_ahead(std::size_t i, std::size_t count, std::size_t size) { return std::min(i + count, size); }

/// True: the stamps are set back from `i` on. A single wild stamp, or a few late samples, do not count.
bool is_set_back(const std::vector<Stamp>& stamps, std::size_t i) {
  if (stamps[i] > stamps[i - 1]) return false;
  const auto begin = stamps.begin();
  const auto at = [&](std::size_t index) { return begin + static_cast<std::ptrdiff_t>(index); };
  const auto above = std::count_if(at(look_back(i, kLook)), at(i), [&](Stamp each) { return each > stamps[i]; });
  const auto below =
      std::count_if(at(i), at(look_ahead(i, kLook, stamps.size())), [&](Stamp each) { return each <= stamps[i - 1]; });
  return std::min(above, below) >= static_cast<std::ptrdiff_t>(kEnough);
}

/// True: the stamps jump ahead at `i` while a reference continues. `leads` is the lead of each stamp over the
/// reference.
bool is_set_forward(const std::vector<Stamp>& stamps, const Durations& leads, std::size_t i, Duration interval) {
  const Duration leap = stamps[i] - stamps[i - 1];
  if (leap < std::max(kLeastForward, 10 * interval)) return false;
  const std::size_t end = look_ahead(i, kLook, stamps.size());
  if (end - i < kEnough || i < kEnough) return false;
  const auto begin = leads.begin();
  const auto at = [&](std::size_t index) { return begin + static_cast<std::ptrdiff_t>(index); };
  const Duration before = *std::max_element(at(look_back(i, kLookFar)), at(i));
  const Duration after = *std::min_element(at(i), at(end));
  return after - before > leap / 2;
}

/// A jump of a clock, as found in one stream.
struct Setting {
  std::size_t index = 0;    // index in the stream of the first sample after the jump
  std::uint64_t place = 0;  // number of this sample among all recorded samples
  Duration by{};            // negative: the clock was set back
};

Durations leads_over_recorder(const ArrivedStamps& stream) {
  Durations leads;
  leads.reserve(stream.stamps.size());
  for (std::size_t i = 0; i < stream.stamps.size(); ++i)
    leads.push_back(stream.stamps[i] - stream.arrivals[i].recorded);
  return leads;
}

/// True: the recorder's times are times of arrival.
bool tells_arrivals(const ArrivedStamps& stream, Duration interval) {
  const Duration recorded = usual_interval(stream.arrivals, [](const Arrival& each) { return each.recorded; });
  return 2 * recorded >= interval && recorded <= 2 * interval;
}

/// Finds the jumps of the odometry, which arrives at even intervals. The recorder's clock shows where the recording
/// continued without a gap.
std::vector<Setting> settings_of(const ArrivedStamps& stream) {
  std::vector<Setting> settings;
  const Duration interval = usual_interval(stream.stamps);
  const bool recorder = tells_arrivals(stream, interval);
  const Durations leads = recorder ? leads_over_recorder(stream) : Durations{};
  for (std::size_t i = 1; i < stream.stamps.size(); ++i) {
    const bool is_jump =
        is_set_back(stream.stamps, i) || (recorder && is_set_forward(stream.stamps, leads, i, interval));
    if (!is_jump) continue;
    const Duration waited = stream.arrivals[i].recorded - stream.arrivals[i - 1].recorded;
    const bool was_away = recorder && waited > 3 * interval;
    const Duration step = stream.stamps[i] - stream.stamps[i - 1];
    settings.push_back({i, stream.arrivals[i].place, step - (was_away ? waited : interval)});
  }
  return settings;
}

/// The odometry as the reference for the other streams.
class Reference {
 public:
  Reference(const ArrivedStamps& odometry, std::vector<Setting> settings)
      : odometry_(odometry), moved_(odometry.stamps), settings_(std::move(settings)) {
    Duration sum{};
    for (std::size_t i = 0, next = 0; i < moved_.size(); ++i) {
      if (next < settings_.size() && settings_[next].index == i) sum += settings_[next++].by;
      moved_[i] -= sum;
    }
  }

  const std::vector<Stamp>& moved() const { return moved_; }
  const std::vector<Setting>& settings() const { return settings_; }
  /// The odometry's last stamp when the sample at `place` arrived, and that stamp after its shift.
  Stamp said_at(std::uint64_t place) const { return odometry_.stamps[index_at(place)]; }
  Stamp moved_at(std::uint64_t place) const { return moved_[index_at(place)]; }
  /// Number of jumps that certainly came before the sample at `place`, and number of those that may have.
  std::pair<std::size_t, std::size_t> settings_before(std::uint64_t place) const {
    std::size_t surely = 0, perhaps = 0;
    const std::size_t last = odometry_.arrivals.size() - 1;
    for (const Setting& setting : settings_) {
      if (place >= odometry_.arrivals[std::min(setting.index + kBorder, last)].place) ++surely;
      if (place >= odometry_.arrivals[look_back(setting.index, kBorder)].place) ++perhaps;
    }
    return {surely, std::max(surely, perhaps)};
  }

 private:
  std::size_t index_at(std::uint64_t place) const {
    const auto after = std::ranges::upper_bound(odometry_.arrivals, place, {}, &Arrival::place);
    return after == odometry_.arrivals.begin() ? 0 : static_cast<std::size_t>(after - odometry_.arrivals.begin()) - 1;
  }

  const ArrivedStamps& odometry_;
  std::vector<Stamp> moved_;
  std::vector<Setting> settings_;
};

/// True: the stream and the odometry arrived interleaved. They did not if a program has sorted the recording by stream.
bool came_together(const ArrivedStamps& stream, const Reference& reference, std::size_t readings) {
  std::size_t different = 1;
  for (std::size_t i = 1; i < stream.arrivals.size(); ++i)
    if (reference.moved_at(stream.arrivals[i].place) != reference.moved_at(stream.arrivals[i - 1].place)) ++different;
  return 4 * different >= std::min(readings, stream.arrivals.size());
}

/// Median lead of the samples from `begin` to `end` over `reference(place)`.
template <class ReferenceAt>
std::optional<Duration> lead(const ArrivedStamps& stream, std::size_t begin, std::size_t end, ReferenceAt reference) {
  Durations leads;
  for (std::size_t i = begin; i < end; ++i) leads.push_back(stream.stamps[i] - reference(stream.arrivals[i].place));
  return median(std::move(leads));
}

/// True: the stream has the odometry's clock, because it keeps its lead over the odometry across a jump. Also true if
/// it has no samples on one side.
bool has_setting(const ArrivedStamps& stream, const Reference& reference, const Setting& setting) {
  const auto first = std::ranges::lower_bound(stream.arrivals, setting.place, {}, &Arrival::place);
  const auto index = static_cast<std::size_t>(first - stream.arrivals.begin());
  const auto said = [&](std::uint64_t place) { return reference.said_at(place); };
  const auto before = lead(stream, look_back(index, kBorder), index, said);
  const auto after = lead(stream, index, look_ahead(index, kBorder, stream.stamps.size()), said);
  return !before || !after || std::chrono::abs(*after - *before) <= std::chrono::abs(setting.by) / 2;
}

/// Shifts a stream on the odometry's clock like the odometry. Near a jump, a sample belongs to the setting that brings
/// it closer to the odometry.
void move_with(const Reference& reference, ArrivedStamps& stream) {
  Durations sums{Duration{}};
  for (const Setting& setting : reference.settings())
    sums.push_back(sums.back() + (has_setting(stream, reference, setting) ? setting.by : Duration{}));
  for (std::size_t i = 0; i < stream.stamps.size(); ++i) {
    const std::uint64_t place = stream.arrivals[i].place;
    const Stamp now = reference.moved_at(place), said = stream.stamps[i];
    const auto [surely, perhaps] = reference.settings_before(place);
    const auto off = [&](Duration sum) { return std::chrono::abs(said - sum - now); };
    const auto best = std::ranges::min_element(sums.begin() + static_cast<std::ptrdiff_t>(surely),
                                               sums.begin() + static_cast<std::ptrdiff_t>(perhaps) + 1, {}, off);
    stream.stamps[i] = said - *best;
  }
}

/// Shifts a stream on a clock of its own, with the odometry as the reference.
void move_alone(const Reference& reference, ArrivedStamps& stream, std::vector<Setting>& found) {
  const auto moved = [&](std::uint64_t place) { return reference.moved_at(place); };
  const Duration interval = usual_interval(stream.stamps);
  Durations leads;
  for (std::size_t i = 0; i < stream.stamps.size(); ++i)
    leads.push_back(stream.stamps[i] - moved(stream.arrivals[i].place));
  for (std::size_t i = 1; i < stream.stamps.size(); ++i) {
    if (!is_set_back(stream.stamps, i) && !is_set_forward(stream.stamps, leads, i, interval)) continue;
    const auto side = [&](std::size_t begin, std::size_t end) {
      return *median(
          {leads.begin() + static_cast<std::ptrdiff_t>(begin), leads.begin() + static_cast<std::ptrdiff_t>(end)});
    };
    const Duration by = side(i, look_ahead(i, kBorder, stream.stamps.size())) - side(look_back(i, kBorder), i);
    for (std::size_t j = i; j < stream.stamps.size(); ++j) {
      stream.stamps[j] -= by;
      leads[j] -= by;
    }
    found.push_back({i, stream.arrivals[i].place, by});
  }
}

/// Limits the stamps, which can have any value in a damaged recording, to about a thousand years around 1970, so that
/// differences do not overflow.
void keep_in_range(std::vector<ArrivedStamps>& streams) {
  constexpr Stamp kLatest{Duration{std::int64_t{1} << 55U}}, kEarliest{-kLatest.time_since_epoch()};
  for (ArrivedStamps& stream : streams) {
    for (Stamp& stamp : stream.stamps) stamp = std::clamp(stamp, kEarliest, kLatest);
    for (Arrival& arrival : stream.arrivals) arrival.recorded = std::clamp(arrival.recorded, kEarliest, kLatest);
  }
}

/// Among the parts between jumps that end a drive, selects the one with the most odometry.
class Parts {
 public:
  Parts(const ArrivedStamps& odometry, const std::vector<Setting>& settings, const std::vector<bool>& ends_drive) {
    std::size_t begin = 0, longest = 0;
    const auto close = [&](std::size_t end) {
      if (end - begin > longest) {
        longest = end - begin;
        first_ = begin == 0 ? 0 : odometry.arrivals[begin].place;
        end_ = end == odometry.arrivals.size() ? UINT64_MAX : odometry.arrivals[end].place;
      }
      begin = end;
    };
    for (std::size_t i = 0; i < settings.size(); ++i)
      if (ends_drive[i]) close(settings[i].index);
    close(odometry.arrivals.size());
  }
  std::vector<bool> left_out(const ArrivedStamps& stream) const {
    std::vector<bool> out;
    for (const Arrival& arrival : stream.arrivals) out.push_back(arrival.place < first_ || arrival.place >= end_);
    return out;
  }

 private:
  std::uint64_t first_ = 0, end_ = UINT64_MAX;
};

}  // namespace

std::string text(const ClockJump& jump) {
  std::array<char, 160> words{};
  std::snprintf(words.data(), words.size(), "the clock was set %s %.1f s at %.1f s (%s)",
                jump.by_s < 0.0 ? "back" : "forward", std::abs(jump.by_s), jump.at_s,
                jump.ends_drive ? "and odometry is elsewhere after it: only the longest part is used"
                                : "what came later is moved by as much");
  return words.data();
}

bool odometry_goes_on(const std::vector<OdometryReading>& readings, std::size_t index) {
  constexpr double kSlack_m = 0.3;
  if (readings[index].origin != readings[index - 1].origin) return true;  // the odometer itself reports its restart
  const auto step_m = [&](std::size_t i) {
    return (readings[i].T_odom_body.position() - readings[i - 1].T_odom_body.position()).norm();
  };
  double longest_m = 0.0;
  const std::size_t end = look_ahead(index, kBorder, readings.size());
  for (std::size_t i = std::max<std::size_t>(look_back(index, kBorder), 1); i < end; ++i)
    if (i != index) longest_m = std::max(longest_m, step_m(i));
  return step_m(index) <= kSlack_m + 3.0 * longest_m;
}

MendedClocks mend_clock_jumps(std::vector<ArrivedStamps>& streams, const std::function<bool(std::size_t)>& goes_on) {
  keep_in_range(streams);
  MendedClocks mended;
  ArrivedStamps& odometry = streams.front();
  if (odometry.stamps.empty()) return mended;
  const Stamp start = odometry.stamps.front();
  const Reference reference(odometry, settings_of(odometry));
  const auto tell = [&](const Setting& setting, bool ends_drive) {
    mended.jumps.push_back({to_seconds(reference.moved_at(setting.place) - start), to_seconds(setting.by), ends_drive});
  };
  std::vector<bool> ends_drive;
  for (const Setting& setting : reference.settings()) {
    ends_drive.push_back(!goes_on(setting.index));
    tell(setting, ends_drive.back());
  }
  for (ArrivedStamps& stream : std::span(streams).subspan(1)) {
    if (stream.stamps.empty() || !came_together(stream, reference, odometry.stamps.size())) continue;
    move_with(reference, stream);
    std::vector<Setting> own;
    move_alone(reference, stream, own);
    for (const Setting& setting : own) tell(setting, false);
  }
  if (std::ranges::count(ends_drive, true) > 0) {
    const Parts parts(odometry, reference.settings(), ends_drive);
    for (const ArrivedStamps& stream : streams) mended.left_out.push_back(parts.left_out(stream));
  }
  odometry.stamps = reference.moved();
  return mended;
}

}  // namespace azimuth
