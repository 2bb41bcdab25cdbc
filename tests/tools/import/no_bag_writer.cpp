// Replaces bag_writer.cpp if librosbag-storage-dev is not installed.

#include "tests/tools/import/bag_writer.hpp"

namespace azimuth::test {

bool can_write_bags() { return false; }
void write_bag(const std::filesystem::path&, const std::vector<BagMessage>&, BagCompression) {}

}  // namespace azimuth::test
