#pragma once
// How reading and writing files goes wrong: all of it at once, each with its place.

#include <cassert>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace azimuth {

/// One thing wrong with a file.
struct FileError {
  std::string file;
  int line = 0;  ///< from 1; 0: the file as a whole
  std::string message;

  /// `file:line: message`, the form editors jump to; without the line when it is 0.
  std::string text() const;
};

using FileErrors = std::vector<FileError>;

/// One line each.
std::string text(const FileErrors& errors);

/// A value, or everything that stood in its way (C++23's std::expected, as far as files need it).
template <class T>
class [[nodiscard]] FileResult {
 public:
  // Implicit, so that a function returns a value or errors as they are. NOLINTBEGIN(google-explicit-constructor)
  FileResult(T value) : content_(std::move(value)) {}
  FileResult(FileErrors errors) : content_(std::move(errors)) { assert(!this->errors().empty()); }
  FileResult(FileError error) : content_(FileErrors{std::move(error)}) {}
  // NOLINTEND(google-explicit-constructor)

  explicit operator bool() const { return content_.index() == 0; }

  /// Only when true.
  T& operator*() & { return std::get<0>(content_); }
  const T& operator*() const& { return std::get<0>(content_); }
  T&& operator*() && { return std::get<0>(std::move(content_)); }
  T* operator->() { return &std::get<0>(content_); }
  const T* operator->() const { return &std::get<0>(content_); }

  /// Only when false.
  const FileErrors& errors() const { return std::get<1>(content_); }

 private:
  std::variant<T, FileErrors> content_;
};

}  // namespace azimuth
