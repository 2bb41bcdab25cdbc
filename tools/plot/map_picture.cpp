#include "tools/plot/map_picture.hpp"

#include <cmath>

#include "tools/plot/axes.hpp"
#include "tools/plot/canvas.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/map_layers.hpp"
#include "tools/plot/map_strokes.hpp"
#include "tools/plot/map_view.hpp"

namespace azimuth {
namespace {

constexpr double kWidth_px = 1600.0;
constexpr double kLeft_px = 110.0, kRight_px = 40.0, kLegendTop_px = 112.0, kBottom_px = 80.0, kNote_px = 40.0;
constexpr double kInner_px = kWidth_px - kLeft_px - kRight_px;

Axes axes_below(double top_px, const MapPicture& picture) {
  return {view_of(picture), {kLeft_px, top_px}, kInner_px, 420.0, 1150.0};
}

}  // namespace

std::optional<std::string> write_map_picture(const MapPicture& picture, const std::filesystem::path& file) {
  const std::optional<PlotFormat> format = plot_format(file);
  if (!format) return "the name of a picture must end in .png, .svg or .pdf";
  PlotCanvas ruler(1, 1, kPaperColour);
  const Legend legend(ruler, legend_entries(picture, axes_below(0.0, picture).shown_m()), kInner_px);
  const Axes axes = axes_below(kLegendTop_px + legend.height_px() + 14.0, picture);
  const std::string note = words(left_out(picture, axes.shown_m()), picture.landmark_word);
  const double axes_end_px = axes.frame_px().high.y() + kBottom_px;
  PlotCanvas canvas(static_cast<int>(kWidth_px),
                    static_cast<int>(std::lround(axes_end_px + (note.empty() ? 0.0 : kNote_px))), kPaperColour,
                    *format);
  canvas.text(picture.title, {kLeft_px, 56.0}, {34.0, kInkColour, true, Anchor::left});
  canvas.text(picture.subtitle, {kLeft_px, 94.0}, {22.0, kFaintColour, false, Anchor::left});
  legend.draw(canvas, {kLeft_px, kLegendTop_px});
  axes.draw(canvas);
  MapLayers(canvas, axes, picture).draw();
  canvas.text(note, {kLeft_px, axes_end_px + 14.0}, {19.0, kFaintColour, false, Anchor::left});
  return canvas.write(file);
}

}  // namespace azimuth
