#include <gmock/gmock.h>

#include "settings/rig.hpp"
#include "tests/perception/rendered_images.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The lab through the mirror as a PGM file.
std::string mirror_pgm(const Image& image) {
  const std::string pixels(reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size());
  return "P5\n" + std::to_string(image.format.width_px) + " " + std::to_string(image.format.height_px) + "\n255\n" +
         pixels;
}

class CalibrateMirror : public testing::Test {
 protected:
  CalibrateMirror() { write_file(image_, mirror_pgm(mirror_image())); }
  ScratchFolder scratch_;
  std::string image_ = scratch_ / "image.pgm", rig_ = scratch_ / "rig.toml";
};

TEST_F(CalibrateMirror, WritesARigAndAPicture) {
  const Outcome outcome = azimuth({"calibrate", "mirror", image_, "--out", rig_, "--picture", scratch_ / "found.png"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("mirror      centre (51"));
  EXPECT_THAT(file_bytes(scratch_ / "found.png"), StartsWith("\x89PNG"));
  const auto rig = read_rig_file(rig_);
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(rig->camera.image.width_px, 1024);
  EXPECT_NEAR((*rig->camera.image.centre_px)[0], 512.0, 1.5);
  EXPECT_NEAR((*rig->camera.image.centre_px)[1], 384.0, 1.5);
  EXPECT_NEAR(*rig->camera.image.mask_outer_px, 374.0, 2.0);
  EXPECT_NEAR(*rig->camera.image.mask_inner_px, 62.0, 3.0);

  EXPECT_EQ(azimuth({"calibrate", "mirror", image_, "--compare", rig_}).code, 0);
  const Outcome again = azimuth({"calibrate", "mirror", image_, "--out", rig_});
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("exists already"));
}

TEST_F(CalibrateMirror, NoticesACameraThatWasKnocked) {
  write_file(rig_, "[camera]\nmodel = \"radial\"\ncentre_px = [502, 384]\n");
  const Outcome outcome = azimuth({"calibrate", "mirror", image_, "--compare", rig_});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("px off"));
  EXPECT_THAT(outcome.out, HasSubstr("calibrate anew"));
}

TEST_F(CalibrateMirror, AsksForTheModelsParameters) {
  const Outcome outcome = azimuth({"calibrate", "mirror", image_, "--model", "hyperbolic_mirror", "--out", rig_});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("needs the key 'mirror_a_mm'"));
  EXPECT_EQ(azimuth({"calibrate", "mirror", image_, "--model", "hyperbolic_mirror", "--out", rig_, "--mirror-a-mm",
                     "28", "--mirror-b-mm", "23", "--focal-length-px", "1035"})
                .code,
            0);
}

TEST_F(CalibrateMirror, SaysWhenThereIsNoMirror) {
  write_file(image_, mirror_pgm(blank(PixelFormat::gray8, 640, 480)));
  const Outcome outcome = azimuth({"calibrate", "mirror", image_, "--out", rig_});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no mirror found"));
}

TEST_F(CalibrateMirror, RefusesWhatItCannotRead) {
  EXPECT_EQ(azimuth({"calibrate"}).code, 2);
  EXPECT_EQ(azimuth({"calibrate", "mirror", scratch_ / "none.jpg"}).code, 2);
  write_file(scratch_ / "other.pgm", mirror_pgm(blank(PixelFormat::gray8, 640, 480)));
  const Outcome outcome = azimuth({"calibrate", "mirror", image_, scratch_ / "other.pgm"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("of another size"));
}

}  // namespace
}  // namespace azimuth::test
