#include "tools/bag/bag_records.hpp"

#include <algorithm>
#include <utility>

#include "tools/bag/bag_layout.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kMaxHeader = 4096;  // of a record; those that ROS writes have some dozens of bytes

using bag::Op;
namespace field = bag::field;

std::uint32_t u32_of(Bytes bytes) { return little_endian<std::uint32_t>(bytes); }

/// `name=value` after `name=value`, each with its length before it.
class Fields {
 public:
  explicit Fields(Bytes bytes) : bytes_(bytes) {}

  /// Whether there is nothing else in the bytes.
  bool sound() const {
    return walk([](std::string_view, Bytes) { return false; });
  }
  std::optional<Bytes> find(std::string_view name) const {
    std::optional<Bytes> found;
    walk([&](std::string_view each, Bytes value) {
      if (each == name) found = value;
      return each == name;
    });
    return found;
  }
  std::string text(std::string_view name) const { return std::string(as_text(find(name).value_or(Bytes{}))); }
  std::optional<std::uint32_t> number(std::string_view name) const {
    const std::optional<Bytes> value = find(name);
    return value && value->size() == 4 ? std::optional(u32_of(*value)) : std::nullopt;
  }

 private:
  /// Until `use(name, value)` says that it is enough; false when the bytes are no fields.
  template <class Use>
  bool walk(Use use) const {
    for (Bytes rest = bytes_; !rest.empty();) {
      if (rest.size() < 4) return false;
      const std::uint32_t size = u32_of(rest);
      rest = rest.subspan(4);
      const std::string_view letters = as_text(rest.first(std::min<std::size_t>(size, rest.size())));
      const std::size_t sign = letters.find('=');
      if (size > rest.size() || sign == std::string_view::npos) return false;
      if (use(letters.substr(0, sign), rest.subspan(sign + 1, size - sign - 1))) return true;
      rest = rest.subspan(size);
    }
    return true;
  }

  Bytes bytes_;
};

struct Record {
  Op op{};
  Fields fields{Bytes{}};
  std::size_t header = 0;  ///< bytes up to the data
  Bytes rest;              ///< of the file, from the data on
  std::uint64_t size = 0;  ///< of the data, as the record says

  bool is_whole() const { return size <= rest.size(); }
  Bytes data() const { return rest.first(static_cast<std::size_t>(std::min<std::uint64_t>(size, rest.size()))); }
};

/// The record that `bytes` begin with, whether its data is whole or not; nothing when they begin with none.
std::optional<Record> record_at(Bytes bytes) {
  if (bytes.size() < 8) return std::nullopt;
  const std::size_t header = u32_of(bytes);
  if (header == 0 || header > kMaxHeader || header > bytes.size() - 8) return std::nullopt;
  Record record;
  record.fields = Fields(bytes.subspan(4, header));
  const std::optional<Bytes> op = record.fields.find(field::kOp);
  if (!op || op->size() != 1 || !record.fields.sound()) return std::nullopt;
  const auto number = std::to_integer<std::uint8_t>(op->front());
  if (number < static_cast<std::uint8_t>(Op::message) || number > static_cast<std::uint8_t>(Op::connection))
    return std::nullopt;
  record.op = static_cast<Op>(number);
  record.header = 8 + header;
  record.rest = bytes.subspan(record.header);
  record.size = u32_of(bytes.subspan(4 + header));
  return record;
}

/// Goes through records, and through those in chunks.
class Walk {
 public:
  Walk(const BagVisitor& visitor, std::size_t file_B) : visitor_(visitor), budget_(file_B), file_B_(file_B) {}

  /// Returns how many bytes are in no record. Past what makes no sense the next record is looked for.
  std::uint64_t records(Bytes bytes, bool in_chunk) {
    std::uint64_t damaged = 0;
    while (!bytes.empty() && !budget_.is_overdrawn()) {
      if (!in_chunk) tell_progress(bytes.size());
      const std::optional<Record> record = record_at(bytes);
      const std::size_t taken = record && may_be(*record, in_chunk) ? take(*record, in_chunk) : 0;
      if (taken == 0) {
        ++damaged;
        budget_.spend(kLookingForARecord_B);
      }
      if (!in_chunk) lost_ = taken == 0 || left_in_chunk_;
      bytes = bytes.subspan(std::max<std::size_t>(taken, 1));
    }
    return damaged;
  }

  /// But for bytes.
  BagDamage damage() const {
    BagDamage damage = damage_;
    damage.beyond_budget = budget_.is_overdrawn();
    return damage;
  }

 private:
  /// Pieces of what was packed look like records: of a bag whose chunks are compressed, only the next chunk is looked
  /// for.
  bool may_be(const Record& record, bool in_chunk) const {
    return in_chunk || !lost_ || !packed_ || record.op == Op::chunk;
  }

  /// Returns how many bytes it took; 0: the record is not whole, or makes no sense where it is.
  std::size_t take(const Record& record, bool in_chunk) {
    if (record.op == Op::chunk) return in_chunk ? 0 : take_chunk(record);
    if (!in_chunk) left_in_chunk_ = false;
    if (!record.is_whole()) return 0;
    const std::optional<std::uint32_t> connection = record.fields.number(field::kConnection);
    const std::optional<Bytes> time = record.fields.find(field::kTime);
    if (record.op == Op::bag) damage_.encrypted = damage_.encrypted || !record.fields.text(field::kEncryptor).empty();
    if (record.op == Op::connection && connection) take_connection(*connection, record);
    if (record.op == Op::message && connection && time && time->size() == 8)
      visitor_.message(*connection, ros_stamp(u32_of(*time), u32_of(time->subspan(4))), record.data());
    return record.header + static_cast<std::size_t>(record.size);
  }

  /// What is not compressed is gone through where it lies, as if there were no chunk: then it does not matter whether
  /// its length was ever written, or the file goes on as far. Of a compressed one, all that can be unpacked.
  std::size_t take_chunk(const Record& record) {
    const std::string compression = record.fields.text(field::kCompression);
    left_in_chunk_ = false;
    packed_ = compression != "none";
    if (!packed_) return record.header;
    const bool has_length = record.is_whole() && record.size > 0;  // 0: it was never closed
    bool unpacked = false;
    const std::vector<std::byte> bytes =
        unpack_chunk(compression, has_length ? record.data() : record.rest, budget_, unpacked);
    const bool sound = records(bytes, true) == 0;
    if (!has_length || !unpacked || !sound) ++damage_.chunks;
    left_in_chunk_ = !has_length;
    return record.header + (has_length ? static_cast<std::size_t>(record.size) : 0);
  }

  void take_connection(std::uint32_t id, const Record& record) {
    const Fields said(record.data());
    visitor_.connection({id, record.fields.text(field::kTopic), said.text(field::kType), said.text(field::kDefinition),
                         said.text(field::kChecksum), RosVersion::one, said.text(field::kSender)});
  }

  void tell_progress(std::size_t left_B) {
    if (!visitor_.progress || told_B_ - left_B < bag::kProgress_B) return;
    told_B_ = left_B;
    visitor_.progress(file_B_ - left_B, file_B_);
  }

  const BagVisitor& visitor_;
  UnpackBudget budget_;
  std::size_t file_B_, told_B_ = file_B_;  // of which as much is left
  BagDamage damage_;
  bool packed_ = false;         // the last chunk is compressed
  bool left_in_chunk_ = false;  // and it is not known where it ends
  bool lost_ = false;           // not at the end of a record
};

}  // namespace

BagDamage visit_bag(Bytes file, const BagVisitor& visitor) {
  Walk walk(visitor, file.size());
  const std::size_t begin = std::min(kBagMagic.size(), file.size());
  const std::uint64_t bytes = walk.records(file.subspan(begin), false);
  BagDamage damage = walk.damage();
  damage.bytes = bytes;
  return damage;
}

Stamp ros_stamp(std::uint32_t seconds, std::uint32_t nanoseconds) {
  return stamp_from_us(std::int64_t{seconds} * 1'000'000 + (std::int64_t{nanoseconds} + 500) / 1'000);
}

}  // namespace azimuth
