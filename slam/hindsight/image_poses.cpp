#include "slam/hindsight/image_poses.hpp"

namespace azimuth {

void ImagePoses::add(Stamp stamp, const Mapper& mapper) {
  if (images_.empty() || images_.back().anchor != mapper.anchor()) keyframes_.push_back(images_.size());
  const Motion since = mapper.since_anchor();
  const Eigen::Matrix3d& P = since.covariance;
  images_.push_back({.stamp = stamp,
                     .T_anchor_body = since.T_start_end,
                     .covariance = {P(0, 0), P(1, 0), P(1, 1), P(2, 0), P(2, 1), P(2, 2)},
                     .anchor = mapper.anchor()});
}

Motion ImagePoses::since_anchor(const Image& image) {
  const std::array<double, 6>& P = image.covariance;
  Motion motion;
  motion.T_start_end = image.T_anchor_body;
  motion.covariance << P[0], P[1], P[3], P[1], P[2], P[4], P[3], P[4], P[5];
  return motion;
}

void ImagePoses::truncate(std::size_t size) {
  images_.resize(size);
  while (!keyframes_.empty() && keyframes_.back() >= size) keyframes_.pop_back();
}

void ImagePoses::write_path(const Mapper& mapper, std::vector<PathPose>& out) const {
  out.clear();
  for (const std::size_t at : keyframes_) {
    const Image& image = images_[at];
    if (const auto anchor = mapper.kept_pose(image.anchor)) out.push_back({image.stamp, *anchor * image.T_anchor_body});
  }
}

void ImagePoses::write(const Mapper& mapper, std::vector<PastPose>& out) const {
  out.clear();
  PoseNumber anchor = -1;
  PoseGaussian start;
  for (const Image& image : images_) {
    if (image.anchor != anchor) {
      anchor = image.anchor;
      start = mapper.past(anchor);
    }
    const MovedPose moved = apply(start.T_map_body, since_anchor(image));
    out.push_back({image.stamp, moved.T_map_body, moved.G * start.covariance * moved.G.transpose() + moved.noise});
  }
}

}  // namespace azimuth
