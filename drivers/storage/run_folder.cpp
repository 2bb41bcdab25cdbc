#include "drivers/storage/run_folder.hpp"

#include <algorithm>
#include <functional>

#include "base/file_result.hpp"
#include "base/files.hpp"
#include "drivers/storage/frame_reader.hpp"
#include "drivers/storage/tables.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

/// Reads the files of one folder, and collects all errors in `errors`.
struct FolderReader {
  fs::path folder;
  FileErrors errors;

  bool has(const char* name) const {
    std::error_code ignored;
    return fs::exists(folder / name, ignored);
  }

  std::optional<std::string> text(const fs::path& file) {
    FileResult<std::string> text = read_text_file(file);
    if (text) return *std::move(text);
    errors.insert(errors.end(), text.error().begin(), text.error().end());
    return std::nullopt;
  }

  /// The text of rig.toml; empty when it may come later, or when an error has been added.
  std::string rig(const fs::path& file, const LogOptions& options) {
    if (!options.rig_file.empty() || has(kRigFile) || !has(kOdometryFile)) return text(file).value_or("");
    if (!options.rig_may_come_later)
      errors.push_back(
          {file.string(), 0,
           "there is none yet; give one with --rig FILE, or make one first: " + first_rig(folder, has(kFramesFile))});
    return {};
  }

  /// The result of `read(table, errors, more...)` for the named table.
  template <class Read, class... More>
  auto table(const char* name, Read read, More&... more) {
    const std::optional<std::string> content = text(folder / name);
    using Rows = decltype(read(TableText{}, errors, more...));
    return content ? read(TableText{*content, (folder / name).string()}, errors, more...) : Rows{};
  }
};

/// Refuses data that tables cannot hold.
FileResult<void> refuse(const Run& run, const fs::path& folder) {
  const auto unfit = std::ranges::find_if_not(run.bearings, fits_table);
  if (unfit != run.bearings.end()) {
    return failure(FileError{(folder / kBearingsFile).string(), 0,
                             "cannot hold what features look like, as they do at " +
                                 std::to_string(to_seconds(unfit->stamp)) + " s; an LCM log can"});
  }
  const auto bad_kind = [](const TrueLandmark& landmark) { return !fits_field(landmark.kind); };
  if (std::ranges::any_of(run.landmarks, bad_kind)) {
    return failure(
        FileError{(folder / kLandmarksFile).string(), 0, "cannot hold a kind with commas or control characters"});
  }
  const auto raw = [](const FrameFile& frame) { return frame.part && frame.part->format.pixels != PixelFormat::mjpeg; };
  if (std::ranges::any_of(run.frames, raw)) {
    return failure(
        FileError{(folder / kFramesFile).string(), 0, "cannot hold uncompressed images without loss; an LCM log can"});
  }
  const auto bad_name = [](const FrameFile& frame) { return !fits_field(frame.file); };
  if (std::ranges::any_of(run.frames, bad_name)) {
    return failure(
        FileError{(folder / kFramesFile).string(), 0, "cannot hold a path with commas or control characters"});
  }
  return {};
}

/// Writes the table, or removes one that an earlier run left there.
FileResult<void> write_or_remove(const fs::path& file, bool wanted, const std::string& text) {
  if (wanted) return write_text_file(file, text);
  std::error_code error;
  fs::remove(file, error);
  if (error) return failure(system_error(file, "cannot be removed", error.value()));
  return {};
}

/// The file name of image `number` of a log.
std::string frame_name(std::size_t number) {
  std::string digits = std::to_string(number);
  return "frames/" + std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits + ".jpg";
}

/// The frames with the names of their files. Frames inside a log are written to files. An unreadable frame becomes an
/// empty file, which is unreadable as well.
FileResult<std::vector<FrameFile>> frames_as_files(const Run& run, const fs::path& folder) {
  std::vector<FrameFile> frames = run.frames;
  FrameReader reader(run.folder);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].part) continue;
    std::error_code error;
    fs::create_directories(folder / "frames", error);
    if (error) return failure(system_error(folder / "frames", "cannot be made", error.value()));
    const Bytes jpeg = reader.read(frames[i]).bytes;
    frames[i] = {frames[i].stamp, frame_name(i)};
    const std::string_view text(reinterpret_cast<const char*>(jpeg.data()), jpeg.size());
    if (auto written = write_text_file(folder / frames[i].file, text); !written) return failure(written.error());
  }
  return frames;
}

}  // namespace

std::string first_rig(const fs::path& folder, bool has_images) {
  const std::string rig = (folder / kRigFile).string();
  const std::string own = "azimuthd --print-rig-settings > " + rig +
                          ", every key at its default, to be changed there (camera.identities = true where bearings "
                          "carry names)";
  const std::string found = "azimuth calibrate " + folder.string() + " --out " + rig;
  return found + (has_images ? ", for a mirror camera; or " : ", where bearings carry names; or ") + own;
}

FileResult<Run> read_run_folder(const fs::path& folder, const LogOptions& options) {
  FolderReader reader{folder, {}};
  Run run;
  std::error_code ignored;
  run.name = fs::weakly_canonical(folder, ignored).filename().string();
  run.folder = folder;
  run.rig_file = (options.rig_file.empty() ? folder / kRigFile : options.rig_file).string();
  run.rig_toml = reader.rig(run.rig_file, options);
  run.odometry = reader.table(kOdometryFile, read_odometry_table, run.skipped.odometry_not_in_order);
  if (reader.has(kBearingsFile)) run.bearings = reader.table(kBearingsFile, read_bearings_table);
  if (reader.has(kFramesFile)) run.frames = reader.table(kFramesFile, read_frames_table);
  if (reader.has(kTruthFile)) run.truth = reader.table(kTruthFile, read_truth_table, run.skipped.truth_not_in_order);
  if (reader.has(kLandmarksFile)) run.landmarks = reader.table(kLandmarksFile, read_landmarks_table);
  if (!options.odometry_alone && !reader.has(kBearingsFile) && !reader.has(kFramesFile)) {
    reader.errors.push_back({folder.string(), 0, "has neither bearings.csv nor frames.csv"});
  }
  if (!reader.errors.empty()) return failure(std::move(reader.errors));
  return run;
}

FileResult<void> write_run_folder(const Run& run, const fs::path& folder) {
  if (auto fits = refuse(run, folder); !fits) return fits;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return failure(system_error(folder, "cannot be made", error.value()));
  if (!run.rig_toml.empty())
    if (auto written = write_text_file(folder / kRigFile, run.rig_toml); !written) return written;
  if (auto written = write_text_file(folder / kOdometryFile, odometry_table(run.odometry)); !written) return written;
  const auto write = [&folder](const char* name, const auto& rows, auto table) {
    return write_or_remove(folder / name, !rows.empty(), table(rows));
  };
  if (auto written = write(kBearingsFile, run.bearings, bearings_table); !written) return written;
  const FileResult<std::vector<FrameFile>> frames = frames_as_files(run, folder);
  if (!frames) return failure(frames.error());
  if (auto written = write(kFramesFile, *frames, frames_table); !written) return written;
  if (auto written = write(kTruthFile, run.truth, truth_table); !written) return written;
  return write(kLandmarksFile, run.landmarks, landmarks_table);
}

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
