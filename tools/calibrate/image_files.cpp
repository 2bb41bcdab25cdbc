#include "tools/calibrate/image_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <system_error>

#include "base/files.hpp"
#include "drivers/camera/jpeg.hpp"
#include "drivers/camera/png.hpp"
#include "drivers/wire/image_header.hpp"

namespace azimuth {
namespace {

using Bytes = std::span<const std::byte>;

char letter(std::byte byte) { return static_cast<char>(byte); }
bool is_blank(std::byte byte) { return std::isspace(static_cast<unsigned char>(byte)) != 0; }
bool is_digit(std::byte byte) { return letter(byte) >= '0' && letter(byte) <= '9'; }

/// Reads the header of a PNM file: numbers separated by white space and comments.
class PnmHeader {
 public:
  explicit PnmHeader(Bytes bytes) : rest_(bytes) {}

  /// The next number. Nothing if there is none or if it exceeds kMaxFrameSide_px.
  std::optional<int> number() {
    skip_blanks();
    if (rest_.empty() || !is_digit(rest_.front())) return std::nullopt;
    int value = 0;
    for (; !rest_.empty() && is_digit(rest_.front()); rest_ = rest_.subspan(1)) {
      value = 10 * value + (letter(rest_.front()) - '0');
      if (value > kMaxFrameSide_px) return std::nullopt;
    }
    return value;
  }
  /// The bytes after the single white-space character that follows the last number.
  Bytes pixels() const { return rest_.empty() || !is_blank(rest_.front()) ? Bytes{} : rest_.subspan(1); }

 private:
  void skip_blanks() {
    while (!rest_.empty() && (is_blank(rest_.front()) || letter(rest_.front()) == '#')) {
      const bool comment = letter(rest_.front()) == '#';
      const auto end = std::find_if(rest_.begin(), rest_.end(), [comment](std::byte byte) {
        return comment ? letter(byte) == '\n' : !is_blank(byte);
      });
      rest_ = rest_.subspan(static_cast<std::size_t>(end - rest_.begin()));
    }
  }
  Bytes rest_;
};

FileResult<ImageFile> decode_pnm(Bytes bytes, PixelFormat pixels, const std::string& file) {
  PnmHeader header(bytes.subspan(2));
  const std::optional<int> width = header.number(), height = header.number(), highest = header.number();
  if (!width || !height || !highest) return failure(FileError{file, 0, "the header of the image is damaged"});
  if (*highest != 255) return failure(FileError{file, 0, "only 8 bits a sample (highest value 255) can be read"});
  const FrameFormat format = packed_format(pixels, *width, *height);
  if (!is_valid(format)) return failure(FileError{file, 0, "the image has no pixels"});
  const Bytes content = header.pixels();
  if (content.size() < format.bytes()) return failure(FileError{file, 0, "the image is cut short"});
  const Bytes whole = content.first(format.bytes());
  return ImageFile{format, {whole.begin(), whole.end()}};
}

/// `Decoder` is JpegDecoder or PngDecoder.
template <class Decoder>
FileResult<ImageFile> decode_by(Decoder decoder, Bytes bytes, const std::string& file) {
  const auto header = decoder.read_header(bytes);
  const ImageView view = header ? decoder.decode(bytes, header->natural_format()) : ImageView{};
  if (view.bytes.empty()) return failure(FileError{file, 0, decoder.problem()});
  return ImageFile{view.format, {view.bytes.begin(), view.bytes.end()}};
}

bool begins(Bytes bytes, char first, char second) {
  return bytes.size() >= 2 && letter(bytes[0]) == first && letter(bytes[1]) == second;
}

using Path = std::filesystem::path;

std::vector<Path> images_in(const Path& folder) {
  std::error_code error;
  std::vector<Path> files;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (is_image_name(entry->path())) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<Path> images_of(const Path& argument) {
  std::error_code error;
  if (!std::filesystem::is_directory(argument, error)) return {argument};
  const Path frames = argument / "frames";
  return images_in(std::filesystem::is_directory(frames, error) ? frames : argument);
}

template <class Thing>
std::vector<Thing> evenly(const std::vector<Thing>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<Thing> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(all[i * all.size() / most]);
  return chosen;
}

}  // namespace

FileResult<std::vector<Path>> image_files(const std::vector<Path>& arguments, std::size_t most) {
  std::vector<Path> files;
  for (const Path& argument : arguments) {
    const std::vector<Path> images = images_of(argument);
    if (images.empty()) return failure(FileError{argument.string(), 0, "there are no images in it"});
    files.insert(files.end(), images.begin(), images.end());
  }
  return evenly(files, most);
}

std::vector<std::pair<Path, Path>> image_pairs(const std::vector<Path>& files, std::size_t most) {
  std::vector<std::pair<Path, Path>> pairs;
  for (std::size_t i = 1; i < files.size(); ++i) pairs.emplace_back(files[i - 1], files[i]);
  return evenly(pairs, most);
}

bool is_image_name(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 6> kExtensions{".jpg", ".jpeg", ".png", ".pgm", ".ppm", ".pnm"};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char each) { return static_cast<char>(std::tolower(each)); });
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

FileResult<ImageFile> decode_image(Bytes bytes, const std::string& file) {
  if (begins(bytes, 'P', '5')) return decode_pnm(bytes, PixelFormat::gray8, file);
  if (begins(bytes, 'P', '6')) return decode_pnm(bytes, PixelFormat::rgb8, file);
  if (begins(bytes, '\xff', '\xd8')) return decode_by(JpegDecoder(), bytes, file);
  if (is_png(bytes)) return decode_by(PngDecoder(), bytes, file);
  return failure(FileError{file, 0, "is neither a JPEG or PNG nor a binary PGM or PPM image"});
}

FileResult<ImageFile> read_image(const std::filesystem::path& file) {
  const FileResult<MappedFile> mapped = MappedFile::open(file);
  if (!mapped) return failure(mapped.error());
  return decode_image(mapped->bytes(), file.string());
}

}  // namespace azimuth
