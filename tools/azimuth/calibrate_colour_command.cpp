// azimuth calibrate colour: learns colour classes from the parts of an image that the user points at.

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

#include "settings/colour_section.hpp"
#include "settings/configuration.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/calibrate/image_files.hpp"
#include "tools/calibrate/learn_colours.hpp"

namespace azimuth {
namespace {

struct ColourOptions {
  std::filesystem::path image, config, out;
  std::vector<std::string> classes, rectangles, clicks;
  CLI::Option *class_option = nullptr, *rectangle_option = nullptr, *click_option = nullptr;
};

ImageFile colour_image(const std::filesystem::path& file) {
  FileResult<ImageFile> image = read_image(file);
  if (!image) refuse(image.error());
  if (image->format.pixels != PixelFormat::rgb8) refuse(file.string() + ": has no colours");
  return *std::move(image);
}

PixelRectangle rectangle_or_refuse(const std::optional<PixelRectangle>& rectangle, const std::string& text,
                                   const char* form) {
  if (!rectangle) refuse(fmt::format("'{}' is not {} within the image", text, form));
  return *rectangle;
}

/// Reads the options in their order. A rectangle or click belongs to the class named before it, or else to the first.
std::vector<LabelledPixels> labelled_pixels(const CLI::App& command, const ColourOptions& options) {
  const ImageFile image = colour_image(options.image);
  std::vector<LabelledPixels> labelled;
  std::size_t names = 0, rectangles = 0, clicks = 0;
  const auto pixels_of = [&labelled](const std::string& name) -> std::vector<Rgb>& {
    const auto same = std::ranges::find(labelled, name, &LabelledPixels::name);
    return same != labelled.end() ? same->pixels : labelled.emplace_back(LabelledPixels{name, {}}).pixels;
  };
  for (const CLI::Option* option : command.parse_order()) {
    if (option == options.class_option) ++names;
    std::vector<Rgb>& pixels = pixels_of(options.classes[names == 0 ? 0 : names - 1]);
    if (option == options.rectangle_option) {
      const std::string& text = options.rectangles[rectangles++];
      const auto parsed = parse_rectangle(text, image.format);
      add_pixels(image.view(), rectangle_or_refuse(parsed, text, "a rectangle U0,V0,U1,V1"), pixels);
    }
    if (option == options.click_option) {
      const std::string& text = options.clicks[clicks++];
      add_pixels(image.view(), rectangle_or_refuse(parse_click(text, image.format), text, "a point U,V"), pixels);
    }
  }
  return labelled;
}

std::vector<ColourClass> known_classes(const std::filesystem::path& config) {
  if (config.empty()) return {};
  const FileResult<Configuration> read = read_configuration_file(config);
  if (!read) refuse(read.error());
  return read->perception.colour.classes;
}

void calibrate_colour(const CLI::App& command, const ColourOptions& options) {
  const std::vector<LabelledPixels> labelled = labelled_pixels(command, options);
  std::vector<ColourClass> learnt;
  for (const LabelledPixels& each : labelled) {
    const std::optional<ColourClass> colours = learn_class(each);
    if (!colours)
      refuse(fmt::format("class \"{}\": too few of its {} pixels have a hue", each.name, each.pixels.size()));
    learnt.push_back(*colours);
  }
  const std::vector<ColourClass> classes = updated(known_classes(options.config), learnt);
  const std::string text = separation_text(labelled, classes) + colour_classes_text(classes);
  if (const FileResult<Configuration> read = read_configuration(text, "the classes"); !read) refuse(read.error());
  if (options.out.empty()) {
    std::fputs(text.c_str(), stdout);
  } else {
    write_text(text, options.out);
  }
}

}  // namespace

void add_calibrate_colour_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "colour", "Learn the colours of landmarks from an image: the [[colour.class]] of azimuth.toml");
  const auto options = std::make_shared<ColourOptions>();
  command->add_option("IMAGE", options->image, "Image of the camera (JPEG, PPM)")->required();
  options->class_option =
      command
          ->add_option("--class", options->classes,
                       "Name of the class to which the --rectangle and --click options after it belong")
          ->required()
          ->allow_extra_args(false);
  options->rectangle_option =
      command->add_option("--rectangle", options->rectangles, "Part of the image that has the colour all over")
          ->type_name("U0,V0,U1,V1")
          ->allow_extra_args(false);
  options->click_option = command->add_option("--click", options->clicks, "Point well within a thing of the colour")
                              ->type_name("U,V")
                              ->allow_extra_args(false);
  command->add_option("--config", options->config, "Keep the other classes of this azimuth.toml");
  command->add_option("--out", options->out, "Write the classes to this file instead of printing them");
  command->callback([command, options] { calibrate_colour(*command, *options); });
}

}  // namespace azimuth
