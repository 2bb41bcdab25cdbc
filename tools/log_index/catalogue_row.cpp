#include "tools/log_index/catalogue_row.hpp"

#include <chrono>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <numeric>

#include "settings/configuration.hpp"
#include "settings/configured_estimator.hpp"
#include "settings/rig.hpp"

namespace azimuth {
namespace {

constexpr double kMicroseconds = 1e-6;

/// Stamps between the years 2001 and 2100 are dates; stamps of simulated drives count from the start of the drive.
constexpr std::int64_t kFirstDate_us = 978'307'200'000'000, kLastDate_us = 4'102'444'800'000'000;

std::optional<std::string> utc_text(std::int64_t since_epoch_us) {
  if (since_epoch_us < kFirstDate_us || since_epoch_us > kLastDate_us) return std::nullopt;
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(since_epoch_us / 1'000'000)));
}

/// The robot's name: the channel prefix without trailing separators, for example ROBOT7 for "ROBOT7_". Without a prefix
/// it is the name of the odometer.
std::string robot_of(const LogSummary& summary) {
  std::string name = summary.prefix;
  while (!name.empty() && (name.back() == '_' || name.back() == '/' || name.back() == '.')) name.pop_back();
  return name.empty() ? summary.odometer : name;
}

/// The estimator; empty if rig or settings are unreadable.
std::string estimator_of(const LogSummary& summary) {
  if (summary.rig_toml.empty()) return {};
  const FileResult<Rig> rig = read_rig(summary.rig_toml, "rig.toml");
  const FileResult<Configuration> configuration = read_configuration(summary.configuration_toml, "azimuth.toml");
  return rig && configuration ? std::string(name(chosen_estimator(*rig, *configuration))) : std::string();
}

std::optional<std::array<double, 4>> shares_of(const std::array<double, 4>& health_s) {
  const double all_s = std::accumulate(health_s.begin(), health_s.end(), 0.0);
  if (!(all_s > 0.0)) return std::nullopt;
  std::array<double, 4> shares = health_s;
  for (double& share : shares) share /= all_s;
  return shares;
}

void add_words(std::string& text, const std::string& words) { text += (text.empty() ? "" : ", ") + words; }

std::string trouble_of(const CatalogueRow& row) {
  const LogSummary& summary = row.summary;
  std::string trouble;
  if (summary.damaged_bytes > 0) add_words(trouble, fmt::format("{} damaged bytes", summary.damaged_bytes));
  if (summary.missing_segments > 0) add_words(trouble, fmt::format("{} missing segments", summary.missing_segments));
  if (summary.lost_events > 0) add_words(trouble, fmt::format("{} events not recorded", summary.lost_events));
  if (summary.malformed > 0)
    add_words(trouble, fmt::format("{} messages that this version cannot read", summary.malformed));
  if (summary.rig_toml.empty())
    add_words(trouble, "no rig.toml");
  else if (row.estimator.empty())
    add_words(trouble, "a rig.toml or azimuth.toml that this version cannot read");
  if (summary.poses == 0) add_words(trouble, "no poses");
  return trouble;
}

}  // namespace

CatalogueRow row_of(const FoundLog& found, const LogSummary& summary) {
  CatalogueRow row;
  row.found = found;
  row.summary = summary;
  row.start_utc = utc_text(summary.first_us);
  row.duration_s = kMicroseconds * (static_cast<double>(summary.last_us) - static_cast<double>(summary.first_us));
  row.robot = robot_of(summary);
  row.version = summary.version;
  row.estimator = estimator_of(summary);
  row.health = shares_of(summary.health_s);
  row.trouble = trouble_of(row);
  return row;
}

CatalogueRow row_of(const FoundLog& found, const FileErrors& errors) {
  CatalogueRow row;
  row.found = found;
  row.trouble = errors.front().message;
  return row;
}

}  // namespace azimuth
