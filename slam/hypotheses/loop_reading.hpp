#pragma once
// A robot that comes back, and knows its pose too badly to tell by one image what it sees, looks for itself in its own
// map by several, as a lost robot does (SPEC VI.20).

#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/hypotheses/conditioned_association.hpp"
#include "slam/hypotheses/scene.hpp"
#include "slam/localisation/image_match.hpp"
#include "slam/localisation/relocaliser.hpp"
#include "slam/smoother/factors.hpp"

namespace azimuth {

/// A landmark mapped before the images that are read anew. It must be a point.
struct MappedBefore {
  SmoothedLandmark where;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (alpha, rho), as the landmarks lie to each other
  Kind kind = kAnyKind;
};

/// An image to be read anew.
struct ImageToRead {
  Motion motion;  ///< from the image before; of the first one nothing is asked
  std::vector<NamelessSighting> sightings;
};

/// Where the robot may have been at the last of these images, most probable first: poses that several of the images
/// agree on. `whereabouts` are those of the first one. Thread contract: reentrant. Same calls, same bits.
std::vector<PoseGaussian> find_in_map(std::span<const MappedBefore> map, std::span<const ImageToRead> images,
                                      const Scene& scene, const Whereabouts& whereabouts);

/// What images say when the pose of the last one is known.
struct Reading {
  std::vector<SmoothedPose> poses;            ///< of each image
  std::vector<std::vector<int>> landmark_of;  ///< of each bearing of each image: an index of the map, or -1
};
/// Image after image backwards, each conditioned on those that were read before. The map stays as it is. Thread
/// contract: reentrant.
Reading read_backwards(std::span<const MappedBefore> map, std::span<const ImageToRead> images, const Scene& scene,
                       double min_distance_m, const PoseGaussian& last);

}  // namespace azimuth
