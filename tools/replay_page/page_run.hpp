#pragma once
// Data of a replay for the page (tools/page/report.js): one JSON object per run, of bounded size for runs of any
// length.

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

/// Largest number of instants on a page, for all runs together. Each run has an equal share.
inline constexpr std::size_t kMostPageInstants = 24000;
/// Largest number of stretches of equal health per run on a page. If there are more, short stretches are merged, and a
/// merged stretch has the worst health in it.
inline constexpr std::size_t kMostHealthStretches = 1000;

/// Input for the page. Borrows all members.
struct PageSource {
  const Run& run;
  const ReplayResult& result;
  const Report& report;
  std::span<const PageStep> steps;        ///< one for each estimate
  std::span<const PagePicture> pictures;  ///< may be empty
  std::span<const ColourClass> classes;   ///< colour classes of the colour front end
};

/// A period of one health and one reason, in seconds since the first step.
struct HealthStretch {
  double from_s = 0.0, to_s = 0.0;
  Health health = Health::starting;
  std::string_view reason;
};

/// The stretches in order. Each one ends where the next begins. `most`: largest number of stretches, more than 1.
std::vector<HealthStretch> health_stretches(std::span<const StepHealth> steps, std::size_t most);

/// The data of one run for a page with `runs` runs. Precondition: the run has at least one step.
nlohmann::ordered_json page_run(const PageSource& source, std::size_t runs);

/// The data of a page with these runs: one JSON object in ASCII.
std::string page_data(const std::vector<nlohmann::ordered_json>& runs, const std::string& made_by);
/// The complete HTML page.
std::string replay_page(const std::vector<nlohmann::ordered_json>& runs, const std::string& made_by);

}  // namespace azimuth
