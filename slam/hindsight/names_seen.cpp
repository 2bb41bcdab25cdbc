#include "slam/hindsight/names_seen.hpp"

#include <algorithm>

#include "slam/lost/lost_robot.hpp"

namespace azimuth {
void NamesSeen::add(const BearingSet& image, double path_m) {
  Image& kept = images_[next_++ % kImages];
  kept.path_m = path_m;
  kept.names.clear();
  for (const Bearing& bearing : image.bearings)
    if (bearing.identity != kUnknownIdentity) kept.names.push_back(bearing.identity);
  passed_over_ = 0;
}

bool NamesSeen::is_due(Identity name, double path_m) const {
  if (passed_over_ >= kImages) return false;
  return std::ranges::any_of(images_, [&](const Image& image) {
    return path_m - image.path_m < kMoment_m && std::ranges::find(image.names, name) != image.names.end();
  });
}

}  // namespace azimuth
