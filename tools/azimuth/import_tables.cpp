// azimuth import: the import of tables.

#include <initializer_list>
#include <optional>
#include <utility>

#include "base/files.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/import_options.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/import/foreign_images.hpp"
#include "tools/import/foreign_samples.hpp"
#include "tools/import/foreign_table.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

/// Reads tables and gathers the errors of all of them, before anything is refused.
struct TableReader {
  FileErrors errors;

  template <class Value>
  std::optional<Value> value_of(FileResult<Value> result) {
    if (result) return *std::move(result);
    errors.insert(errors.end(), result.error().begin(), result.error().end());
    return std::nullopt;
  }

  /// Returns the rows that `read(table)` makes of a file. The rows are empty without a file, or if it has errors.
  template <class Read>
  auto rows(const fs::path& file, const std::string& columns, const char* option, Read read) {
    using Rows = typename decltype(read(ForeignText{}))::value_type;
    if (file.empty()) return Rows{};
    std::optional<std::string> text = value_of(read_text_file(file));
    if (!text) return Rows{};
    const std::string utf8 = in_utf8(*std::move(text));
    return value_of(read(ForeignText{utf8, file.string(), columns, option})).value_or(Rows{});
  }
};

std::string unit_in(const std::string& stamps) {
  constexpr std::size_t kName = 4;  // letters of "name"
  return stamps.size() == kName ? "s" : stamps.substr(kName + 1, stamps.size() - kName - 2);
}

/// Whether the stamps are in the files' names (name, name[ns]) and not in a table.
bool are_in_names(const std::string& stamps) {
  return stamps == "name" || (stamps.starts_with("name[") && stamps.ends_with(']'));
}

std::vector<SourceImage> read_images(const ImportOptions& options, TableReader& reader, std::uint64_t& empty) {
  if (options.images.empty()) return {};
  if (are_in_names(options.stamps))
    return reader.value_of(images_by_name(options.images, unit_in(options.stamps), empty))
        .value_or(std::vector<SourceImage>{});
  return reader.rows(options.stamps, options.stamps_columns, "--stamps-columns",
                     [&](const ForeignText& table) { return images_by_table(options.images, table, empty); });
}

Run read_run(const ImportOptions& options, std::vector<SourceImage>& images, std::vector<std::string>& sentences) {
  Run run;
  TableReader reader;
  TableNotes odometry, bearings, truth;
  run.odometry = reader.rows(options.source, options.columns, "--columns", [&](const ForeignText& table) {
    return foreign_odometry(table, options.wheels, odometry);
  });
  run.bearings = reader.rows(options.bearings, options.bearings_columns, "--bearings-columns",
                             [&](const ForeignText& table) { return foreign_bearings(table, bearings); });
  run.truth = reader.rows(options.truth, options.truth_columns, "--truth-columns",
                          [&](const ForeignText& table) { return foreign_truth(table, truth); });
  images = read_images(options, reader, run.skipped.empty_images);
  if (!reader.errors.empty()) refuse(reader.errors);
  run.skipped.odometry_not_in_order = odometry.repeated;
  run.skipped.truth_not_in_order = truth.repeated;
  for (const TableNotes* notes : {&odometry, &bearings, &truth})
    sentences.insert(sentences.end(), notes->sentences.begin(), notes->sentences.end());
  return run;
}

/// Refuses columns of a table that was not given; otherwise they would be ignored silently.
void check_columns(const ImportOptions& options) {
  const auto needs = [](const std::string& columns, const char* option, bool there, const char* table) {
    if (!columns.empty() && !there) refuse(std::string(option) + " needs " + table);
  };
  needs(options.bearings_columns, "--bearings-columns", !options.bearings.empty(), "--bearings FILE");
  needs(options.truth_columns, "--truth-columns", !options.truth.empty(), "--truth FILE");
  needs(options.stamps_columns, "--stamps-columns", !are_in_names(options.stamps), "--stamps FILE");
  needs(options.odometry, "--odometry", false, "a bag; of tables, SOURCE is the odometry");
  needs(options.joints, "--joints", false, "a bag");
  needs(options.senders.empty() ? "" : options.senders.front(), "--sender", false, "a bag");
}

}  // namespace

void import_tables(const ImportOptions& options) {
  if (options.out.empty()) refuse("azimuth import: OUT is required, a run folder or an LCM log");
  check_columns(options);
  check_import(options);
  std::vector<SourceImage> images;
  std::vector<std::string> sentences;
  Run run = read_run(options, images, sentences);
  find_rig(options, run);
  UnfinishedRun unfinished(options.out);
  if (is_log_name(options.out)) {
    for (const SourceImage& image : images) run.frames.push_back({image.stamp, image.file.string()});
  } else {
    ProgressBar bar(true);
    FileResult<std::vector<FrameFile>> frames =
        bring_images(images, options.out, unfinished.files(), shown_and_interruptible(bar));
    if (!frames) fail(frames.error());
    run.frames = *std::move(frames);
  }
  finish_import(options, run, sentences, unfinished);
}

}  // namespace azimuth
