#pragma once
// Parses ROS message definitions and decodes messages with them. Any text and any bytes are safe.

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

/// Version of ROS. The versions differ in the syntax of definitions and in the layout of messages.
enum class RosVersion : std::uint8_t {
  one,  ///< values without padding
  two,  ///< CDR: a header of four bytes, then each value aligned to its size; text ends with a zero byte
};

/// The primitive types.
enum class RosScalar : std::uint8_t { boolean, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64, time, duration, text };

/// Size in bytes; 0 for a type whose size is stored with each value.
std::size_t size_of(RosScalar scalar);

struct RosField {
  std::string name;
  std::string type;                          ///< name of the message type; empty for a scalar
  RosScalar scalar = RosScalar::u8;          ///< type of a scalar
  bool is_array = false;                     ///< array of fixed `length`, or of a length stored in the message
  std::optional<std::uint32_t> length = {};  ///< length of a fixed array
};

/// A message type and the types of its fields.
///
/// Thread contract: reentrant.
class RosDefinition {
 public:
  /// Parses the text of a definition in the format of `gendeps --cat`: the fields of `type`, then for each further type
  /// a line of =, a line `MSG: package/Name`, and its fields. Nothing if a line is invalid or a type is missing. In
  /// ROS 2, package/msg/Name equals package/Name, both in the text and in `type`.
  static std::optional<RosDefinition> parse(std::string_view text, std::string_view type,
                                            RosVersion version = RosVersion::one);

  /// One or more scalars of a message in their stored form; text is without its length.
  struct Value {
    RosScalar scalar = RosScalar::u8;
    std::size_t count = 1;
    Bytes bytes;
  };
  using Use = std::function<void(std::string_view path, const Value& value)>;

  /// Calls `use` for each value of a message in order. A path is, for example, "pose.pose.position.x", or "name[2]" for
  /// an array element that is a text or a message. An array of numbers is one value. False if the bytes end too early
  /// or are CDR with another byte order. Additional bytes are ignored.
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

/// Converts package/msg/Name to package/Name.
std::string without_msg(std::string_view type);

}  // namespace azimuth
