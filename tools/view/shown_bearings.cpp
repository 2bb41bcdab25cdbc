#include "tools/view/shown_bearings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "slam/geometry/angle.hpp"
#include "tools/view/message_json.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::json;

/// The result of the data association normally arrives within a few milliseconds.
constexpr std::chrono::milliseconds kWaitForSightings{150};
constexpr double kStepsPerRadian = 1e5;

/// Tolerance for rounding errors of adding and subtracting an offset.
constexpr double kSameAngle_rad = 1e-9;

bool is_of(const Bearing& bearing, const sighting_t& sighting, double sense) {
  const auto same = [](double a, double b) { return std::abs(wrap(a - b)) < kSameAngle_rad; };
  const bool other_height = std::isfinite(sighting.elevation_rad) &&
                            std::abs(sighting.elevation_rad - bearing.elevation_rad) > kSameAngle_rad;
  return !other_height && same(sense * bearing.azimuth_rad, sighting.azimuth_rad);
}

std::string_view fate_of_others(std::size_t others, const std::optional<ImageCounts>& counts) {
  if (!counts) return "unknown";
  const std::array<std::pair<std::int64_t, std::string_view>, 4> kinds{{{counts->rejected, "refused"},
                                                                        {counts->ambiguous, "ambiguous"},
                                                                        {counts->thinned, "thinned"},
                                                                        {counts->created, "new"}}};
  const auto some = [](const auto& kind) { return kind.first != 0; };
  if (std::ranges::count_if(kinds, some) != 1) return "unknown";
  const auto& [number, word] = *std::ranges::find_if(kinds, some);
  return number == static_cast<std::int64_t>(others) ? word : "unknown";
}

}  // namespace

std::optional<ImageCounts> counts_of(const sightings_t* before, const sightings_t& now) {
  if (!before || now.step - before->step != 1) return std::nullopt;
  return ImageCounts{now.rejected - before->rejected, now.ambiguous - before->ambiguous, now.thinned - before->thinned,
                     now.created - before->created};
}

std::vector<BearingFate> fates_of(const BearingSet& set, const sightings_t& sightings,
                                  const std::optional<ImageCounts>& counts, bool clockwise) {
  const double sense = clockwise ? -1.0 : 1.0;
  std::vector<BearingFate> fates(set.bearings.size());
  std::size_t others = fates.size();
  for (const sighting_t& sighting : sightings.sightings) {
    for (std::size_t i = 0; i < fates.size(); ++i) {
      if (fates[i].landmark || !is_of(set.bearings[i], sighting, sense)) continue;
      fates[i] = {"used", sighting.landmark_id};
      --others;
      break;
    }
  }
  const std::string_view rest = fate_of_others(others, counts);
  for (BearingFate& fate : fates)
    if (!fate.landmark) fate.word = rest;
  return fates;
}

void ShownBearings::take(BearingSet set, Clock::time_point now) {
  set.descriptors.clear();
  set.neighbours.clear();
  set.bearings.resize(std::min(set.bearings.size(), most_));
  bearings_ = std::move(set);
  if (!std::exchange(pace_.waits, true)) wait_since_ = now;
}

void ShownBearings::take(const sightings_t& sightings) { sightings_before_ = std::exchange(sightings_, sightings); }

void ShownBearings::take_rig(const Rig* rig) {
  clockwise_ = rig && rig->camera.azimuths_clockwise;
  yaw_offset_rad_ = rig ? rig->camera.yaw_offset_rad : 0.0;
}

void ShownBearings::clear() {
  ShownBearings anew(most_);
  anew.clockwise_ = clockwise_;
  anew.yaw_offset_rad_ = yaw_offset_rad_;
  *this = std::move(anew);
}

bool ShownBearings::knows_fates() const {
  return bearings_ && sightings_ && sightings_->utime == to_us(bearings_->stamp);
}

ShownBearings::Clock::time_point ShownBearings::due() const {
  return knows_fates() ? pace_.next : std::max<Clock::time_point>(pace_.next, wait_since_ + kWaitForSightings);
}

/// Converts an azimuth to the robot's frame, if the rig is known.
double ShownBearings::in_robot_frame(double azimuth_rad) const {
  return wrap((clockwise_ ? -azimuth_rad : azimuth_rad) + yaw_offset_rad_);
}

/// Expected azimuths always grow counter-clockwise, independent of the direction of the bearings.
Json ShownBearings::expected() const {
  Json rows = Json::array();
  if (!expectations_ || expectations_->utime != to_us(bearings_->stamp)) return rows;
  for (const expected_bearing_t& each :
       std::span(expectations_->expected).first(std::min(most_, expectations_->expected.size())))
    rows.push_back({each.landmark_id, rounded_json(wrap(each.azimuth_rad + yaw_offset_rad_), kStepsPerRadian),
                    rounded_json(each.sigma_rad, kStepsPerRadian), rounded_json(each.elevation_rad, kStepsPerRadian),
                    rounded_json(each.gate_rad, kStepsPerRadian)});
  return rows;
}

Json ShownBearings::sent(Clock::time_point now) {
  pace_.sent(now);
  const auto fates =
      knows_fates() ? fates_of(*bearings_, *sightings_,
                               counts_of(sightings_before_ ? &*sightings_before_ : nullptr, *sightings_), clockwise_)
                    : std::vector<BearingFate>(bearings_->bearings.size());
  Json rows = Json::array();
  for (std::size_t i = 0; i < fates.size(); ++i) {
    const Bearing& bearing = bearings_->bearings[i];
    rows.push_back({number_json(in_robot_frame(bearing.azimuth_rad)), number_json(bearing.elevation_rad),
                    bearing.identity, bearing.kind, fates[i].word,
                    fates[i].landmark ? Json(*fates[i].landmark) : Json(nullptr)});
  }
  return {{"trouble", to_string(bearings_->trouble)}, {"bearings", std::move(rows)}, {"expected", expected()}};
}

}  // namespace azimuth
