#pragma once
// A subscriber of another DDS implementation, Fast DDS, with types of its own: the bytes as they came, and a pose that
// is taken apart by its CDR.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace azimuth::test {

/// geometry_msgs/PoseWithCovarianceStamped, as Fast CDR takes it apart.
struct ReadPose {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  std::string frame_id;
  std::array<double, 3> position{};
  std::array<double, 4> orientation{};
  std::array<double, 36> covariance{};
};

/// Throws what Fast CDR throws when the bytes are no such message.
ReadPose read_pose(const std::string& cdr);

/// Subscribes with ROS 2's default quality of service, on the loopback alone.
class DdsReader {
 public:
  /// Topic and type as they are called on the wire: rt/odom, nav_msgs::msg::dds_::Odometry_.
  DdsReader(const std::string& topic, const std::string& type, int domain = 0);
  ~DdsReader();
  DdsReader(const DdsReader&) = delete;
  DdsReader& operator=(const DdsReader&) = delete;

  bool is_matched() const;                    ///< somebody publishes
  std::vector<std::string> messages() const;  ///< all so far: CDR with its header

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace azimuth::test
