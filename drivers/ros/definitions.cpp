#include "drivers/ros/definitions.hpp"

#include <array>
#include <cassert>
#include <vector>

namespace azimuth::ros {
namespace {

/// The fields of one type. If ROS 2 has other fields, they are in `ros2`.
struct Part {
  std::string_view name;  // package/Name
  std::string_view ros1, ros2 = {};
  /// The types of the fields, without those that only ROS 2 has.
  std::vector<std::string_view> made_of = {};
  std::vector<std::string_view> made_of_in_ros2 = {};
};

/// The constants of a marker. Their type differs between ROS 1 and ROS 2.
std::string marker_constants(const std::string& type) {
  constexpr std::array<std::string_view, 16> kConstants{
      "ARROW=0",     "CUBE=1",        "SPHERE=2", "CYLINDER=3",         "LINE_STRIP=4",     "LINE_LIST=5",
      "CUBE_LIST=6", "SPHERE_LIST=7", "POINTS=8", "TEXT_VIEW_FACING=9", "MESH_RESOURCE=10", "TRIANGLE_LIST=11",
      "ADD=0",       "MODIFY=0",      "DELETE=2", "DELETEALL=3"};
  std::string text;
  for (const std::string_view constant : kConstants) text.append(type).append(" ").append(constant) += '\n';
  return text;
}

std::vector<Part> marker_parts() {
  static const std::string kMarker =
      "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
      "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n";
  static const std::string kMarker1 = marker_constants("uint8") + kMarker +
                                      "duration lifetime\nbool frame_locked\ngeometry_msgs/Point[] points\n"
                                      "std_msgs/ColorRGBA[] colors\nstring text\nstring mesh_resource\n"
                                      "bool mesh_use_embedded_materials\n";
  static const std::string kMarker2 =
      marker_constants("int32") + kMarker +
      "builtin_interfaces/Duration lifetime\nbool frame_locked\ngeometry_msgs/Point[] points\n"
      "std_msgs/ColorRGBA[] colors\nstring texture_resource\nsensor_msgs/CompressedImage texture\n"
      "visualization_msgs/UVCoordinate[] uv_coordinates\nstring text\nstring mesh_resource\n"
      "visualization_msgs/MeshFile mesh_file\nbool mesh_use_embedded_materials\n";
  return {
      {"sensor_msgs/CompressedImage", "", "std_msgs/Header header\nstring format\nuint8[] data\n", {"std_msgs/Header"}},
      {"visualization_msgs/UVCoordinate", "", "float32 u\nfloat32 v\n"},
      {"visualization_msgs/MeshFile", "", "string filename\nuint8[] data\n"},
      {"visualization_msgs/Marker",
       kMarker1,
       kMarker2,
       {"std_msgs/Header", "geometry_msgs/Pose", "geometry_msgs/Vector3", "std_msgs/ColorRGBA", "geometry_msgs/Point"},
       {"builtin_interfaces/Duration", "sensor_msgs/CompressedImage", "visualization_msgs/UVCoordinate",
        "visualization_msgs/MeshFile"}},
      {"visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n", {}, {"visualization_msgs/Marker"}},
  };
}

std::vector<Part> geometry_parts() {
  return {
      {"builtin_interfaces/Time", "", "int32 sec\nuint32 nanosec\n"},
      {"builtin_interfaces/Duration", "", "int32 sec\nuint32 nanosec\n"},
      {"std_msgs/Header",
       "uint32 seq\ntime stamp\nstring frame_id\n",
       "builtin_interfaces/Time stamp\nstring frame_id\n",
       {},
       {"builtin_interfaces/Time"}},
      {"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
      {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
      {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
      {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
      {"geometry_msgs/Pose",
       "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n",
       {},
       {"geometry_msgs/Point", "geometry_msgs/Quaternion"}},
      {"geometry_msgs/PoseWithCovariance",
       "geometry_msgs/Pose pose\nfloat64[36] covariance\n",
       {},
       {"geometry_msgs/Pose"}},
      {"geometry_msgs/PoseStamped",
       "std_msgs/Header header\ngeometry_msgs/Pose pose\n",
       {},
       {"std_msgs/Header", "geometry_msgs/Pose"}},
      {"geometry_msgs/PoseWithCovarianceStamped",
       "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n",
       {},
       {"std_msgs/Header", "geometry_msgs/PoseWithCovariance"}},
      {"geometry_msgs/Twist",
       "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n",
       {},
       {"geometry_msgs/Vector3"}},
      {"geometry_msgs/TwistWithCovariance",
       "geometry_msgs/Twist twist\nfloat64[36] covariance\n",
       {},
       {"geometry_msgs/Twist"}},
      {"geometry_msgs/Transform",
       "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n",
       {},
       {"geometry_msgs/Vector3", "geometry_msgs/Quaternion"}},
      {"geometry_msgs/TransformStamped",
       "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n",
       {},
       {"std_msgs/Header", "geometry_msgs/Transform"}},
  };
}

std::vector<Part> message_parts() {
  return {
      {"nav_msgs/Odometry",
       "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
       "geometry_msgs/TwistWithCovariance twist\n",
       {},
       {"std_msgs/Header", "geometry_msgs/PoseWithCovariance", "geometry_msgs/TwistWithCovariance"}},
      {"nav_msgs/Path",
       "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n",
       {},
       {"std_msgs/Header", "geometry_msgs/PoseStamped"}},
      {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n", {}, {"geometry_msgs/TransformStamped"}},
      {"diagnostic_msgs/KeyValue", "string key\nstring value\n"},
      {"diagnostic_msgs/DiagnosticStatus",
       "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\nstring message\nstring "
       "hardware_id\n"
       "diagnostic_msgs/KeyValue[] values\n",
       {},
       {"diagnostic_msgs/KeyValue"}},
      {"diagnostic_msgs/DiagnosticArray",
       "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n",
       {},
       {"std_msgs/Header", "diagnostic_msgs/DiagnosticStatus"}},
  };
}

const std::vector<Part>& parts() {
  static const std::vector<Part> kParts = [] {
    std::vector<Part> all = geometry_parts();
    for (const std::vector<Part>& more : {marker_parts(), message_parts()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return kParts;
}

struct Named {
  std::string_view ros1, checksum, ros2;
};

/// In the order of Type.
constexpr std::array<Named, 6> kTypes{{
    {"geometry_msgs/PoseWithCovarianceStamped", "953b798c0f514ff060a53a3498ce6246",
     "geometry_msgs/msg/PoseWithCovarianceStamped"},
    {"nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7", "nav_msgs/msg/Odometry"},
    {"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec", "tf2_msgs/msg/TFMessage"},
    {"nav_msgs/Path", "6227e2b7e9cce15051f669a5e197bbf7", "nav_msgs/msg/Path"},
    {"visualization_msgs/MarkerArray", "d155b9ce5188fbaf89745847fd5882d7", "visualization_msgs/msg/MarkerArray"},
    {"diagnostic_msgs/DiagnosticArray", "60810da900de1dd6ddd437c3503511da", "diagnostic_msgs/msg/DiagnosticArray"},
}};

const Part& part_named(std::string_view name) {
  for (const Part& part : parts())
    if (part.name == name) return part;
  assert(false && "a definition names a part that there is not");
  return parts().front();
}

/// Appends `name` and, recursively, all types that it contains, each once.
void collect(std::string_view name, bool ros2, std::vector<std::string_view>& names) {
  for (const std::string_view known : names)
    if (known == name) return;
  names.push_back(name);
  const Part& part = part_named(name);
  for (const std::string_view each : part.made_of) collect(each, ros2, names);
  if (!ros2) return;
  for (const std::string_view each : part.made_of_in_ros2) collect(each, ros2, names);
}

/// The type's own fields, then those of each contained type after a line of =.
std::string definition(std::string_view name, bool ros2) {
  std::vector<std::string_view> names;
  collect(name, ros2, names);
  std::string text;
  for (const std::string_view each : names) {
    const Part& part = part_named(each);
    if (!text.empty()) text.append(80, '=').append("\nMSG: ").append(each) += '\n';
    text += ros2 && !part.ros2.empty() ? part.ros2 : part.ros1;
  }
  return text;
}

const Named& names_of(Type type) { return kTypes.at(static_cast<std::size_t>(type)); }

}  // namespace

Ros1Type ros1_type(Type type) {
  const Named& named = names_of(type);
  return {named.ros1, named.checksum, definition(named.ros1, false)};
}

Ros2Type ros2_type(Type type) {
  const Named& named = names_of(type);
  return {named.ros2, definition(named.ros1, true)};
}

}  // namespace azimuth::ros
