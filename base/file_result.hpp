#pragma once
// How reading and writing files goes wrong, and their settings: all of it at once, each with its place.

#include <cassert>
#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace azimuth {

/// One thing wrong with a file, or with an override of the command line.
struct FileError {
  std::string file;  ///< as given to the reader, or the override itself
  int line = 0;      ///< from 1; 0: the file as a whole
  std::string message;
  int column = 0;  ///< from 1; 0: the line as a whole

  /// `file:line:column: message`, the form editors jump to; without what is 0. One line, as visible() shows it.
  std::string text() const;
};

/// `what`, and why the system says so.
FileError system_error(std::string file, std::string_view what, int error_number);

using FileErrors = std::vector<FileError>;

/// One line each.
std::string text(const FileErrors& errors);

/// A value, or everything that stood in its way, which is one error at least. void: whether it was done.
template <class T>
using FileResult = tl::expected<T, FileErrors>;

/// For a function to return that has no value.
inline tl::unexpected<FileErrors> failure(FileErrors errors) {
  assert(!errors.empty());
  return tl::unexpected<FileErrors>(std::move(errors));
}
inline tl::unexpected<FileErrors> failure(FileError error) { return failure(FileErrors{std::move(error)}); }

/// Collects what is wrong with one file: the first kMost in full, then only their number.
class FileErrorList {
 public:
  static constexpr std::size_t kMost = 20;

  explicit FileErrorList(std::string file) : file_(std::move(file)) {}

  void add(int line, std::string message);

  bool empty() const { return count_ == 0; }
  const std::string& file() const { return file_; }

  /// Appends everything to `all`.
  void move_to(FileErrors& all) &&;

 private:
  std::string file_;
  FileErrors errors_;
  std::size_t count_ = 0;
};

}  // namespace azimuth
