#include "drivers/io/truth.hpp"

#include <utility>

#include "drivers/io/tables.hpp"
#include "drivers/io/text_file.hpp"

namespace azimuth {

FileErrors replace_truth(Run& run, const std::filesystem::path& truth_file,
                         const std::filesystem::path& landmarks_file) {
  FileErrors errors;
  const auto rows = [&errors]<class Read, class... More>(const std::filesystem::path& file, Read read, More&... more) {
    const FileResult<std::string> text = read_text_file(file);
    if (text) return read(TableText{*text, file.string()}, errors, more...);
    errors.insert(errors.end(), text.error().begin(), text.error().end());
    return decltype(read(TableText{}, errors, more...)){};
  };
  std::uint64_t not_in_order = 0;
  std::vector<TruthPose> truth = rows(truth_file, read_truth_table, not_in_order);
  std::vector<TrueLandmark> landmarks;
  if (!landmarks_file.empty()) landmarks = rows(landmarks_file, read_landmarks_table);
  if (!errors.empty()) return errors;
  run.truth = std::move(truth);
  run.skipped.truth_not_in_order = not_in_order;
  if (!landmarks_file.empty()) run.landmarks = std::move(landmarks);
  return {};
}

}  // namespace azimuth
