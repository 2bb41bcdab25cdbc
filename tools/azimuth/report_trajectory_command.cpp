// azimuth report trajectory: compares a trajectory of any program with the truth of a run.

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file_result.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/evaluate/trajectory.hpp"
#include "tools/replay/summary.hpp"

namespace azimuth {
namespace {

struct TrajectoryOptions {
  std::filesystem::path trajectory, run, report;
};

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

/// Reads a trajectory in the text format of the TUM benchmark: `t x y z qx qy qz qw` per line, `#` begins a comment.
/// The heading is the rotation about z. Refuses lines without eight finite numbers, quaternions far from length 1 and
/// stamps that do not increase. Errors name `file`.
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

std::vector<StampedPose> read_trajectory(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) refuse(file.string() + ": cannot be read");
  FileResult<std::vector<StampedPose>> trajectory = read_tum(stream, file.string());
  if (!trajectory) refuse(trajectory.error());
  return *std::move(trajectory);
}

ReplayRecord record_of(const TrajectoryOptions& options) {
  ReplayRecord record;
  const std::vector<StampedPose> trajectory = read_trajectory(options.trajectory);
  const Run run = load_run_or_refuse(options.run);
  if (run.truth.empty()) refuse(options.run.string() + ": has no truth to compare with");
  record.run = run.name;
  record.estimator = options.trajectory.filename().string();
  const Eigen::Matrix3d unknown = Eigen::Matrix3d::Constant(kNotMeasured);
  for (const StampedPose& pose : trajectory) record.estimates.push_back({pose.stamp, pose.pose, unknown, Pose2{}});
  for (const TruthPose& truth : run.truth) record.truth.push_back({truth.stamp, truth.T_world_body});
  return record;
}

void evaluate_trajectory(const TrajectoryOptions& options) {
  const Report report = evaluate(record_of(options));
  if (report.position_m.count == 0) refuse(options.trajectory.string() + ": no stamp lies within the run's truth");
  if (!options.report.empty()) write_text(to_json(report), options.report);
  std::fputs(pose_summary(report).c_str(), stdout);
}

}  // namespace

void add_report_trajectory_command(CLI::App& report) {
  CLI::App* command =
      report.add_subcommand("trajectory", "Compare a trajectory (TUM format) of any program with the truth of a run");
  const auto options = std::make_shared<TrajectoryOptions>();
  command
      ->add_option("TRAJECTORY", options->trajectory, "Trajectory to judge (TUM format): lines of t x y z qx qy qz qw")
      ->required();
  command->add_option("RUN", options->run, "Run folder or LCM log with truth")->required();
  command->add_option("--report", options->report, "Write the report as JSON");
  command->callback([options] { evaluate_trajectory(*options); });
}

}  // namespace azimuth
