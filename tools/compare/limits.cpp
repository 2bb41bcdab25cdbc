#include "tools/compare/limits.hpp"

#include <vector>

#include "settings/reader.hpp"

namespace azimuth {
namespace {

constexpr double kMost = 1e9;

/// The counts of the table [reports].
struct Allowed {
  int missing = 0, failed = 0, unreadable = 0, twice = 0;
};

Section top_section(CompareSettings& settings) {
  return {"",
          "",
          {{"chance_of_false_alarm", &settings.chance_of_false_alarm,
            "That any run is called worse though nothing but seeds differs.", above_to(0, 0.5)}}};
}

Section reports_section(Allowed& allowed) {
  return {"reports",
          "Of reports, so many may be",
          {{"missing", &allowed.missing, "in the baseline alone.", from_to(0, kMost)},
           {"failed", &allowed.failed, "of runs of which nothing came.", from_to(0, kMost)},
           {"unreadable", &allowed.unreadable, "cut or no reports.", from_to(0, kMost)},
           {"twice", &allowed.twice, "of a name and seed that another one has.", from_to(0, kMost)}}};
}

Section figure_section(const Figure& figure, FigureLimits& limits) {
  return {figure.key,
          figure.label,
          {{"relative", &limits.relative, "A run may grow worse by this part.", from_to(0, kMost)},
           {"absolute", &limits.absolute, "And by this.", from_to(0, kMost)},
           {"good_enough", &limits.good_enough, "What is no worse than this is no trouble.", from_to(0, kMost)},
           {"mean", &limits.mean, "The average of runs may grow worse by this.", from_to(0, kMost)},
           {"worst", &limits.worst, "No run may be worse than this.", from_to(0, kMost)}}};
}

}  // namespace

FileResult<CompareSettings> read_limits(std::string_view text, const std::string& file) {
  CompareSettings settings = default_compare_settings();
  Allowed allowed;
  std::vector<Section> sections{top_section(settings), reports_section(allowed)};
  for (std::size_t i = 0; i < kFigures; ++i) sections.push_back(figure_section(figures()[i], settings.limits[i]));
  const std::vector<Section*> tables = pointers(sections);
  if (FileErrors errors = read_toml(text, file, tables); !errors.empty()) return failure(std::move(errors));
  settings.missing = static_cast<std::size_t>(allowed.missing);
  settings.failed = static_cast<std::size_t>(allowed.failed);
  settings.unreadable = static_cast<std::size_t>(allowed.unreadable);
  settings.twice = static_cast<std::size_t>(allowed.twice);
  return settings;
}

}  // namespace azimuth
