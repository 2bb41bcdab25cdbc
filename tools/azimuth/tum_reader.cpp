#include "tools/azimuth/tum_reader.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace azimuth {
namespace {

constexpr std::size_t kMaxErrors = 20;
constexpr double kMaxSeconds = 9e12;

using TumFields = std::array<double, 8>;  // t x y z qx qy qz qw

std::optional<TumFields> parse_fields(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r";
  TumFields fields{};
  for (double& field : fields) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kBlank));
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), field);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(field)) return std::nullopt;
    line.remove_prefix(word.size());
  }
  if (line.find_first_not_of(kBlank) != std::string_view::npos) return std::nullopt;
  return fields;
}

double heading(const TumFields& fields) {
  const auto& [t, x, y, z, qx, qy, qz, qw] = fields;
  return wrap(std::atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz)));
}

bool is_rotation(const TumFields& fields) {
  double squared = 0.0;
  for (std::size_t i = 4; i < fields.size(); ++i) squared += fields[i] * fields[i];
  return std::abs(std::sqrt(squared) - 1.0) < 0.01;
}

/// Returns what is wrong with the numbers of a line, or an empty text.
std::string complaint(const TumFields& fields, const std::vector<StampedPose>& before) {
  if (std::abs(fields[0]) > kMaxSeconds) return "stamp out of range";
  if (!is_rotation(fields)) return "quaternion is not of length 1";
  const Stamp stamp{duration_from_seconds(fields[0])};
  if (!before.empty() && stamp <= before.back().stamp) return "stamp does not increase";
  return {};
}

}  // namespace

FileResult<std::vector<StampedPose>> read_tum(std::istream& text, const std::string& file) {
  std::vector<StampedPose> trajectory;
  FileErrors errors;
  std::string line;
  for (int number = 1; std::getline(text, line) && errors.size() < kMaxErrors; ++number) {
    const std::string_view content = std::string_view(line).substr(0, line.find('#'));
    if (content.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const std::optional<TumFields> fields = parse_fields(content);
    if (!fields) {
      errors.push_back({file, number, "expected eight numbers: t x y z qx qy qz qw"});
    } else if (std::string problem = complaint(*fields, trajectory); !problem.empty()) {
      errors.push_back({file, number, std::move(problem)});
    } else {
      const Pose2 pose{(*fields)[1], (*fields)[2], heading(*fields)};
      trajectory.push_back({Stamp{duration_from_seconds((*fields)[0])}, pose});
    }
  }
  if (errors.empty() && trajectory.empty()) errors.push_back({file, 0, "holds no pose"});
  if (!errors.empty()) return failure(std::move(errors));
  return trajectory;
}

}  // namespace azimuth
