#pragma once
// Determines the mounting of the camera from static transforms of a bag, between the frames of odometry and images.
//
// Thread contract: reentrant.

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>

#include "slam/camera/camera_tilt.hpp"
#include "tools/import/bag_file.hpp"
#include "tools/import/bag_topics.hpp"

namespace azimuth {

/// A tree of frames. Each frame is fixed in its parent.
class StaticFrames {
 public:
  /// Adds a transform. If several name the same child, the last one counts.
  void add(const std::string& parent, const std::string& child, const Eigen::Isometry3d& T_parent_child);
  /// The transform between two frames. Nothing if they have different roots or if the tree contains a cycle.
  std::optional<Eigen::Isometry3d> between(const std::string& from, const std::string& to) const;

 private:
  struct InParent {
    std::string parent;
    Eigen::Isometry3d T_parent_child;
  };
  struct InRoot {
    std::string root;
    Eigen::Isometry3d T_root_frame;
  };
  std::optional<InRoot> in_root(std::string frame) const;

  std::map<std::string, InParent> frames_;
};

/// The mounting of the camera on the robot according to /tf_static.
struct CameraMounting {
  std::string base, camera;                  ///< frame names
  Eigen::Vector3d p_base_camera_m{0, 0, 0};  ///< x forward, y left, z up
  Eigen::Matrix3d R_base_camera = Eigen::Matrix3d::Identity();

  /// Tilt of the axis of the camera's frame that is nearest to the vertical: z for an optical frame that looks up or
  /// for a body frame, x for a body frame that is turned up. The rotation about that axis belongs to the azimuth
  /// offset. Nothing if no axis is near the vertical.
  std::optional<CameraTilt> tilt() const;
};

/// The frames are those named by the messages of `choice`. The base is the child frame of nav_msgs/Odometry, otherwise
/// base_link or base_footprint. Nothing if the bag has no images or no such transform.
std::optional<CameraMounting> camera_mounting(const BagFile& bag, const BagChoice& choice);

/// The text of a rig.toml with the camera's position and tilt added if the text lacks them. The tilt is added only for
/// cameras whose bearings are levelled with it. Nothing if the text already contains them or if there is nothing to
/// add.
std::optional<std::string> rig_with(const CameraMounting& mounting, const std::string& rig_toml);

}  // namespace azimuth
