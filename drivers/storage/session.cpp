#include "drivers/storage/session.hpp"

#include <algorithm>
#include <charconv>

namespace azimuth {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kExtension = ".lcm";
constexpr std::size_t kLeastDigits = 3;

/// Takes a decimal number from the beginning of `text`.
std::optional<std::uint64_t> take_number(std::string_view& text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

}  // namespace

std::string segment_name(std::uint64_t number) {
  std::string digits = std::to_string(number);
  if (digits.size() < kLeastDigits) digits.insert(0, kLeastDigits - digits.size(), '0');
  return digits.append(kExtension);
}

std::optional<std::uint64_t> segment_number(std::string_view name) {
  std::string_view rest = name;
  const std::optional<std::uint64_t> number = take_number(rest);
  return number && segment_name(*number) == name ? number : std::nullopt;
}

std::vector<SegmentFile> session_segments(const fs::path& folder) {
  std::vector<SegmentFile> segments;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const auto number = segment_number(entry->path().filename().string());
    if (number) segments.push_back({*number, entry->path()});
  }
  std::ranges::sort(segments, {}, &SegmentFile::number);
  return segments;
}

std::string to_text(const SegmentMark& mark) {
  return "number = " + std::to_string(mark.number) + "\nlost_events = " + std::to_string(mark.lost_events) + '\n';
}

std::optional<SegmentMark> parse_segment_mark(std::string_view text) {
  if (!take(text, "number = ")) return std::nullopt;
  const auto number = take_number(text);
  if (!number || !take(text, "\nlost_events = ")) return std::nullopt;
  const auto lost_events = take_number(text);
  if (!lost_events || text != "\n") return std::nullopt;
  return SegmentMark{*number, *lost_events};
}

}  // namespace azimuth
