#pragma once
// Where a bag says that the camera stands: static transforms between the frames that odometry and images name.
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

/// A tree of frames, each fixed in its parent.
class StaticFrames {
 public:
  /// The last one counts of several that name the same child.
  void add(const std::string& parent, const std::string& child, const Eigen::Isometry3d& T_parent_child);
  /// Nothing: they hang on different roots, or a frame is its own parent.
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

/// The camera on the robot, by /tf_static.
struct CameraMounting {
  std::string base, camera;                  ///< names of the frames
  Eigen::Vector3d p_base_camera_m{0, 0, 0};  ///< x forward, y left, z up
  Eigen::Matrix3d R_base_camera = Eigen::Matrix3d::Identity();

  /// Of the axis of the camera's frame that is next to vertical: z of an optical frame that looks up and of a body's
  /// frame, x of a body's frame that was turned up. Its turn about that axis is the azimuths' offset. Nothing: none of
  /// them is near the vertical.
  std::optional<CameraTilt> tilt() const;
};

/// Nothing: the bag has no images or no such transform. Frames are those that the messages of `choice` name: the base
/// is the child of nav_msgs/Odometry, else base_link or base_footprint.
std::optional<CameraMounting> camera_mounting(const BagFile& bag, const BagChoice& choice);

/// The text of a rig.toml that says nothing of where its camera stands, or how it leans, with that; how it leans only
/// of cameras whose images are levelled by it. Nothing: it does say something, or there is nothing to say.
std::optional<std::string> rig_with(const CameraMounting& mounting, const std::string& rig_toml);

}  // namespace azimuth
