#include "tools/compare/report_files.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "base/files.hpp"
#include "tools/compare/inference.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

using Parsed = nlohmann::json;
using MemberPath = std::array<std::string_view, 3>;

constexpr std::size_t kLongestName = 300, kMostTexts = 100;
constexpr int kMostLevels = 32;                   // limit of the nesting depth; reports have five levels
constexpr std::size_t kLongestIncomplete = 1000;  // limit of the text's length [bytes]

struct TooDeep : std::exception {};

std::string text_of(const MemberPath& path) {
  std::string text;
  for (const std::string_view part : path)
    if (!part.empty()) text.append(text.empty() ? "" : ".").append(part);
  return text;
}

/// The value at a path; null if it does not exist.
const Parsed& at(const Parsed& json, const MemberPath& path) {
  static const Parsed kNull;
  const Parsed* found = &json;
  for (const std::string_view part : path) {
    if (part.empty()) return *found;
    if (!found->is_object() || !found->contains(part)) return kNull;
    found = &(*found)[std::string(part)];
  }
  return *found;
}

/// Reads the members of a report and collects errors.
class ReportReader {
 public:
  ReportReader(const Parsed& json, const std::string& file) : json_(json), errors_(file) {}

  FileResult<RunReport> read() {
    RunReport report;
    report.file = errors_.file();
    report.is_older = !json_.contains("name");
    report.name = text(report.is_older || json_["name"].is_null() ? "run" : "name");
    if (report.name.empty()) errors_.add(0, "is no report of azimuth replay: it has neither name nor run");
    report.tags = texts("tags");
    report.failure = text("failure");
    if (report.failure.empty()) read_outcome(report);
    if (errors_.empty()) return report;
    FileErrors errors;
    std::move(errors_).move_to(errors);
    return failure(std::move(errors));
  }

 private:
  void read_outcome(RunReport& report) {
    if (!at(json_, {"pose"}).is_object() || !at(json_, {"time_us"}).is_object())
      errors_.add(0, "is no report of azimuth replay: it has no pose and time_us");
    report.overrides = texts("overrides");
    report.estimator = text("estimator");
    report.made_by = text("made_by");
    report.digest = text("digest");
    report.incomplete = text("incomplete", kLongestIncomplete);
    const Parsed& seed = at(json_, {"seed"});
    if (seed.is_number_unsigned()) report.seed = seed.get<std::uint64_t>();
    for (std::size_t i = 0; i < kFigures; ++i) report.values[i] = value(figures()[i]);
  }

  std::string text(std::string_view key, std::size_t longest = kLongestName) {
    const Parsed& found = at(json_, {key});
    if (found.is_null()) return {};
    if (found.is_string() && found.get_ref<const std::string&>().size() <= longest) return found;
    errors_.add(0, std::string(key) + " is no text of " + std::to_string(longest) + " bytes at most");
    return {};
  }

  std::vector<std::string> texts(std::string_view key) {
    const Parsed& found = at(json_, {key});
    std::vector<std::string> all;
    if (found.is_null()) return all;
    bool good = found.is_array() && found.size() <= kMostTexts;
    for (std::size_t i = 0; good && i < found.size(); ++i) {
      good = found[i].is_string() && found[i].get_ref<const std::string&>().size() <= kLongestName;
      if (good) all.push_back(found[i]);
    }
    if (good) return all;
    errors_.add(0, std::string(key) + " is no list of texts");
    return {};
  }

  double number(const MemberPath& path) {
    const Parsed& found = at(json_, path);
    if (found.is_null()) return kNoNumber;
    const double value = found.is_number() ? found.get<double>() : -1.0;
    if (value >= 0.0 && std::isfinite(value)) return value;
    errors_.add(0, text_of(path) + " is neither null nor a number of 0 at least");
    return kNoNumber;
  }

  double value(const Figure& figure) {
    const double part = number(figure.path);
    const double whole = figure.total.front().empty() ? 1.0 : number(figure.total);
    const double value = whole > 0.0 ? part / whole : kNoNumber;
    if (figure.better != Better::higher || !(value > 1.0)) return value;
    if (value > 1.0 + 1e-9) errors_.add(0, text_of(figure.path) + " is more than all");
    return 1.0;
  }

  const Parsed& json_;
  FileErrorList errors_;
};

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

FileResult<RunReport> read_report(std::string_view text, const std::string& file) {
  Parsed json;
  try {
    json = Parsed::parse(text, [](int depth, Parsed::parse_event_t, const Parsed&) {
      if (depth > kMostLevels) throw TooDeep();
      return true;
    });
  } catch (const TooDeep&) {
    return failure({file, 0, "is deeper than any report of azimuth replay"});
  } catch (const Parsed::exception&) {
    // The message covers truncated files and other syntax errors alike.
    return failure({file, 0, text.empty() ? "is empty" : "is cut short, or no JSON"});
  }
  if (!json.is_object()) return failure({file, 0, "is no report of azimuth replay: it is no object"});
  return ReportReader(json, file).read();
}

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
