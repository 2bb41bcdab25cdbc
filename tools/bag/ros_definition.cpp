#include "tools/bag/ros_definition.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "drivers/wire/number_text.hpp"
#include "drivers/wire/text_lines.hpp"

namespace azimuth {
namespace {

constexpr int kMostLevels = 32;                 // limit of nested types
constexpr std::size_t kMostValues = 1U << 20U;  // limit of values in a message; an array of numbers counts once
// Limits of the number of values relative to the message size. Values of types without fields take no bytes, so a
// crafted message could contain any number of them.
constexpr std::size_t kFreeValues = 64, kBytesAValue = 2;
constexpr std::size_t kLargestDefinition = std::size_t{1} << 19U;
constexpr std::size_t kLongestWord = 256;   // limit of a type or field name; ROS uses some dozens of characters
constexpr std::size_t kLongestPath = 1024;  // limit of the path of a value

struct ScalarName {
  std::string_view name;
  RosScalar scalar;
};
constexpr std::array<ScalarName, 16> kScalars{{{"bool", RosScalar::boolean},
                                               {"int8", RosScalar::i8},
                                               {"byte", RosScalar::i8},
                                               {"uint8", RosScalar::u8},
                                               {"char", RosScalar::u8},
                                               {"int16", RosScalar::i16},
                                               {"uint16", RosScalar::u16},
                                               {"int32", RosScalar::i32},
                                               {"uint32", RosScalar::u32},
                                               {"int64", RosScalar::i64},
                                               {"uint64", RosScalar::u64},
                                               {"float32", RosScalar::f32},
                                               {"float64", RosScalar::f64},
                                               {"time", RosScalar::time},
                                               {"duration", RosScalar::duration},
                                               {"string", RosScalar::text}}};

std::string_view take_word(std::string_view& text) {
  constexpr std::string_view kSpace = " \t\r";
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kSpace));
  text.remove_prefix(word.size());
  return word;
}

/// Removes length bounds of ROS 2 such as string<=9 and uint8[<=9], which do not matter for reading.
void drop_bounds(std::string& type) {
  constexpr std::string_view kAtMost = "<=";
  std::string without;
  std::size_t begin = 0;
  for (std::size_t bound = type.find(kAtMost); bound != std::string::npos; bound = type.find(kAtMost, begin)) {
    without.append(type, begin, bound - begin);
    begin = std::min(type.find_first_not_of("0123456789", bound + kAtMost.size()), type.size());
  }
  type = without.append(type, begin);
}

/// Removes [] or [9] from the end of a type; false if it is malformed.
bool take_array(std::string_view& type, RosField& field) {
  if (!type.ends_with(']')) return true;
  const std::size_t bracket = type.find('[');
  if (bracket == std::string_view::npos) return false;
  const std::string_view length = type.substr(bracket + 1, type.size() - bracket - 2);
  type = type.substr(0, bracket);
  field.is_array = true;
  if (length.empty()) return true;
  const std::optional<std::int64_t> number = parse_integer(length);
  if (!number || *number < 0 || *number > std::numeric_limits<std::uint32_t>::max()) return false;
  field.length = static_cast<std::uint32_t>(*number);
  return true;
}

/// The part "package/" of a type name.
std::string_view package_of(std::string_view type) { return type.substr(0, type.find('/') + 1); }

/// Parses a line `TYPE NAME`, in ROS 2 with an optional default value. The name is empty for a constant or an empty
/// line. False if the line is invalid.
bool read_field(std::string_view line, std::string_view within, RosVersion version, RosField& field) {
  std::string_view rest = line.substr(0, line.find('#'));
  const bool is_two = version == RosVersion::two;
  std::string written(take_word(rest));
  if (is_two) drop_bounds(written);
  std::string_view type = written;
  if (type.empty()) return true;
  // A constant: its text may contain any character, including #.
  const std::string_view name = take_word(rest);
  const std::string_view after = take_word(rest);
  if (name.find('=') != std::string_view::npos || after.starts_with('=')) return true;
  if (type.size() > kLongestWord || name.size() > kLongestWord) return false;
  if (name.empty() || (!after.empty() && !is_two) || !take_array(type, field) || type.empty()) return false;
  field.name = name;
  const auto scalar = std::ranges::find(kScalars, type, &ScalarName::name);
  if (scalar != kScalars.end()) {
    field.scalar = scalar->scalar;
  } else if (type == "Header") {
    field.type = "std_msgs/Header";
  } else {
    field.type = (type.find('/') == std::string_view::npos ? std::string(package_of(within)) : "") + without_msg(type);
  }
  return true;
}

}  // namespace

std::string without_msg(std::string_view type) {
  constexpr std::string_view kBetween = "/msg/";
  const std::size_t between = type.find(kBetween);
  if (between == std::string_view::npos) return std::string(type);
  return std::string(type.substr(0, between + 1)) + std::string(type.substr(between + kBetween.size()));
}

std::size_t size_of(RosScalar scalar) {
  switch (scalar) {
    case RosScalar::boolean:
    case RosScalar::i8:
    case RosScalar::u8:
      return 1;
    case RosScalar::i16:
    case RosScalar::u16:
      return 2;
    case RosScalar::i32:
    case RosScalar::u32:
    case RosScalar::f32:
      return 4;
    case RosScalar::i64:
    case RosScalar::u64:
    case RosScalar::f64:
    case RosScalar::time:
    case RosScalar::duration:
      return 8;
    case RosScalar::text:
      return 0;
  }
  return 0;
}

std::optional<RosDefinition> RosDefinition::parse(std::string_view text, std::string_view type, RosVersion version) {
  if (text.size() > kLargestDefinition || type.size() > kLongestWord) return std::nullopt;
  RosDefinition definition;
  definition.type_ = without_msg(type);
  definition.version_ = version;
  std::string current = definition.type_;
  bool is_new_type = false;  // the next line names a new type
  definition.types_[current];
  while (!text.empty()) {
    std::string_view line = take_line(text);
    if (line.starts_with("=====")) {
      is_new_type = true;
      continue;
    }
    if (is_new_type) {
      if (take_word(line) != "MSG:") return std::nullopt;
      current = without_msg(take_word(line));
      if (current.size() > kLongestWord) return std::nullopt;
      definition.types_[current].clear();
      is_new_type = false;
      continue;
    }
    RosField field;
    if (!read_field(line, current, version, field)) return std::nullopt;
    if (!field.name.empty()) definition.types_[current].push_back(std::move(field));
  }
  return definition.is_complete() ? std::optional(std::move(definition)) : std::nullopt;
}

bool RosDefinition::is_complete() const {
  return std::ranges::all_of(types_, [this](const auto& type) {
    return std::ranges::all_of(type.second, [this](const RosField& field) {
      return field.type.empty() || types_.find(field.type) != types_.end();
    });
  });
}

/// State of reading one message.
struct RosDefinition::Walk {
  Bytes rest;
  const Use& use;
  std::string path;
  RosVersion version = RosVersion::one;
  std::size_t taken = 0;  // bytes since the origin of the alignment
  int level = 0;
  std::size_t values_left = std::min(kMostValues, kFreeValues + rest.size() / kBytesAValue);

  /// False if the message has more values than its size allows.
  bool begin_value() {
    if (path.size() > kLongestPath || values_left == 0) return false;
    --values_left;
    return true;
  }

  /// Reads the CDR header. False if the byte order differs or if the layout is that of a later version.
  bool begin() {
    if (version == RosVersion::one) return true;
    const std::optional<Bytes> said = take(4);
    taken = 0;
    return said && (*said)[0] == std::byte{0} && (*said)[1] == std::byte{1};
  }
  void align(std::size_t size) {
    if (version == RosVersion::one || size == 0) return;
    take(std::min((size - taken % size) % size, rest.size()));
  }
  /// Removes bytes from the front; nothing if there are too few.
  std::optional<Bytes> take(std::uint64_t size) {
    if (size > rest.size()) return std::nullopt;
    const Bytes front = rest.first(static_cast<std::size_t>(size));
    rest = rest.subspan(front.size());
    taken += front.size();
    return front;
  }
  std::optional<std::uint32_t> take_length() {
    align(4);
    const std::optional<Bytes> bytes = take(4);
    return bytes ? std::optional(little_endian<std::uint32_t>(*bytes)) : std::nullopt;
  }
  bool numbers(RosScalar scalar, std::uint32_t count) {
    if (count > 0) align(size_of(scalar));
    const std::optional<Bytes> bytes = take(std::uint64_t{count} * size_of(scalar));
    if (bytes) use(path, {scalar, count, *bytes});
    return bytes.has_value();
  }
  bool text() {
    const std::optional<std::uint32_t> length = take_length();
    std::optional<Bytes> bytes = length ? take(*length) : std::nullopt;
    const bool has_zero = bytes && version == RosVersion::two && !bytes->empty() && bytes->back() == std::byte{0};
    if (has_zero) bytes = bytes->first(bytes->size() - 1);
    if (bytes) use(path, {RosScalar::text, 1, *bytes});
    return bytes.has_value();
  }
};

bool RosDefinition::read(Bytes message, const Use& use) const {
  Walk walk{.rest = message, .use = use, .path = {}, .version = version_};
  return walk.begin() && read(type_, walk);
}

bool RosDefinition::read(const std::string& type, Walk& walk) const {
  const auto fields = types_.find(type);
  if (fields == types_.end() || walk.level == kMostLevels) return false;
  ++walk.level;
  const bool good = std::ranges::all_of(fields->second, [&](const RosField& field) {
    const std::size_t length = walk.path.size();
    if (length > 0) walk.path += '.';
    walk.path += field.name;
    const bool whole = read(field, walk);
    walk.path.resize(length);
    return whole;
  });
  --walk.level;
  return good;
}

bool RosDefinition::read(const RosField& field, Walk& walk) const {
  if (!walk.begin_value()) return false;
  std::uint32_t count = 1;
  if (field.is_array) {
    const std::optional<std::uint32_t> length = field.length ? field.length : walk.take_length();
    if (!length) return false;
    count = *length;
  }
  if (field.type.empty() && field.scalar != RosScalar::text) return walk.numbers(field.scalar, count);
  const std::size_t length = walk.path.size();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (field.is_array && !walk.begin_value()) return false;
    if (field.is_array) walk.path += '[' + std::to_string(i) + ']';
    if (!(field.type.empty() ? walk.text() : read(field.type, walk))) return false;
    walk.path.resize(length);
  }
  return true;
}

}  // namespace azimuth
