// Determines which files make up one bag.

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/files.hpp"
#include "drivers/wire/number_text.hpp"
#include "drivers/wire/text_lines.hpp"
#include "tools/import/bag_file.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMetadata = "metadata.yaml";

/// Name of a part. For example, drive_2020-01-31_7.bag is part 7 of the files whose names differ only in digits.
struct PartName {
  std::string alike;  ///< the name with # for each number, since names of parts may contain different times
  std::optional<std::int64_t> number;
};

PartName part_name(const fs::path& file) {
  const std::string name = file.filename().string();
  const fs::path short_name = file.stem();  // keeps .db3 of drive_0.db3.zstd
  const std::string stem = (short_name.has_extension() ? short_name.stem() : short_name).string();
  PartName part;
  if (const std::size_t last = stem.rfind('_'); last != std::string::npos)
    part.number = parse_integer(std::string_view(stem).substr(last + 1));
  for (const char each : name) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(each)) != 0;
    if (!is_digit || !part.alike.ends_with('#')) part.alike += is_digit ? '#' : each;
  }
  if (!part.number) part.alike = name;  // without a part number, digits belong to the name
  return part;
}

bool has_name_of_bag(const fs::path& file) {
  constexpr std::array<std::string_view, 3> kBagNames{".bag", ".mcap", ".db3"};
  const bool packed = file.extension() == ".zstd" || file.extension() == ".zst";
  return std::ranges::count(kBagNames, (packed ? file.stem() : file).extension().string()) > 0;
}

std::vector<fs::path> bags_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (has_name_of_bag(entry->path())) found.push_back(entry->path());
  std::ranges::sort(found);
  return found;
}

/// The names in relative_file_paths, without folders.
std::vector<std::string> names_in_metadata(const fs::path& folder) {
  std::vector<std::string> names;
  const FileResult<MappedFile> file = MappedFile::open(folder / kMetadata);
  std::string_view text = file ? as_text(file->bytes()) : std::string_view();
  bool is_list = false;
  while (!text.empty()) {
    std::string_view line = take_line(text);
    constexpr std::string_view kAround = " \t\r\"'";
    const std::size_t dash = line.find_first_not_of(" \t");
    const bool is_entry = dash != std::string_view::npos && line[dash] == '-';
    if (is_list && !is_entry) break;
    if (is_list) {
      line = line.substr(dash + 1);
      const std::size_t begin = std::min(line.find_first_not_of(kAround), line.size());
      line = line.substr(begin, line.find_last_not_of(kAround) + 1 - begin);
      names.push_back(fs::path(line).filename().string());
    }
    is_list = is_list || line.find("relative_file_paths:") != std::string_view::npos;
  }
  return names;
}

FileError wrong(const fs::path& folder, std::string why) { return {folder.string(), 0, std::move(why)}; }

FileResult<std::vector<fs::path>> by_metadata(const fs::path& folder, const std::vector<std::string>& names) {
  std::vector<fs::path> parts;
  std::string missing;
  for (const std::string& name : names) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / name, ignored))
      parts.push_back(folder / name);
    else
      missing += (missing.empty() ? "" : ", ") + name;
  }
  if (missing.empty()) return parts;
  return failure(wrong(folder, "lacks " + missing + ", which " + std::string(kMetadata) +
                                   " names; import one of the others by its name to do without"));
}

FileResult<std::vector<fs::path>> by_number(const fs::path& folder, std::vector<fs::path> files) {
  if (files.size() == 1) return files;
  const PartName first = part_name(files.front());
  const bool are_parts = std::ranges::all_of(files, [&](const fs::path& file) {
    const PartName name = part_name(file);
    return name.number && name.alike == first.alike;
  });
  if (!are_parts)
    return failure(wrong(folder, "holds " + std::to_string(files.size()) + " bags, such as " +
                                     files.front().filename().string() + " and " + files.back().filename().string() +
                                     ": import one of them by its name"));
  const auto number_of = [](const fs::path& file) { return *part_name(file).number; };
  std::ranges::sort(files, {}, number_of);
  for (std::size_t i = 1; i < files.size(); ++i)
    if (number_of(files[i]) != number_of(files[i - 1]) + 1)
      return failure(wrong(folder, "holds " + files[i - 1].filename().string() + " and then " +
                                       files[i].filename().string() +
                                       ": a part is missing, or they are of two recordings; import one by its name"));
  return files;
}

}  // namespace

FileResult<std::vector<fs::path>> bag_in_folder(const fs::path& folder) {
  if (const std::vector<std::string> names = names_in_metadata(folder); !names.empty())
    return by_metadata(folder, names);
  std::vector<fs::path> files = bags_in(folder);
  if (files.empty()) return failure(wrong(folder, "is a folder: SOURCE is a table of odometry or a bag"));
  return by_number(folder, std::move(files));
}

std::size_t parts_beside(const fs::path& file) {
  const PartName name = part_name(file);
  if (!name.number || !has_name_of_bag(file)) return 1;
  const std::vector<fs::path> files = bags_in(fs::absolute(file).parent_path());
  return static_cast<std::size_t>(
      std::ranges::count_if(files, [&](const fs::path& each) { return part_name(each).alike == name.alike; }));
}

}  // namespace azimuth
