#include "tools/compare/report_files.hpp"

#include <algorithm>
#include <system_error>

#include "base/files.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

/// Upper limit of the file size. A report normally has some kilobytes.
constexpr std::uintmax_t kLargest_bytes = 4'000'000;

std::vector<fs::path> files_below(const fs::path& folder, FileErrors& errors) {
  std::vector<fs::path> files;
  std::error_code problem;
  fs::recursive_directory_iterator each(folder, problem);
  for (; !problem && each != fs::recursive_directory_iterator(); each.increment(problem))
    if (each->path().extension() == ".json" && each->is_regular_file(problem)) files.push_back(each->path());
  if (problem) errors.push_back({folder.string(), 0, "cannot be read: " + problem.message()});
  std::ranges::sort(files);
  return files;
}

void add_report(const fs::path& file, Reports& reports) {
  std::error_code problem;
  FileResult<RunReport> report = failure({file.string(), 0, "is too large for a report"});
  if (fs::file_size(file, problem) <= kLargest_bytes || problem) {
    const FileResult<std::string> text = read_text_file(file);
    report = text ? read_report(*text, file.string()) : FileResult<RunReport>(failure(text.error()));
  }
  if (report)
    reports.all.push_back(*std::move(report));
  else
    reports.unreadable.push_back(report.error().front());
}

}  // namespace

Reports read_reports(std::span<const fs::path> places, const Progress& progress) {
  Reports reports;
  for (const fs::path& place : places) {
    std::error_code problem;
    if (!fs::is_directory(place, problem)) {
      add_report(place, reports);
      continue;
    }
    const std::vector<fs::path> files = files_below(place, reports.unreadable);
    if (files.empty()) reports.unreadable.push_back({place.string(), 0, "has no report in it (*.json)"});
    for (std::size_t i = 0; i < files.size(); ++i) {
      add_report(files[i], reports);
      if (progress) progress(i + 1, files.size());
    }
  }
  return reports;
}

}  // namespace azimuth
