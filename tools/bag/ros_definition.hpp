#pragma once
// What a ROS message is made of, by the definition that a bag carries with it, and its bytes taken apart by that. Any
// text and any bytes are safe.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"

namespace azimuth {

/// Of ROS: definitions are written a little differently, and messages laid out.
enum class RosVersion : std::uint8_t {
  one,  ///< values one after the other
  two,  ///< CDR: four bytes that say so, then each value at a multiple of its size, text with a zero at its end
};

/// The types that are not made of others.
enum class RosScalar : std::uint8_t { boolean, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64, time, duration, text };

/// Bytes of one; 0: as many as it says itself.
std::size_t size_of(RosScalar scalar);

struct RosField {
  std::string name;
  std::string type;                          ///< of a message of its own; empty for a scalar
  RosScalar scalar = RosScalar::u8;          ///< else
  bool is_array = false;                     ///< of a length that the message says, unless `length` does
  std::optional<std::uint32_t> length = {};  ///< of an array
};

/// A type and those it is made of.
///
/// Thread contract: reentrant.
class RosDefinition {
 public:
  /// Reads the text of a definition, as `gendeps --cat` writes it: the fields of `type`, a line of = before each
  /// further type, `MSG: package/Name`, its fields. Nothing when a line is none of these, or a type is not there. In
  /// ROS 2 package/msg/Name is package/Name as well, here and in `type`.
  static std::optional<RosDefinition> parse(std::string_view text, std::string_view type,
                                            RosVersion version = RosVersion::one);

  /// One or more scalars of a message, as they lie there: of text without its length.
  struct Value {
    RosScalar scalar = RosScalar::u8;
    std::size_t count = 1;
    Bytes bytes;
  };
  using Use = std::function<void(std::string_view path, const Value& value)>;

  /// Calls `use` for each value of a message, in their order: "pose.pose.position.x", "name[2]" of texts and messages
  /// in arrays; arrays of numbers are one value. False when the bytes end early, or are CDR of another byte order;
  /// those left over do no harm.
  bool read(Bytes message, const Use& use) const;

 private:
  struct Walk;
  bool read(const std::string& type, Walk& walk) const;
  bool read(const RosField& field, Walk& walk) const;
  bool is_complete() const;

  std::string type_;
  RosVersion version_ = RosVersion::one;
  std::map<std::string, std::vector<RosField>, std::less<>> types_;
};

/// package/Name of package/msg/Name.
std::string without_msg(std::string_view type);

}  // namespace azimuth
