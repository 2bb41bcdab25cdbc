#pragma once
#include <filesystem>

#include "drivers/storage/write_run_log.hpp"

namespace azimuth {

/// A run that is being made. What ends before it is finished leaves nothing of it behind, and what was there before as
/// it was.
///
/// Thread contract: thread-bound.
class UnfinishedRun {
 public:
  /// `out` as write_run() takes it.
  explicit UnfinishedRun(std::filesystem::path out);
  ~UnfinishedRun();
  UnfinishedRun(const UnfinishedRun&) = delete;
  UnfinishedRun& operator=(const UnfinishedRun&) = delete;

  /// Where the files of images are put, as they are named in `out`, until the run is finished.
  const std::filesystem::path& files() const { return files_; }

  /// Takes the files into the run and writes it; fails as write_run() does.
  void finish(const Run& run, const WriteProgress& progress = {});

 private:
  std::filesystem::path out_, files_;
  bool was_there_;
  bool finished_ = false;
};

}  // namespace azimuth
