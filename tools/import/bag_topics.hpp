#pragma once
// Chooses the topics of a bag for a run. Reentrant.

#include <optional>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "tools/import/bag_file.hpp"

namespace azimuth {

/// Topics that the user requests. An empty name selects the only suitable topic.
struct BagWishes {
  std::string odometry, images;
  std::string truth;                      ///< empty: no truth
  bool has_wheels = false;                ///< the wheel track is known, so joints may serve as odometry
  std::vector<std::string> senders = {};  ///< nodes or channels for topics with several senders, or an odometry frame
};

struct BagChoice {
  std::optional<BagTopic> odometry, images, truth;
};

/// Odometry is nav_msgs/Odometry, or sensor_msgs/JointState if the wheels are known, or a pose topic if the user names
/// it. Images are sensor_msgs/Image or CompressedImage and are optional. Fails if a requested topic is missing or has
/// the wrong type, if several topics are suitable and none is requested, or if a topic has several simultaneous senders
/// and none is requested.
FileResult<BagChoice> choose_topics(const std::string& file, const std::vector<BagTopic>& topics,
                                    const BagWishes& wishes);

/// Example: "/base (110 messages), /ekf (110 messages)".
std::string senders_of(const BagTopic& topic);

/// Possible use of a topic, in a word or two; empty if the import cannot use it.
std::string use_of(const BagTopic& topic);

}  // namespace azimuth
