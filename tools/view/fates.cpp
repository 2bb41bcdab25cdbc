#include "tools/view/fates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

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

}  // namespace azimuth
