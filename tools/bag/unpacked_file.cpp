#include "tools/bag/unpacked_file.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <zstd.h>

#include "base/files.hpp"
#include "base/unique_fd.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kUnpackedPiece = std::size_t{1} << 18U;

/// Unpacks all consecutive zstd frames, at most `left` bytes. `keep(bytes)` stores unpacked bytes and returns an error
/// text or an empty text. Returns an error text, or an empty text.
template <class Keep>
std::string unpack(Bytes packed, std::uint64_t left, Keep keep) {
  const std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream(ZSTD_createDStream(), ZSTD_freeDStream);
  if (!stream) return "cannot be unpacked: out of memory";
  const auto piece = std::make_unique<std::array<std::byte, kUnpackedPiece>>();
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  for (;;) {
    ZSTD_outBuffer out{piece->data(), kUnpackedPiece, 0};
    const std::size_t before = in.pos;
    const std::size_t hint = ZSTD_decompressStream(stream.get(), &out, &in);
    if (ZSTD_isError(hint) != 0) return std::string("cannot be unpacked: ") + ZSTD_getErrorName(hint);
    if (out.pos > left)
      return "unpacks to more than 32 MB and 64 times its size, which is how a file is made that fills memory: unzstd "
             "it first";
    left -= out.pos;
    if (std::string why = keep(Bytes(piece->data(), out.pos)); !why.empty()) return why;
    if (hint == 0 && in.pos == in.size) return {};
    if (out.pos == 0 && in.pos == before) return "is compressed and cut short";
  }
}

std::string write_to(int file, Bytes bytes) {
  const int error = write_all(file, bytes);
  if (error == 0) return {};
  return "cannot be unpacked in the temporary folder: " + std::generic_category().message(error);
}

}  // namespace

FileResult<UnpackedFile> UnpackedFile::make(const std::filesystem::path& file, Bytes packed) {
  std::error_code ignored;
  std::filesystem::path folder = std::filesystem::temp_directory_path(ignored);
  if (folder.empty()) folder = "/tmp";
  std::string name = (folder / "azimuth-XXXXXX").string();
  const UniqueFd into(::mkostemp(name.data(), O_CLOEXEC));
  if (!into) return failure(system_error(folder.string(), "cannot be written", errno));
  UnpackedFile unpacked(name);
  const auto keep = [&into](Bytes bytes) { return write_to(into.get(), bytes); };
  if (std::string why = unpack(packed, most_unpacked(packed.size()), keep); !why.empty())
    return failure(FileError{file.string(), 0, std::move(why)});
  return FileResult<UnpackedFile>(std::move(unpacked));
}

bool unpack_message(Bytes packed, std::uint64_t most, std::vector<std::byte>& out) {
  out.clear();
  return unpack(packed, most,
                [&out](Bytes bytes) {
                  out.insert(out.end(), bytes.begin(), bytes.end());
                  return std::string();
                })
      .empty();
}

UnpackedFile::~UnpackedFile() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove(path_, ignored);
}

}  // namespace azimuth
