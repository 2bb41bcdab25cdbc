#pragma once
// Internal to drivers/io.

#include <cstddef>
#include <string>
#include <utility>

#include "base/file_result.hpp"
#include "drivers/io/run.hpp"

namespace azimuth {

/// Collects what is wrong with one file: the first kMaxFileErrors in full, then only their number.
class FileErrorList {
 public:
  explicit FileErrorList(std::string file) : file_(std::move(file)) {}

  void add(int line, std::string message) {
    if (count_++ < kMaxFileErrors) errors_.push_back({file_, line, std::move(message)});
  }

  bool empty() const { return count_ == 0; }
  const std::string& file() const { return file_; }

  /// Appends everything to `all`.
  void move_to(FileErrors& all) && {
    if (count_ > kMaxFileErrors) {
      errors_.push_back({file_, 0, "and " + std::to_string(count_ - kMaxFileErrors) + " more errors"});
    }
    for (FileError& error : errors_) all.push_back(std::move(error));
  }

 private:
  std::string file_;
  FileErrors errors_;
  std::size_t count_ = 0;
};

}  // namespace azimuth
