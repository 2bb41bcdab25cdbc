#include <algorithm>
#include <array>
#include <bzlib.h>
#include <lz4frame.h>
#include <memory>
#include <zstd.h>

#include "tools/bag/bag_records.hpp"

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

}  // namespace

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
