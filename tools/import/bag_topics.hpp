#pragma once
// Which topics of a bag a run is made of. Reentrant.

#include <optional>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "tools/import/bag_file.hpp"

namespace azimuth {

/// Names of topics; an empty one: whichever there is.
struct BagWishes {
  std::string odometry, images;
  std::string truth;                      ///< empty: none
  bool has_wheels = false;                ///< joints count as odometry: it is known how far apart the wheels are
  std::vector<std::string> senders = {};  ///< of topics that several send: nodes, channels, or a frame of odometry
};

struct BagChoice {
  std::optional<BagTopic> odometry, images, truth;
};

/// Odometry is nav_msgs/Odometry, or sensor_msgs/JointState of known wheels; if it is named so, poses as well. Images
/// are sensor_msgs/Image or CompressedImage; there may be none. Refuses a topic that is not there or of no such type,
/// several of which none is named, and one on which several send at the same time, of whom none is.
FileResult<BagChoice> choose_topics(const std::string& file, const std::vector<BagTopic>& topics,
                                    const BagWishes& wishes);

/// "/base (110 messages), /ekf (110 messages)".
std::string senders_of(const BagTopic& topic);

/// What a topic can be used for, in a word or two; empty: nothing here reads it.
std::string use_of(const BagTopic& topic);

}  // namespace azimuth
