#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "slam/estimator/estimate.hpp"
#include "slam/hindsight/mapper.hpp"

namespace azimuth {

/// The pose of each image, stored relative to the graph's pose before it, so that it can be recomputed after the
/// graph's poses have moved.
///
/// Thread contract: thread-bound.
class ImagePoses {
 public:
  /// Adds the image of the mapper's last update().
  void add(Stamp stamp, const Mapper& mapper);
  std::size_t size() const { return images_.size(); }
  /// Removes all but the first `size` images.
  void truncate(std::size_t size);
  /// Writes the current estimates of all poses.
  void write(const Mapper& mapper, std::vector<PastPose>& out) const;
  /// Writes the most likely pose of the first image after each pose of the graph.
  void write_path(const Mapper& mapper, std::vector<PathPose>& out) const;

 private:
  /// A compact entry without the parts of the motion that are not needed.
  struct Image {
    Stamp stamp{};
    Pose2 T_anchor_body;
    std::array<double, 6> covariance{};  ///< lower triangle
    PoseNumber anchor = 0;
  };
  static Motion since_anchor(const Image& image);

  std::vector<Image> images_;
  std::vector<std::size_t> keyframes_;  // first image after each pose of the graph, if any
};

}  // namespace azimuth
