// azimuth report trajectory: compares a trajectory of any program with the truth of a run.

#include <cstdio>
#include <fstream>
#include <memory>

#include "tools/azimuth/command.hpp"
#include "tools/azimuth/tum_reader.hpp"
#include "tools/evaluate/report_json.hpp"
#include "tools/replay/summary.hpp"

namespace azimuth {
namespace {

struct TrajectoryOptions {
  std::filesystem::path trajectory, run, report;
};

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
