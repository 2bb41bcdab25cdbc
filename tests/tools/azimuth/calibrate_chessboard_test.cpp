#include <filesystem>
#include <gmock/gmock.h>

#include "drivers/camera/jpeg.hpp"
#include "settings/rig.hpp"
#include "tests/support/rendered_boards.hpp"
#include "tests/tools/azimuth/command_line.hpp"
#include "tools/lens_fit/lens.hpp"

namespace azimuth::test {
namespace {

using ::testing::HasSubstr;

constexpr int kBoards = 9;

std::string jpeg_of(const ImageView& image) {
  JpegEncoder encoder;
  const auto file = encoder.encode(image, 90);
  return {reinterpret_cast<const char*>(file.data()), file.size()};
}

/// JPEG images of boards in different poses, and one image without a board. They are rendered once per process.
const std::vector<std::string>& rendered_files() {
  static const std::vector<std::string> files = [] {
    std::mt19937_64 random(1);
    const CameraModel camera = camera_185();
    std::vector<std::string> made;
    for (int i = 0; i < kBoards; ++i)
      made.push_back(jpeg_of(rendered(camera, kSide_px, kChessboard,
                                      board_somewhere(camera, kSide_px, kChessboard, 1.4, random), 2.0, random)
                                 .view()));
    const std::vector<std::byte> grey(as_size(kSide_px) * as_size(kSide_px), std::byte{90});
    made.push_back(jpeg_of({packed_format(PixelFormat::gray8, kSide_px, kSide_px), grey}));
    return made;
  }();
  return files;
}

class CalibrateChessboard : public testing::Test {
 protected:
  CalibrateChessboard() {
    std::filesystem::create_directory(folder_);
    for (std::size_t i = 0; i < rendered_files().size(); ++i) put(std::to_string(i) + ".jpg", rendered_files()[i]);
  }
  void put(const std::string& name, const std::string& bytes) {
    write_file(std::filesystem::path(folder_) / name, bytes);
  }
  Outcome calibrate(const std::string& board, const std::vector<std::string>& options = {}) {
    std::vector<std::string> arguments{"calibrate", "fisheye", folder_, "--chessboard", board};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return azimuth(arguments);
  }
  ScratchFolder scratch_;
  std::string folder_ = scratch_ / "boards", rig_ = scratch_ / "rig.toml", picture_ = scratch_ / "lens.png";
};

TEST_F(CalibrateChessboard, WritesARigAndAPicture) {
  const Outcome outcome = calibrate("9x6", {"--square", "0.03", "--out", rig_, "--picture", picture_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("images      10, a board found in 9 of them"));
  EXPECT_THAT(outcome.out, HasSubstr("no board    " + folder_ + "/9.jpg"));
  EXPECT_THAT(outcome.out, HasSubstr("heading     cannot tell"));
  EXPECT_THAT(outcome.out, HasSubstr(" m from the lens"));
  EXPECT_THAT(file_bytes(picture_), testing::StartsWith("\x89PNG"));
  const auto rig = read_rig_file(rig_);
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_NEAR((*rig->camera.image.centre_px)[0], 387.0, 0.5);
  EXPECT_NEAR((*rig->camera.image.centre_px)[1], 379.0, 0.5);
  std::string problem;
  const auto lens = lens_of(rig->camera, 0.5 * kSide_px, problem);
  ASSERT_TRUE(lens) << problem;
  for (double theta = 0.2; theta < 1.2; theta += 0.2)
    EXPECT_NEAR(radius_px(*lens, theta), radius_px(lens_185(), theta), 0.5) << theta;
  // A second calibration starts from the rig that the first one found.
  const Outcome again = calibrate("9x6", {"--rig", rig_});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr(" squares from the lens"));
}

TEST_F(CalibrateChessboard, SquaresCountedInPlaceOfCornersAreNoticed) {
  const Outcome outcome = calibrate("10x7");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("a chessboard of 10x7 inner corners was found in 0 of 10 images, and one of 9x6 in"));
}

TEST_F(CalibrateChessboard, RefusesImagesOfTwoSizesAndWhatIsNoImage) {
  const std::vector<std::byte> grey(64 * 48, std::byte{90});
  put("90.jpg", jpeg_of({packed_format(PixelFormat::gray8, 64, 48), grey}));
  const Outcome outcome = calibrate("9x6");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("90.jpg: is 64 x 48 pixels large, and the images before it 768 x 768"));
  put("90.jpg", rendered_files().front().substr(0, 3000));
  const Outcome cut = calibrate("9x6");
  EXPECT_EQ(cut.code, 2);
  EXPECT_THAT(cut.err, HasSubstr("90.jpg: "));
}

TEST_F(CalibrateChessboard, RefusesBoardsThatAreNone) {
  for (const char* board : {"9", "9x", "x6", "9x6x", "2x6", "9x999", "nine by six"}) {
    const Outcome outcome = calibrate(board);
    EXPECT_EQ(outcome.code, 2) << board;
    EXPECT_THAT(outcome.err, HasSubstr("must be COLUMNSxROWS")) << board;
  }
  EXPECT_THAT(azimuth({"calibrate", "fisheye", folder_, "--square", "0.03"}).err, HasSubstr("--chessboard"));
  EXPECT_THAT(azimuth({"calibrate", "fisheye", folder_, folder_}).err, HasSubstr("one RUN at a time"));
}

}  // namespace
}  // namespace azimuth::test
