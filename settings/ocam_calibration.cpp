#include "settings/ocam_calibration.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <vector>

#include "slam/camera/make_camera.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kMostCoefficients = 64;
constexpr double kMaxSide_px = 16384, kMaxShear = 0.1, kMostLeftOut_px = 1.0;

/// All numbers of a text without comments, or the first line with a word that is no number.
struct Numbers {
  std::vector<double> values;
  int bad_line = 0;  ///< 0: none
};

/// Reads a number as MATLAB and C print it: "-5.5e+002", "+1".
std::optional<double> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string_view next_word(std::string_view& line) {
  constexpr std::string_view kBlank = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlank));
  line.remove_prefix(word.size());
  return word;
}

Numbers numbers_in(std::string_view text) {
  Numbers numbers;
  for (int at = 1; !text.empty(); ++at) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    line = line.substr(0, line.find('#'));
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      const auto value = number(word);
      if (!value) {
        numbers.bad_line = at;
        return numbers;
      }
      numbers.values.push_back(*value);
    }
  }
  return numbers;
}

/// Takes numbers from the front of a list. enough() is false once a number was missing.
class Taker {
 public:
  explicit Taker(const std::vector<double>& values) : values_(values) {}

  double take() { return at_ < values_.size() ? values_[at_++] : (enough_ = false, 0.0); }
  /// Takes a count, and then that number of values.
  std::vector<double> list() {
    const double count = take();
    if (!(count >= 1.0 && count <= static_cast<double>(kMostCoefficients)) || count != std::floor(count)) {
      enough_ = false;
      return {};
    }
    std::vector<double> all(static_cast<std::size_t>(count));
    for (double& each : all) each = take();
    return all;
  }
  bool enough() const { return enough_; }
  bool all() const { return at_ == values_.size(); }

 private:
  const std::vector<double>& values_;
  std::size_t at_ = 0;
  bool enough_ = true;
};

struct Calibration {
  std::vector<double> direct;
  double row = 0, column = 0, c = 1, d = 0, e = 0, height = 0, width = 0;
};

std::optional<std::string> problem(const Calibration& read) {
  if (read.direct.size() > PolynomialFisheye::kCoefficients)
    return "the direct polynomial has more than 5 coefficients";
  if (std::abs(read.d) > kMaxShear || std::abs(read.e) > kMaxShear)
    return fmt::format("affine d and e must be from {} to {}", -kMaxShear, kMaxShear);
  if (!(read.c >= 0.1 && read.c <= 10.0)) return "affine c must be from 0.1 to 10";
  const auto is_side = [](double side) { return side >= 1.0 && side <= kMaxSide_px && side == std::floor(side); };
  if (!is_side(read.height) || !is_side(read.width)) return "the image's height and width must be whole pixels";
  if (std::abs(read.row) > kMaxSide_px || std::abs(read.column) > kMaxSide_px) return "the centre is far outside";
  return std::nullopt;
}

/// Largest distance in the image between the affine part and its approximation by c and a rotation. OCamCalib has
/// row = c x + d y + centre, column = e x + y + centre, with x and y along rows and columns.
double left_out_px(const Calibration& read) {
  const double turn_rad = 0.5 * (read.d / read.c - read.e);
  double most_px = 0.0;
  for (const double row : {-0.5, read.height - 0.5})
    for (const double column : {-0.5, read.width - 0.5}) {
      const double down = row - read.row, right = column - read.column, determinant = read.c - read.d * read.e;
      const double x = (down - read.d * right) / determinant, y = (read.c * right - read.e * down) / determinant;
      const double down_turned = read.c * (std::cos(turn_rad) * x + std::sin(turn_rad) * y);
      const double right_turned = std::cos(turn_rad) * y - std::sin(turn_rad) * x;
      most_px = std::max(most_px, std::hypot(down_turned - down, right_turned - right));
    }
  return most_px;
}

CameraRig rig_of(const Calibration& read) {
  std::vector<double> a = read.direct;
  a.resize(PolynomialFisheye::kCoefficients, 0.0);
  CameraRig rig;
  ImageRig& image = rig.image;
  image.width_px = static_cast<int>(read.width);
  image.height_px = static_cast<int>(read.height);
  image.beta = read.c;
  image.centre_px = {read.column, read.row / read.c};
  const PolynomialRig model{.a = {a[0], a[1], a[2], a[3], a[4]}};
  rig.model = model;
  const double u = std::max(read.column, read.width - read.column), v = std::max(read.row, read.height - read.row);
  const PolynomialFisheye fisheye(model.a, 0.5 * kPi);
  image.theta_max_rad = std::min(fisheye.theta_at_rad(std::hypot(u, v / read.c)), 0.5 * kPi);
  return rig;
}

}  // namespace

FileResult<OcamCalibration> read_ocam_calibration(std::string_view text, const std::string& file) {
  const Numbers numbers = numbers_in(text);
  if (numbers.bad_line > 0) return failure(FileError{file, numbers.bad_line, "neither a number nor a comment"});
  Taker taker(numbers.values);
  Calibration read;
  read.direct = taker.list();
  taker.list();
  for (double* const each : {&read.row, &read.column, &read.c, &read.d, &read.e, &read.height, &read.width})
    *each = taker.take();
  if (!taker.enough() || !taker.all())
    return failure(FileError{file, 0, "not the numbers of an OCamCalib calibration: too few, or too many"});
  if (const auto wrong = problem(read)) return failure(FileError{file, 0, *wrong});
  OcamCalibration calibration{rig_of(read), left_out_px(read)};
  if (calibration.left_out_px > kMostLeftOut_px)
    return failure(FileError{file, 0,
                             fmt::format("affine d = {} and e = {} shear the image by {:.1f} px, and no model here "
                                         "shears: calibrate anew, azimuth calibrate fisheye --chessboard does",
                                         read.d, read.e, calibration.left_out_px)});
  std::string why;
  if (!camera_of(calibration.camera, why)) return failure(FileError{file, 0, why});
  return calibration;
}

}  // namespace azimuth
