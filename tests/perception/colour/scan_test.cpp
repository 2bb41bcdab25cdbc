// Compares the single-pass scan with a classification pixel by pixel.

#include "slam/perception/colour/scan.hpp"

#include <gmock/gmock.h>

#include "slam/perception/colour/class_table.hpp"
#include "slam/perception/colour/scan_loops.hpp"  // the portable loops, on any processor
#include "tests/perception/colour/colour_images.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

using test::Frame;
using testing::ElementsAreArray;

SampleSpace space_of(PixelFormat pixels) {
  const bool is_yuv = pixels == PixelFormat::yuyv || pixels == PixelFormat::uyvy || pixels == PixelFormat::nv12;
  return is_yuv ? SampleSpace::yuv : SampleSpace::rgb;
}

/// The class of one sample, computed from the definition of each format.
ClassNumber class_at(const Frame& frame, const ClassTable& table, int column, int row) {
  const auto byte = [&](int v, int offset) { return unsigned{frame.view().row(v)[offset]}; };
  const auto yuv = [&](int luma_at) {
    const int pair = column / 2 * 4, luma = pair + column % 2 * 2 + luma_at;
    return table.at(byte(row, luma), byte(row, pair + 1 - luma_at), byte(row, pair + 3 - luma_at));
  };
  const auto cell_at = [&](int red_v, int red_u) {
    const auto at = [&](int v, int u) { return byte(2 * row + v, 2 * column + u); };
    const unsigned green = (at(red_v, 1 - red_u) + at(1 - red_v, red_u) + 1) / 2;
    return table.at(at(red_v, red_u), green, at(1 - red_v, 1 - red_u));
  };
  switch (frame.format.pixels) {
    case PixelFormat::rgb8:
      return table.at(byte(row, 3 * column), byte(row, 3 * column + 1), byte(row, 3 * column + 2));
    case PixelFormat::bgr8:
      return table.at(byte(row, 3 * column + 2), byte(row, 3 * column + 1), byte(row, 3 * column));
    case PixelFormat::yuyv:
      return yuv(0);
    case PixelFormat::uyvy:
      return yuv(1);
    case PixelFormat::nv12: {
      const int chroma_row = frame.format.height_px + row / 2, pair = column / 2 * 2;
      return table.at(byte(row, column), byte(chroma_row, pair), byte(chroma_row, pair + 1));
    }
    case PixelFormat::bayer_rggb8:
      return cell_at(0, 0);
    case PixelFormat::bayer_grbg8:
      return cell_at(0, 1);
    case PixelFormat::bayer_gbrg8:
      return cell_at(1, 0);
    case PixelFormat::bayer_bggr8:
      return cell_at(1, 1);
    default:
      return 0;
  }
}

std::vector<ColourRun> runs_one_by_one(const Frame& frame, const ClassTable& table,
                                       std::span<const VisibleSpan> spans) {
  std::vector<ColourRun> runs;
  for (const VisibleSpan& span : spans) {
    ClassNumber before = 0;
    for (int column = span.begin; column < span.end; ++column) {
      const ClassNumber here = class_at(frame, table, column, span.row);
      const auto at = static_cast<std::uint16_t>(column), next = static_cast<std::uint16_t>(column + 1);
      if (here != 0 && here == before) {
        runs.back().end = next;
      } else if (here != 0) {
        runs.push_back({span.row, at, next, here});
      }
      before = here;
    }
  }
  return runs;
}

/// One or two random spans in each row of samples.
std::vector<VisibleSpan> random_spans(const FrameFormat& format, std::mt19937& random) {
  const int side = pixels_per_sample(format.pixels);
  std::vector<VisibleSpan> spans;
  for (int row = 0; row < format.height_px / side; ++row) {
    std::array<std::uint16_t, 4> ends{};
    for (std::uint16_t& end : ends)
      end = static_cast<std::uint16_t>(std::uniform_int_distribution<int>(0, format.width_px / side)(random));
    std::ranges::sort(ends);
    spans.push_back({static_cast<std::uint16_t>(row), ends[0], ends[1]});
    if (ends[1] < ends[2]) spans.push_back({static_cast<std::uint16_t>(row), ends[2], ends[3]});
  }
  return spans;
}

/// Stripes of one colour each, with some noise, so that runs of all lengths occur.
test::Canvas stripes(int width_px, int height_px, std::mt19937& random) {
  constexpr std::array kColours{test::kGrey, test::kRed, test::kYellow, test::kGreen, test::kBlue, Rgb{40, 42, 38}};
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  test::Canvas canvas(width_px, height_px);
  int left = 0;
  Rgb colour{};
  for (Rgb& pixel : canvas.pixels) {
    if (left-- == 0) {
      colour = kColours[static_cast<std::size_t>(draw(0, kColours.size() - 1))];
      left = draw(0, 40);
    }
    pixel = colour;
  }
  test::add_noise(canvas, draw(0, 12), random);
  return canvas;
}

class EveryFormat : public testing::TestWithParam<PixelFormat> {};
INSTANTIATE_TEST_SUITE_P(Formats, EveryFormat, testing::ValuesIn(test::kColourFormats), test::PrintedName());

TEST_P(EveryFormat, FindsTheRunsThatOnePixelAtATimeShows) {
  const ClassTable table(ColourSettings{}, space_of(GetParam()));
  std::mt19937 random(7);
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  std::size_t all = 0;
  for (int i = 0; i < 60; ++i) {
    const int width_px = 2 * draw(1, 60), height_px = draw(1, 12) * (GetParam() == PixelFormat::nv12 ? 2 : 1);
    const Frame frame = test::taken(stripes(width_px, height_px, random), GetParam(), draw(0, 5));
    const std::vector<VisibleSpan> spans = random_spans(frame.format, random);
    const std::vector<ColourRun> expected = runs_one_by_one(frame, table, spans);
    const Scan scan{frame.view().row(0), frame.format, table.data(), table.least_chroma()};
    std::vector<ColourRun> best(2000), portable(2000);
    best.resize(find_runs(scan, spans, best));
    portable.resize(scan_image(scan, spans.data(), spans.size(), portable.data(), portable.size()));
    ASSERT_THAT(best, ElementsAreArray(expected)) << width_px << " x " << height_px;
    ASSERT_THAT(portable, ElementsAreArray(expected)) << width_px << " x " << height_px;
    all += expected.size();
  }
  EXPECT_GT(all, 300U);
}

TEST_P(EveryFormat, SaysWhenThereIsNoRoomAndWritesNoFurther) {
  const ClassTable table(ColourSettings{}, space_of(GetParam()));
  test::Canvas canvas(64, 8);
  for (int v = 0; v < 8; ++v)
    for (int u = 0; u < 64; ++u)
      if (u % 8 < 4) canvas.at(u, v) = test::kRed;
  const Frame frame = test::taken(canvas, GetParam());
  const int side = pixels_per_sample(GetParam());
  std::vector<VisibleSpan> spans;
  for (int row = 0; row < 8 / side; ++row)
    spans.push_back({static_cast<std::uint16_t>(row), 0, static_cast<std::uint16_t>(64 / side)});
  const Scan scan{frame.view().row(0), frame.format, table.data(), table.least_chroma()};
  const auto there = static_cast<std::size_t>(8 * 8 / side);
  for (const std::size_t room : {std::size_t{0}, std::size_t{1}, there - 1, there, there + 1}) {
    std::vector<ColourRun> out(room + 1, ColourRun{9, 9, 9, 9});
    EXPECT_EQ(find_runs(scan, spans, std::span(out).first(room)), room < there ? room + 1 : there);
    EXPECT_EQ(out.back(), (ColourRun{9, 9, 9, 9}));
  }
}

}  // namespace
}  // namespace azimuth
