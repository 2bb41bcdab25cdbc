#pragma once
// What subcommands share that write a page of runs.

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

/// As the command line gives them.
struct HtmlWishes {
  std::filesystem::path file;  ///< empty: no page is written
  bool for_window = false;     ///< runs() is asked for all the same
  std::size_t pictures = PictureLimits{}.pictures;
};

/// Adds --html and --html-pictures.
void add_html_options(CLI::App& command, HtmlWishes& wishes);

/// One page of one or several runs. Not asked for, it does nothing.
///
/// Thread contract: thread-bound.
class HtmlOutput {
 public:
  HtmlOutput(HtmlWishes wishes, std::size_t runs) : wishes_(std::move(wishes)), runs_(runs) {}

  /// Begins with a run, which it borrows until add() or the next call: what is to look on at its replay, not longer.
  ReplayWatch watch(const ReplaySetup& setup);
  /// Its outcome; one without a step is left out.
  void add(const ReplaySetup& setup, const ReplayResult& result, const Report& report);
  /// As page_data() takes them.
  const std::vector<nlohmann::ordered_json>& runs() const { return done_; }
  /// Fails where the file cannot be written. Without a run there is nothing to write.
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
