#pragma once
// A replay as the page shows it (tools/page/report.js): one object of JSON a run, of bounded size however long the run.

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "drivers/storage/run.hpp"
#include "slam/perception/colour/colour_settings.hpp"
#include "tools/evaluate/health_report.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay_page/page_pictures.hpp"
#include "tools/replay_page/step_log.hpp"

namespace azimuth {

/// Instants that a page shows of all its runs together; each run has an equal share.
inline constexpr std::size_t kMostPageInstants = 24000;
/// Stretches of equal health that a page shows of a run. Of more than these the short ones are put together, each under
/// the worst health within it.
inline constexpr std::size_t kMostHealthStretches = 1000;

/// What the page is made of. Borrows all of it.
struct PageSource {
  const Run& run;
  const ReplayResult& result;
  const Report& report;
  std::span<const PageStep> steps;        ///< one for each estimate
  std::span<const PagePicture> pictures;  ///< may be empty
  std::span<const ColourClass> classes;   ///< of the colour front end
};

/// A stretch of one health and one reason, in seconds since the first step.
struct HealthStretch {
  double from_s = 0.0, to_s = 0.0;
  Health health = Health::starting;
  std::string_view reason;
};

/// In order, each ending where the next one begins, at most `most` of them, which is more than 1.
std::vector<HealthStretch> health_stretches(std::span<const StepHealth> steps, std::size_t most);

/// Of a page with `runs` runs. At least one step was made.
nlohmann::ordered_json page_run(const PageSource& source, std::size_t runs);

/// What a page of them shows: one object of JSON, in ASCII.
std::string page_data(const std::vector<nlohmann::ordered_json>& runs, const std::string& made_by);
/// The whole page.
std::string replay_page(const std::vector<nlohmann::ordered_json>& runs, const std::string& made_by);

}  // namespace azimuth
