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

/// Adds what was unpacked; false when that is more than a chunk may have.
bool add(std::vector<std::byte>& out, const std::array<std::byte, kPiece>& piece, std::size_t size) {
  if (size > kMaxChunkBytes - out.size()) return false;
  out.insert(out.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(size));
  return true;
}

enum class End { whole, cut, damaged };

End unpack_bz2(Bytes packed, std::vector<std::byte>& out) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return End::damaged;
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> end(&stream, BZ2_bzDecompressEnd);
  const auto piece = std::make_unique<std::array<std::byte, kPiece>>();
  stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(packed.data()));  // which it does not change
  stream.avail_in = static_cast<unsigned>(std::min<std::size_t>(packed.size(), 0xffffffff));
  for (;;) {
    stream.next_out = reinterpret_cast<char*>(piece->data());
    stream.avail_out = static_cast<unsigned>(kPiece);
    const int result = BZ2_bzDecompress(&stream);
    const std::size_t size = kPiece - stream.avail_out;
    if (!add(out, *piece, size)) return End::damaged;
    if (result != BZ_OK) return result == BZ_STREAM_END ? End::whole : End::damaged;
    if (size == 0 && stream.avail_in == 0) return End::cut;
  }
}

End unpack_lz4(Bytes packed, std::vector<std::byte>& out) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) return End::damaged;
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> end(context, LZ4F_freeDecompressionContext);
  const auto piece = std::make_unique<std::array<std::byte, kPiece>>();
  for (;;) {
    std::size_t size = kPiece, used = packed.size();
    const std::size_t hint = LZ4F_decompress(context, piece->data(), &size, packed.data(), &used, nullptr);
    if (LZ4F_isError(hint) != 0) return End::damaged;
    if (!add(out, *piece, size)) return End::damaged;
    packed = packed.subspan(used);
    if (hint == 0) return End::whole;
    if (size == 0 && used == 0) return End::cut;
  }
}

End unpack_zstd(Bytes packed, std::vector<std::byte>& out) {
  const std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream(ZSTD_createDStream(), ZSTD_freeDStream);
  if (!stream) return End::damaged;
  const auto piece = std::make_unique<std::array<std::byte, kPiece>>();
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  for (;;) {
    ZSTD_outBuffer unpacked{piece->data(), kPiece, 0};
    const std::size_t before = in.pos, hint = ZSTD_decompressStream(stream.get(), &unpacked, &in);
    if (ZSTD_isError(hint) != 0) return End::damaged;
    if (!add(out, *piece, unpacked.pos)) return End::damaged;
    if (hint == 0) return End::whole;
    if (unpacked.pos == 0 && in.pos == before) return End::cut;
  }
}

}  // namespace

std::vector<std::byte> unpack_chunk(std::string_view compression, Bytes packed, bool& whole) {
  std::vector<std::byte> out;
  End end = End::damaged;
  if (compression == "bz2") end = unpack_bz2(packed, out);
  if (compression == "lz4") end = unpack_lz4(packed, out);
  if (compression == "zstd") end = unpack_zstd(packed, out);
  if (end == End::damaged) out.clear();
  whole = end == End::whole;
  return out;
}

}  // namespace azimuth
