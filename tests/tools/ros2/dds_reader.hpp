#pragma once
// A subscriber of another DDS implementation, Fast DDS, with its own types. It returns the received bytes. A pose is
// decoded with Fast CDR.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace azimuth::test {

/// A geometry_msgs/PoseWithCovarianceStamped that Fast CDR has decoded.
struct ReadPose {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  std::string frame_id;
  std::array<double, 3> position{};
  std::array<double, 4> orientation{};
  std::array<double, 36> covariance{};
};

/// Throws the exception of Fast CDR if the bytes are no such message.
ReadPose read_pose(const std::string& cdr);

/// Subscribes with the default quality of service of ROS 2, on the loopback interface only.
class DdsReader {
 public:
  /// Topic and type have their names on the wire, for example rt/odom and nav_msgs::msg::dds_::Odometry_.
  DdsReader(const std::string& topic, const std::string& type, int domain = 0);
  ~DdsReader();
  DdsReader(const DdsReader&) = delete;
  DdsReader& operator=(const DdsReader&) = delete;

  bool is_matched() const;                    ///< A publisher of the topic exists.
  std::vector<std::string> messages() const;  ///< All messages so far, in CDR with its header.

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace azimuth::test
