#include "tools/bag/bag_records.hpp"

#include <algorithm>
#include <array>
#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include "tools/bag/bag_layout.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18U;
constexpr std::uint64_t kBeginning_B = std::uint64_t{1} << 14U;  // cost of preparing to unpack a chunk

enum class End { whole, cut, damaged };

/// Receives the unpacked pieces of a chunk as long as the budget lasts.
class Unpacking {
 public:
  explicit Unpacking(UnpackBudget& budget) : budget_(budget) { budget_.spend(kBeginning_B); }

  char* room() { return reinterpret_cast<char*>(piece_->data()); }
  /// Stores the first `made` bytes of room(), which result from `used` packed bytes. False if that exceeds the budget
  /// or the largest size of a chunk.
  bool keep(std::size_t made, std::size_t used) {
    if (!budget_.spend(made + used) || made > kMaxChunkBytes - bytes_.size()) return false;
    bytes_.insert(bytes_.end(), piece_->begin(), piece_->begin() + static_cast<std::ptrdiff_t>(made));
    return true;
  }
  bool may_begin() const { return !budget_.is_overdrawn(); }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  UnpackBudget& budget_;
  std::vector<std::byte> bytes_;
  std::unique_ptr<std::array<std::byte, kPiece>> piece_ =
      std::make_unique_for_overwrite<std::array<std::byte, kPiece>>();
};

End unpack_bz2(Bytes packed, Unpacking& out) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return End::damaged;
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> end(&stream, BZ2_bzDecompressEnd);
  stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(packed.data()));  // bz2 does not write to it
  stream.avail_in = static_cast<unsigned>(std::min<std::size_t>(packed.size(), 0xffffffff));
  for (;;) {
    stream.next_out = out.room();
    stream.avail_out = static_cast<unsigned>(kPiece);
    const unsigned before = stream.avail_in;
    const int result = BZ2_bzDecompress(&stream);
    const std::size_t size = kPiece - stream.avail_out;
    if (!out.keep(size, before - stream.avail_in)) return End::damaged;
    if (result != BZ_OK) return result == BZ_STREAM_END ? End::whole : End::damaged;
    if (size == 0 && stream.avail_in == 0) return End::cut;
  }
}

End unpack_lz4(Bytes packed, Unpacking& out) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) return End::damaged;
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> end(context, LZ4F_freeDecompressionContext);
  for (;;) {
    std::size_t size = kPiece, used = packed.size();
    const std::size_t hint = LZ4F_decompress(context, out.room(), &size, packed.data(), &used, nullptr);
    if (LZ4F_isError(hint) != 0) return End::damaged;
    if (!out.keep(size, used)) return End::damaged;
    packed = packed.subspan(used);
    if (hint == 0) return End::whole;
    if (size == 0 && used == 0) return End::cut;
  }
}

End unpack_zstd(Bytes packed, Unpacking& out) {
  const std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream(ZSTD_createDStream(), ZSTD_freeDStream);
  if (!stream) return End::damaged;
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  for (;;) {
    ZSTD_outBuffer unpacked{out.room(), kPiece, 0};
    const std::size_t before = in.pos, hint = ZSTD_decompressStream(stream.get(), &unpacked, &in);
    if (ZSTD_isError(hint) != 0) return End::damaged;
    if (!out.keep(unpacked.pos, in.pos - before)) return End::damaged;
    if (hint == 0) return End::whole;
    if (unpacked.pos == 0 && in.pos == before) return End::cut;
  }
}

constexpr std::size_t kMaxHeader = 4096;  // limit of a record header; ROS writes headers of some dozens of bytes

using bag::Op;
namespace field = bag::field;

std::uint32_t u32_of(Bytes bytes) { return little_endian<std::uint32_t>(bytes); }

/// A sequence of fields `name=value`, each preceded by its length.
class Fields {
 public:
  explicit Fields(Bytes bytes) : bytes_(bytes) {}

  /// True if the bytes contain only valid fields.
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
  /// Iterates until `use(name, value)` returns true. False if the bytes are no valid fields.
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
  std::size_t header = 0;  ///< number of bytes before the data
  Bytes rest;              ///< the file from the data on
  std::uint64_t size = 0;  ///< size of the data according to the record

  bool is_whole() const { return size <= rest.size(); }
  Bytes data() const { return rest.first(static_cast<std::size_t>(std::min<std::uint64_t>(size, rest.size()))); }
};

/// The record at the start of `bytes`, with complete or incomplete data; nothing if there is no record.
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

/// Iterates over records, including those in chunks.
class Walk {
 public:
  Walk(const BagVisitor& visitor, std::size_t file_B) : visitor_(visitor), budget_(file_B), file_B_(file_B) {}

  /// Reads records and returns the number of bytes that belong to no record. After invalid bytes, searches for the next
  /// record.
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

  /// The damage except BagDamage::bytes.
  BagDamage damage() const {
    BagDamage damage = damage_;
    damage.beyond_budget = budget_.is_overdrawn();
    return damage;
  }

 private:
  /// True if the record may be real. After damage in a bag with compressed chunks, only chunks are accepted, since
  /// compressed data may look like other records.
  bool may_be(const Record& record, bool in_chunk) const {
    return in_chunk || !lost_ || !packed_ || record.op == Op::chunk;
  }

  /// Reads a record and returns the number of consumed bytes; 0 if the record is incomplete or misplaced.
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

  /// Reads a chunk. Only the header of an uncompressed chunk is consumed and its records are read in place, so that its
  /// length may be missing and the chunk may be truncated. A compressed chunk is unpacked as far as possible.
  std::size_t take_chunk(const Record& record) {
    const std::string compression = record.fields.text(field::kCompression);
    left_in_chunk_ = false;
    packed_ = compression != "none";
    if (!packed_) return record.header;
    const bool has_length = record.is_whole() && record.size > 0;  // 0: the chunk was never closed
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
  std::size_t file_B_, told_B_ = file_B_;  // told_B_: bytes left at the last progress call
  BagDamage damage_;
  bool packed_ = false;         // the last chunk is compressed
  bool left_in_chunk_ = false;  // the end of the last chunk is unknown
  bool lost_ = false;           // the position is not at the end of a record
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

std::vector<std::byte> unpack_chunk(std::string_view compression, Bytes packed, UnpackBudget& budget, bool& whole) {
  Unpacking out(budget);
  End end = End::damaged;
  if (!out.may_begin()) compression = "";
  if (compression == "bz2") end = unpack_bz2(packed, out);
  if (compression == "lz4") end = unpack_lz4(packed, out);
  if (compression == "zstd") end = unpack_zstd(packed, out);
  whole = end == End::whole;
  return end == End::damaged ? std::vector<std::byte>{} : out.take();
}

}  // namespace azimuth
