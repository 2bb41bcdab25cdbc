#include "drivers/storage/tum.hpp"

#include <cmath>

#include "base/files.hpp"
#include "drivers/wire/number_text.hpp"

namespace azimuth {

std::string tum_text(std::span<const std::pair<Stamp, Pose2>> trajectory) {
  std::string out;
  for (const auto& [stamp, pose] : trajectory) {
    const double half_rad = 0.5 * pose.heading_rad;
    append_seconds(out, stamp);
    for (const double value : {pose.x_m, pose.y_m, 0.0, 0.0, 0.0, std::sin(half_rad), std::cos(half_rad)}) {
      out += ' ';
      append_double(out, value);
    }
    out += '\n';
  }
  return out;
}

FileResult<void> write_tum(std::span<const std::pair<Stamp, Pose2>> trajectory, const std::filesystem::path& file) {
  return write_text_file(file, tum_text(trajectory));
}

}  // namespace azimuth
