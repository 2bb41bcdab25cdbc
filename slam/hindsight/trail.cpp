#include "slam/hindsight/trail.hpp"

namespace azimuth {

void Trail::add(Stamp stamp, const Mapper& mapper) {
  images_.push_back({stamp, mapper.anchor(), mapper.since_anchor()});
}

void Trail::write(const Mapper& mapper, std::vector<PastPose>& out) const {
  out.clear();
  PoseId anchor = -1;
  PoseGaussian start;
  for (const Image& image : images_) {
    if (image.anchor != anchor) {
      anchor = image.anchor;
      start = mapper.past(anchor);
    }
    const MovedPose moved = apply(start.T_map_body, image.motion);
    out.push_back({image.stamp, moved.T_map_body, moved.G * start.covariance * moved.G.transpose() + moved.noise});
  }
}

}  // namespace azimuth
