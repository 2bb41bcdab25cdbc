#pragma once
// Bags of ROS 1, written by ROS's own library.

#include <filesystem>
#include <string>
#include <vector>

#include "tests/tools/import/ros_messages.hpp"

namespace azimuth::test {

/// One message on its way into a bag.
struct BagMessage {
  std::string topic;
  RosType type;
  double recorded_s = 0.0;
  std::string bytes;
};

enum class BagCompression { none, bz2, lz4 };

/// Whether that library was there when this was compiled.
bool can_write_bags();

/// Writes a bag of small chunks, so that there are many.
void write_bag(const std::filesystem::path& file, const std::vector<BagMessage>& messages,
               BagCompression compression = BagCompression::none);

}  // namespace azimuth::test
