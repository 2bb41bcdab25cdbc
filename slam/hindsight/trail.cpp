#include "slam/hindsight/trail.hpp"

namespace azimuth {

void Trail::add(Stamp stamp, const Mapper& mapper) {
  if (images_.empty() || images_.back().anchor != mapper.anchor()) keyframes_.push_back(images_.size());
  images_.push_back({stamp, mapper.anchor(), mapper.since_anchor()});
}

void Trail::truncate(std::size_t size) {
  images_.resize(size);
  while (!keyframes_.empty() && keyframes_.back() >= size) keyframes_.pop_back();
}

void Trail::write_path(const Mapper& mapper, std::vector<PathPose>& out) const {
  out.clear();
  const BearingGraph& graph = mapper.smoother().graph();
  for (const std::size_t at : keyframes_) {
    const Image& image = images_[at];
    out.push_back({image.stamp, graph.pose(image.anchor) * image.motion.T_start_end});
  }
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
