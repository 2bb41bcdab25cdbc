#pragma once
// Errors of reading and writing files and of settings: all errors at once, each with its position.

#include <cassert>
#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace azimuth {

/// One error in a file, or in an override on the command line.
struct FileError {
  std::string file;  ///< As given to the reader, or the override itself
  int line = 0;      ///< From 1; 0: the whole file
  std::string message;
  int column = 0;  ///< From 1; 0: the whole line

  /// `file:line:column: message`, the form that editors understand; parts that are 0 are omitted. One line, escaped by
  /// visible().
  std::string text() const;
};

/// An error with the text `what` and the system's reason.
FileError system_error(std::string file, std::string_view what, int error_number);

using FileErrors = std::vector<FileError>;

/// One line for each error.
std::string text(const FileErrors& errors);

/// A value, or all the errors that prevented it (at least one). For void: success or the errors.
template <class T>
using FileResult = tl::expected<T, FileErrors>;

/// The return value of a function that failed.
inline tl::unexpected<FileErrors> failure(FileErrors errors) {
  assert(!errors.empty());
  return tl::unexpected<FileErrors>(std::move(errors));
}
inline tl::unexpected<FileErrors> failure(FileError error) { return failure(FileErrors{std::move(error)}); }

/// Collects the errors of one file: the first kMost in full, then only their number.
class FileErrorList {
 public:
  static constexpr std::size_t kMost = 20;

  explicit FileErrorList(std::string file) : file_(std::move(file)) {}

  void add(int line, std::string message);

  bool empty() const { return count_ == 0; }
  const std::string& file() const { return file_; }

  /// Appends all errors to `all`.
  void move_to(FileErrors& all) &&;

 private:
  std::string file_;
  FileErrors errors_;
  std::size_t count_ = 0;
};

}  // namespace azimuth
