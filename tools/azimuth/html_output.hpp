#pragma once
// The page of runs that --html writes, shared by the subcommands.

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "tools/azimuth/replay_run.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay_page/page_pictures.hpp"
#include "tools/replay_page/step_log.hpp"

namespace azimuth {

/// The options of the page on the command line.
struct HtmlWishes {
  std::filesystem::path file;  ///< empty: no page is written
  bool for_window = false;     ///< runs() is used even without a file
  std::size_t pictures = PictureLimits{}.pictures;
};

/// Adds --html and --html-pictures.
void add_html_options(CLI::App& command, HtmlWishes& wishes);

/// One page of one or several runs. Without a request for a page the class does nothing.
///
/// Thread contract: thread-bound.
class HtmlOutput {
 public:
  HtmlOutput(HtmlWishes wishes, std::size_t runs) : wishes_(std::move(wishes)), runs_(runs) {}

  /// Begins a run and returns the watch for its replay. The object borrows `setup` until add() or the next watch().
  ReplayWatch watch(const ReplaySetup& setup);
  /// Adds the outcome of the run. A run without a step is left out.
  void add(const ReplaySetup& setup, const ReplayResult& result, const Report& report);
  /// The added runs in the form that page_data() takes.
  const std::vector<nlohmann::ordered_json>& runs() const { return done_; }
  /// Writes the page, if there is a run. Fails if the file cannot be written.
  void write() const;

 private:
  bool is_wanted() const { return !wishes_.file.empty() || wishes_.for_window; }

  HtmlWishes wishes_;
  std::size_t runs_;
  StepLog log_;
  std::optional<PagePictures> pictures_;
  std::vector<nlohmann::ordered_json> done_;
};

}  // namespace azimuth
