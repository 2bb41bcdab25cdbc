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

TEST_F(CalibrateMirror, LeavesOutImagesThatCannotBeRead) {
  write_file(scratch_ / "empty.jpg", "");
  const Outcome outcome = azimuth({"calibrate", "mirror", scratch_ / "empty.jpg", image_, "--out", rig_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("left out: 1 of 2 images, which cannot be read: "));
  const Outcome none = azimuth({"calibrate", "mirror", scratch_ / "empty.jpg"});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("empty.jpg: "));
}

/// The time with health "tracking" that the output of a replay names [s].
double tracked_s(const std::string& report) {
  const std::string tracking = " tracking ";
  const std::size_t line = report.find("\nhealth "), at = report.find(tracking, line);
  return at < report.find('\n', line + 1) ? std::stod(report.substr(at + tracking.size())) : 0.0;
}

/// The images of the drive decide the choice; the name of the world is not used.
TEST_F(CalibrateMirror, ChoosesTheFrontEndThatTracks) {
  for (const auto& [world, front_end] : {std::pair("coloured-lab", "colour"), std::pair("hall", "sift")}) {
    const std::string run = scratch_ / world, rig = run + "/calibrated.toml";
    ASSERT_EQ(
        azimuth({"simulate", run, "--world", world, "--camera", "mirror", "--size", "0.5", "--seconds", "20"}).code, 0);
    const Outcome outcome = azimuth({"calibrate", "mirror", run, "--out", rig});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(std::string("front end   ") + front_end + ": 3 or more coloured landmarks"));
    EXPECT_THAT(file_bytes(rig), HasSubstr("\n# - front_end: 3 or more coloured landmarks are seen in "));
    EXPECT_THAT(file_bytes(rig), HasSubstr(std::string("\nfront_end = \"") + front_end + '"'));
    const Outcome replayed = azimuth({"replay", run, "--rig", rig});
    ASSERT_EQ(replayed.code, 0) << replayed.err;
    EXPECT_GE(tracked_s(replayed.out), 19.5) << world << ": " << replayed.out;
  }
}

TEST_F(CalibrateMirror, TakesTheFrontEndThatIsAskedFor) {
  ASSERT_EQ(azimuth({"calibrate", "mirror", image_, "--out", rig_, "--front-end", "colour"}).code, 0);
  EXPECT_EQ(read_rig_file(rig_)->front_end, FrontEnd::colour);
  EXPECT_THAT(file_bytes(rig_), HasSubstr("# - front_end: as asked for."));
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
