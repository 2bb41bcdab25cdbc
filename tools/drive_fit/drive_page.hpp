#pragma once
// The page of azimuth calibrate RUN: what a drive tells of the rig, and why.

#include <string>
#include <vector>

#include "tools/plot/canvas.hpp"

namespace azimuth {

/// A value of the rig that the drive tells. All texts are plain text in the units of the key.
struct FoundValue {
  std::string part = {}, key = {};  ///< name of the printed line, and "table.key" in rig.toml
  std::string said = {};            ///< the value before the drive; empty: there was none
  std::string found = {};           ///< the value that fits the drive best, even if the rig keeps its own
  std::string two_sigma = {};       ///< two standard deviations of `found`
  bool is_replaced = false;
  std::string judgement = {};
};

/// A value that the drive cannot tell, and the motion that would tell it.
struct UntoldValue {
  std::string part, what_would;
};

struct PageFigure {
  std::string name, caption;
  std::string source;  ///< from figure_source()
};

struct DrivePage {
  std::string run, made_by;
  std::string rig_file;  ///< the rig before the drive; empty: there was none, and FoundValue::said are defaults
  std::vector<FoundValue> found;
  std::vector<UntoldValue> untold;
  std::vector<PageFigure> figures;
  std::string rig_text;  ///< the rig.toml with the values that were found
};

/// The picture as a data URL for the source of an image, or the reason if the drawing failed. A picture of its own
/// keeps the names inside its SVG apart from those of the other pictures.
tl::expected<std::string, std::string> figure_source(PlotCanvas picture, PlotFormat format);

/// The page as HTML, which is self-contained and has no script. Reentrant.
std::string drive_page(const DrivePage& page);

}  // namespace azimuth
