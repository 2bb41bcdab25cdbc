#pragma once
#include <azimuth/sightings_t.hpp>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Result of the data association of a bearing.
struct BearingFate {
  std::string_view word = "unknown";  ///< "used", "refused", "new", "ambiguous", "thinned"
  std::optional<std::int64_t> landmark;
};

/// Numbers of bearings of one image by the estimator's counters.
struct ImageCounts {
  std::int64_t rejected = 0, ambiguous = 0, thinned = 0, created = 0;
};

/// The counts for the image of `now`: the differences from the message of the previous step. Nothing if that message is
/// missing.
std::optional<ImageCounts> counts_of(const sightings_t* before, const sightings_t& now);

/// One fate for each bearing of the set. A bearing contained in `sightings` was used. For the others, only the numbers
/// in `counts` are known: if a single kind accounts for all of them, each has that fate, otherwise "unknown".
/// `clockwise`: azimuths of the bearings grow clockwise (rig.toml). Reentrant.
std::vector<BearingFate> fates_of(const BearingSet& set, const sightings_t& sightings,
                                  const std::optional<ImageCounts>& counts, bool clockwise);

}  // namespace azimuth
