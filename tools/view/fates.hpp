#pragma once
#include <azimuth/sightings_t.hpp>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "slam/sample/bearings.hpp"

namespace azimuth {

/// What became of a bearing.
struct BearingFate {
  std::string_view word = "unknown";  ///< "used", "refused", "new", "ambiguous", "thinned"
  std::optional<std::int64_t> landmark;
};

/// What the estimator's counts say of one image.
struct ImageCounts {
  std::int64_t rejected = 0, ambiguous = 0, thinned = 0, created = 0;
};

/// Of the image of `now`, from the message of the step before; nothing when that was lost.
std::optional<ImageCounts> counts_of(const sightings_t* before, const sightings_t& now);

/// One for each bearing of the set. A bearing that is among the sightings was used. Of the others only numbers are
/// known: where one number accounts for all of them each has that fate, else nobody can tell. `clockwise`: bearings
/// come with azimuths that grow to the right (rig.toml). Reentrant.
std::vector<BearingFate> fates_of(const BearingSet& set, const sightings_t& sightings,
                                  const std::optional<ImageCounts>& counts, bool clockwise);

}  // namespace azimuth
