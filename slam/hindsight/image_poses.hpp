#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "slam/estimator/past_pose.hpp"
#include "slam/hindsight/mapper.hpp"

namespace azimuth {

/// Where each image was taken, by the pose of the graph before it: so that it can be told again when that has moved.
///
/// Thread contract: thread-bound.
class ImagePoses {
 public:
  /// The image of the mapper's last update().
  void add(Stamp stamp, const Mapper& mapper);
  std::size_t size() const { return images_.size(); }
  /// Forgets all but the first so many.
  void truncate(std::size_t size);
  /// All of them, as they are known now.
  void write(const Mapper& mapper, std::vector<PastPose>& out) const;
  /// The first image behind each pose of the graph, by the likeliest path.
  void write_path(const Mapper& mapper, std::vector<PathPose>& out) const;

 private:
  /// There are many, so of the motion there is only what is needed.
  struct Image {
    Stamp stamp{};
    Pose2 T_anchor_body;
    std::array<double, 6> covariance{};  ///< lower triangle
    PoseNumber anchor = 0;
  };
  static Motion since_anchor(const Image& image);

  std::vector<Image> images_;
  std::vector<std::size_t> keyframes_;  // first image behind each pose of the graph that has one
};

}  // namespace azimuth
