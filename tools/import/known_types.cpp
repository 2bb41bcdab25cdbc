#include "tools/import/known_types.hpp"

#include <algorithm>
#include <array>

namespace azimuth {
namespace {

constexpr std::string_view kKnownHeader =
    "===== \nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
    "===== \nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
constexpr std::string_view kKnownPose =
    "===== \nMSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n"
    "===== \nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n"
    "===== \nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"
    "===== \nMSG: geometry_msgs/PoseWithCovariance\nPose pose\nfloat64[36] covariance\n";
constexpr std::string_view kKnownTwist =
    "===== \nMSG: geometry_msgs/TwistWithCovariance\nTwist twist\nfloat64[36] covariance\n"
    "===== \nMSG: geometry_msgs/Twist\nVector3 linear\nVector3 angular\n"
    "===== \nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n";

struct KnownType {
  std::string_view name, fields;
  bool has_pose = false, has_twist = false;
};
constexpr std::array<KnownType, 7> kKnownTypes{
    {{"nav_msgs/Odometry",
      "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
      "geometry_msgs/TwistWithCovariance twist\n",
      true, true},
     {"geometry_msgs/PoseStamped", "std_msgs/Header header\nPose pose\n", true},
     {"geometry_msgs/PoseWithCovarianceStamped", "std_msgs/Header header\nPoseWithCovariance pose\n", true},
     {"sensor_msgs/JointState",
      "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n"},
     {"sensor_msgs/Image",
      "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\n"
      "uint8[] data\n"},
     {"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
     {"tf2_msgs/TFMessage",
      "geometry_msgs/TransformStamped[] transforms\n"
      "===== \nMSG: geometry_msgs/TransformStamped\nstd_msgs/Header header\nstring child_frame_id\n"
      "Transform transform\n"
      "===== \nMSG: geometry_msgs/Transform\nVector3 translation\nQuaternion rotation\n",
      true, true}}};

}  // namespace

std::string known_definition(std::string_view type) {
  const auto known = std::ranges::find(kKnownTypes, type, &KnownType::name);
  if (known == kKnownTypes.end()) return {};
  std::string definition(known->fields);
  definition += kKnownHeader;
  if (known->has_pose) definition += kKnownPose;
  if (known->has_twist) definition += kKnownTwist;
  return definition;
}

}  // namespace azimuth
