#include "base/packed_file.hpp"

#include <array>

namespace azimuth {
namespace {

struct Beginning {
  std::string_view bytes, answer;
};
constexpr std::array<Beginning, 6> kPacked{
    {{"version https://git-lfs", "is a pointer of git-lfs, not the file itself: git lfs pull fetches that"},
     {"\x1F\x8B", "is compressed by gzip: gunzip it first"},
     {"\x28\xB5\x2F\xFD", "is compressed by zstd: unzstd it first"},
     {"\xFD\x37zXZ", "is compressed by xz: unxz it first"},
     {"\x04\x22\x4D\x18", "is compressed by lz4: unlz4 it first"},
     {"PK\x03\x04", "is a zip archive: unzip it first"}}};

constexpr std::string_view kBag = "is a bag of ROS: azimuth import makes a run of it";
constexpr std::array<std::string_view, 3> kBags{"#ROSBAG V", "\x89MCAP0\r\n", "SQLite format 3"};

}  // namespace

std::string_view packed_as(Bytes begin) {
  const std::string_view text = as_text(begin);
  for (const Beginning& each : kPacked)
    if (text.starts_with(each.bytes)) return each.answer;
  const bool is_bzip2 = text.starts_with("BZh") && text.substr(4).starts_with("1AY&SY");  // byte 3: level
  return is_bzip2 ? "is compressed by bzip2: bunzip2 it first" : std::string_view();
}

std::string_view imported_as(Bytes begin) {
  for (const std::string_view each : kBags)
    if (as_text(begin).starts_with(each)) return kBag;
  return {};
}

}  // namespace azimuth
