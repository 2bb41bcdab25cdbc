#pragma once
// Loop closure by several images (mathematics VI.20). A robot that returns to a known place may know its pose too badly
// to associate the bearings of one image. It then searches its own map with several images together, as in
// relocalisation.

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

/// A landmark that was mapped before the images that are associated anew. It must be a point.
struct MappedBefore {
  SmoothedLandmark where;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (alpha, rho), relative to the other landmarks
  Kind kind = kAnyKind;
};

/// An image whose bearings are associated anew.
struct ImageToRead {
  Motion motion;  ///< from the image before; unused for the first image
  std::vector<NamelessSighting> sightings;
};

/// Candidate poses of the robot at the last of these images, most probable first. Several of the images agree on each
/// of them. `position_prior` is the search area at the first image. Thread contract: reentrant. The same calls give the
/// same bits.
std::vector<PoseGaussian> find_in_map(std::span<const MappedBefore> map, std::span<const ImageToRead> images,
                                      const Scene& scene, const PositionPrior& position_prior);

/// The association of several images, given the pose of the last one.
struct Reading {
  std::vector<SmoothedPose> poses;            ///< one per image
  std::vector<std::vector<int>> landmark_of;  ///< per image and bearing: index in the map, or -1
};
/// Associates the images from the last one backwards. Each image is conditioned on those already associated. The map
/// stays unchanged. Thread contract: reentrant.
Reading read_backwards(std::span<const MappedBefore> map, std::span<const ImageToRead> images, const Scene& scene,
                       double min_distance_m, const PoseGaussian& last);

}  // namespace azimuth
