#include "tools/replay/summary.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "settings/sample_sentence.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

std::string line(const std::string& topic, const std::string& words) { return fmt::format("{:<12}{}\n", topic, words); }

double duration_s(const Run& run) {
  return run.odometry.empty() ? 0.0 : to_seconds(run.odometry.back().stamp - run.odometry.front().stamp);
}

/// The input of the estimator.
std::string sets_summary(const Run& run, const ImageOutcome& images) {
  return images.images > 0 ? fmt::format("{} images", images.images)
                           : fmt::format("{} bearing sets", run.bearings.size());
}

/// One line for each kind of image trouble.
std::string trouble_summary(const ImageOutcome& images) {
  std::string text;
  for (const auto& [trouble, count] : images.troubles) {
    const bool unreadable = trouble == ImageTrouble::unreadable && !images.first_unreadable.empty();
    text += line("images", fmt::format("{} times {}{}", count, to_string(trouble),
                                       unreadable ? fmt::format(" (first: {})", images.first_unreadable) : ""));
  }
  return text;
}

std::string run_summary(const Run& run, const ImageOutcome& images) {
  std::string text = line("run", fmt::format("{}, {:.1f} s, {} odometry readings, {}", run.name, duration_s(run),
                                             run.odometry.size(), sets_summary(run, images)));
  text += trouble_summary(images);
  if (const std::string skipped = run.skipped.text(); !skipped.empty()) text += line("skipped", skipped);
  return text;
}

std::string estimator_summary(const ReplayResult& result, const Report& report) {
  std::string health = report.health;
  if (!result.last.reason.empty()) health += fmt::format(" ({})", result.last.reason);
  std::string text =
      line("estimator", fmt::format("{}, {} steps, {} at the end", report.estimator, report.steps, health));
  const Eigen::Vector3d& two_sigma = report.two_sigma_final;
  if (report.steps > 0)
    text += line("2 sigma", fmt::format("x {:.3f} m, y {:.3f} m, heading {:.2f} deg at the end", two_sigma.x(),
                                        two_sigma.y(), rad_to_degrees(two_sigma.z())));
  return text;
}

std::string times(std::size_t count, std::string_view what) {
  return fmt::format("{} {} {}", what, count, count == 1 ? "time" : "times");
}

std::string health_time(Health health, const HealthTime& time) {
  std::string text = fmt::format("{} {:.1f} s ({:.1f} %", to_string(health), time.seconds, 100.0 * time.share);
  if (!time.first_reason.empty()) text += fmt::format(", first {}", time.first_reason);
  return text + ')';
}

constexpr double kShown_s = 0.05;

/// Health over time.
std::string health_summary(const HealthReport& report) {
  if (!std::isfinite(report.blind.longest_s)) return "";
  std::string healths;
  for (const Health health : kHealths)
    if (report.of(health).seconds >= kShown_s)
      healths += (healths.empty() ? "" : ", ") + health_time(health, report.of(health));
  std::string text = line("health", healths);
  if (report.times_lost > 0)
    text += line("lost", times(report.times_lost, "lost") + ", " + times(report.times_found, "found again"));
  return text + line("blind", fmt::format("{:.2f} of {:.2f} m driven without a bearing that was used, in {} {}; "
                                          "longest time without one {:.1f} s",
                                          report.blind.driven_m, report.blind.path_m, report.blind.gaps,
                                          report.blind.gaps == 1 ? "gap" : "gaps", report.blind.longest_s));
}

bool has_names(const Run& run) {
  return std::ranges::any_of(run.bearings, [](const BearingSet& set) {
    return std::ranges::any_of(set.bearings, [](const Bearing& each) { return each.identity != kUnknownIdentity; });
  });
}

/// True if the gate rejects many bearings with identities. Since the identity gives the data association, such
/// rejections mean that something else is wrong.
bool many_names_refused(const Run& run, const AssociationCounts& counts) {
  constexpr double kMany = 0.05;
  constexpr std::uint64_t kEnoughToJudge = 20;
  const std::uint64_t judged = counts.accepted + counts.rejected;
  return judged >= kEnoughToJudge && static_cast<double>(counts.rejected) >= kMany * static_cast<double>(judged) &&
         has_names(run);
}

/// Advice for a run that has enough samples but gives poor results, or whose samples contradict each other.
std::string why_not_consistent(const Run& run, const Report& report, const AssociationCounts& counts) {
  constexpr double kLittle = 0.5;
  constexpr double kMuch = 6.0;  // twice the ideal ANEES
  constexpr std::size_t kEnoughToJudge = 20;
  const HealthReport& health = report.health_over_time;
  const bool told = !report.input_trouble.empty() || !std::isfinite(health.blind.longest_s);
  if (told || counts.accepted + counts.rejected == 0) return "";
  if (health.of(Health::tracking).share < kLittle) return "less than half of it was tracked";
  if (many_names_refused(run, counts))
    return fmt::format(
        "{:.0f} % of the bearings were refused although they name their landmarks",
        100.0 * static_cast<double>(counts.rejected) / static_cast<double>(counts.accepted + counts.rejected));
  const Consistency& tracking = report.tracking_consistency;
  if (tracking.evaluated >= kEnoughToJudge && tracking.anees > kMuch)
    return fmt::format("errors are larger than was said (ANEES {:.1f} while tracking, 3 is ideal)", tracking.anees);
  return "";
}

std::string without_doubt(const Report& report) {
  std::string text =
      fmt::format("tracking for {:.0f} % of the time", 100.0 * report.health_over_time.of(Health::tracking).share);
  if (report.tracking_consistency.evaluated > 0)
    return text + fmt::format(", errors no larger than was said (ANEES {:.1f} while tracking, 3 is ideal)",
                              report.tracking_consistency.anees);
  return text + "; there is no truth to compare with";
}

/// The run in one sentence, and the one command to go on with.
std::string verdict(const Run& run, const Report& report, const AssociationCounts& counts, std::string_view run_path,
                    bool refined) {
  if (!std::isfinite(report.health_over_time.blind.longest_s)) return "";  // nothing was estimated: "trouble" says why
  if (const std::string why = why_not_consistent(run, report, counts); !why.empty())
    return line("verdict", why) +
           line("next", fmt::format("`azimuth check {}` says whether rig and recording can be right", run_path));
  if (!report.input_trouble.empty() || counts.accepted + counts.rejected == 0) return "";
  return line("verdict", without_doubt(report)) +
         line("next",
              refined
                  ? fmt::format("`azimuth map refine {} --map FILE` saves the map for a robot to start from", run_path)
                  : fmt::format("`azimuth map refine {}` improves path and map by the whole drive", run_path));
}

/// Number and position error of the landmarks paired with true ones.
std::string paired(std::size_t matched, const ErrorStatistics& errors_m, std::size_t true_landmarks) {
  std::string text = fmt::format("{} of {} true landmarks", matched, true_landmarks);
  if (matched > 0) text += fmt::format(", rmse {:.3f} m, max {:.3f} m", errors_m.rmse, errors_m.max);
  return text;
}

std::string by_place(const MapError& map) {
  std::string text = fmt::format("{}, {} duplicates, {} phantoms",
                                 paired(map.matched, map.position_m, map.true_landmarks), map.duplicates, map.phantoms);
  if (std::isfinite(map.pair_distance_rms_m))
    text += fmt::format("; distances between them rmse {:.3f} m", map.pair_distance_rms_m);
  return line("one to one", text);
}

std::string map_summary(const Report& report) {
  const MapError& map = report.map;
  std::string text = line("map", landmark_counts(report));
  if (report.natural_features && map.true_landmarks > 0)
    text += line("", fmt::format("not compared with the {} true landmarks: features are of whatever is seen",
                                 map.true_landmarks));
  if (report.T_world_map && map.true_landmarks > 0 && !report.natural_features) text += by_place(map);
  const SpaceMapError& space = report.space_map;
  if (space.matched > 0)
    text += line("in space",
                 fmt::format("{} of {} true landmarks, mean {:.3f} m, max {:.3f} m, {:.3f} m too {}; {} duplicates, "
                             "{} phantoms",
                             space.matched, space.true_landmarks, space.position_m.mean, space.position_m.max,
                             std::abs(space.height_mean_m), space.height_mean_m < 0.0 ? "low" : "high",
                             space.duplicates, space.phantoms));
  const NamedMapError& named = report.named_map;
  if (named.named > 0)
    text += line(
        "by identity",
        fmt::format("{}, {} duplicates", paired(named.named, named.position_m, map.true_landmarks), named.duplicates));
  return text;
}

std::string bearings_summary(const AssociationCounts& counts) {
  return line(
      "bearings",
      fmt::format("{} accepted, {} rejected, {} thinned; {} landmarks made, {} deleted, {} recovered", counts.accepted,
                  counts.rejected, counts.thinned, counts.created, counts.deleted, counts.recovered));
}

std::string wrong_summary(const SightingErrors& sightings) {
  if (sightings.judged == 0) return "";
  const double share = 100.0 * static_cast<double>(sightings.wrong) / static_cast<double>(sightings.judged);
  return line("wrong", fmt::format("{} of {} accepted bearings ({:.2f} %), judged from where the robot was",
                                   sightings.wrong, sightings.judged, share));
}

std::string time_summary(const std::string& topic, const TimeStatistics& times) {
  return line(topic, fmt::format("median {:.1f} us, p99 {:.1f} us, max {:.1f} us", times.median_us, times.p99_us,
                                 times.max_us));
}

std::string unused_summary(const InputCounts& input) {
  const std::uint64_t late = input.odometry_out_of_order + input.bearings_out_of_order;
  if (late + input.bearings_without_odometry + input.values_not_finite == 0) return {};
  return line(
      "not used",
      fmt::format("{} samples out of order, {} bearing sets without odometry, {} values not finite or beyond a turn",
                  late, input.bearings_without_odometry, input.values_not_finite));
}

}  // namespace

std::string landmark_counts(const Report& report) {
  std::string text = fmt::format("{} {}", report.map.landmarks, report.natural_features ? "features" : "landmarks");
  if (report.settled_landmarks && *report.settled_landmarks != report.map.landmarks)
    text += fmt::format(", {} of them settled", *report.settled_landmarks);
  return text;
}

std::string pose_summary(const Report& report) {
  const ErrorStatistics& position = report.position_m;
  if (position.count == 0) return line("position", "no truth to compare with");
  std::string text = line("position", fmt::format("rmse {:.3f} m, mean {:.3f} m, max {:.3f} m, final {:.3f} m",
                                                  position.rmse, position.mean, position.max, position.final));
  if (report.heading_rad.count > 0)
    text += line("heading", fmt::format("rmse {:.2f} deg, max {:.2f} deg", rad_to_degrees(report.heading_rad.rmse),
                                        rad_to_degrees(report.heading_rad.max)));
  if (position.count < report.steps)
    text += line("truth", fmt::format("at {} of {} estimates", position.count, report.steps));
  return text;
}

/// Accuracy of the smoothed path.
std::string hindsight_summary(const Report& report) {
  if (!report.hindsight || report.hindsight->position_m.count == 0) return "";
  const HindsightReport& hindsight = *report.hindsight;
  std::string text = fmt::format("rmse {:.3f} m, max {:.3f} m", hindsight.position_m.rmse, hindsight.position_m.max);
  if (hindsight.heading_rad.count > 0)
    text += fmt::format(", heading rmse {:.2f} deg", rad_to_degrees(hindsight.heading_rad.rmse));
  if (hindsight.consistency.evaluated > 0) text += fmt::format(", ANEES {:.2f}", hindsight.consistency.anees);
  return line("hindsight", text);
}

std::string summary(const Run& run, const ReplayResult& result, const Report& report, std::string_view run_path,
                    bool refined) {
  std::string text = run_summary(run, result.images);
  if (!report.input_trouble.empty()) text += line("trouble", report.input_trouble);
  if (const std::string restarts = restart_sentence(run.odometry); !restarts.empty()) text += line("restart", restarts);
  text += estimator_summary(result, report) + health_summary(report.health_over_time) + pose_summary(report);
  if (report.odometry_m.count > 0)
    text += line("odometry", fmt::format("rmse {:.3f} m alone, {:.3f} m uncalibrated", report.odometry_m.rmse,
                                         report.odometry_raw_m.rmse));
  if (report.consistency.evaluated > 0)
    text +=
        line("consistency", fmt::format("ANEES {:.2f} (3 is ideal){}", report.consistency.anees,
                                        report.tracking_consistency.evaluated > 0
                                            ? fmt::format(", {:.2f} while tracking", report.tracking_consistency.anees)
                                            : std::string()));
  text += hindsight_summary(report) + map_summary(report) + bearings_summary(result.last.association) +
          wrong_summary(report.association.sightings) + unused_summary(result.last.input);
  if (!result.times.detect_us.empty()) text += time_summary("detect time", report.detect);
  if (report.steps > 0) text += time_summary("step time", report.step);
  if (const std::string slow = why_too_slow(report); !slow.empty()) text += line("too slow", slow);
  return text + line("digest", report.digest) + verdict(run, report, result.last.association, run_path, refined);
}

}  // namespace azimuth
