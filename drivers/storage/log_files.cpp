#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <span>
#include <system_error>
#include <utility>

#include "base/packed_file.hpp"
#include "drivers/storage/each_event.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

/// The next part of a log, e.g. drive.lcm.01 after drive.lcm.00; empty when the name does not end in a number.
fs::path next_part(const fs::path& file) {
  std::string digits = file.extension().string();
  const auto is_digit = [](char each) { return std::isdigit(static_cast<unsigned char>(each)) != 0; };
  if (digits.size() < 3 || !std::all_of(digits.begin() + 1, digits.end(), is_digit)) return {};
  std::size_t at = digits.size() - 1;
  for (; digits[at] == '9'; --at) digits[at] = '0';
  if (digits[at] == '.')
    digits.insert(1, "1");
  else
    ++digits[at];
  return fs::path(file).replace_extension(digits);
}

}  // namespace

std::vector<fs::path> log_files(const fs::path& log_or_session) {
  std::error_code ignored;
  std::vector<fs::path> files;
  if (fs::is_directory(log_or_session, ignored)) {
    for (SegmentFile& segment : session_segments(log_or_session)) files.push_back(std::move(segment.file));
    return files;
  }
  files.push_back(log_or_session);
  for (fs::path next = next_part(log_or_session); !next.empty() && fs::is_regular_file(next, ignored);
       next = next_part(next))
    files.push_back(next);
  return files;
}

std::string no_log(const fs::path& file) {
  std::array<char, 64> start{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), start.size());
  const Bytes begin = std::as_bytes(std::span(start)).first(static_cast<std::size_t>(stream.gcount()));
  for (const std::string_view answer : {imported_as(begin), packed_as(begin)})
    if (!answer.empty()) return std::string(answer);
  return "is not an LCM log: it holds no whole event";
}

}  // namespace azimuth
