#pragma once
// Writes bags of ROS 1 with the library of ROS.

#include <filesystem>
#include <string>
#include <vector>

#include "tests/tools/import/ros_messages.hpp"

namespace azimuth::test {

/// One message to write to a bag.
struct BagMessage {
  std::string topic;
  RosType type;
  double recorded_s = 0.0;
  std::string bytes;
};

enum class BagCompression { none, bz2, lz4 };

/// True if the library of ROS was present at compile time.
bool can_write_bags();

/// Writes a bag of many small chunks.
void write_bag(const std::filesystem::path& file, const std::vector<BagMessage>& messages,
               BagCompression compression = BagCompression::none);

}  // namespace azimuth::test
