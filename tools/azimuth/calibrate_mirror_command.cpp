// azimuth calibrate mirror: finds the mirror's circle and centre in images without a target.

#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "settings/rig.hpp"
#include "slam/camera/make_camera.hpp"
#include "tools/azimuth/calibrate_optics.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/calibrate/front_end_choice.hpp"
#include "tools/calibrate/image_files.hpp"
#include "tools/calibrate/mirror_picture.hpp"
#include "tools/calibrate/mirror_rig.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kMostPairs = 20;
constexpr double kClear = 0.5;  // in single images, a rim less clear than this is sometimes mistaken

struct MirrorOptions {
  std::vector<std::filesystem::path> images;
  std::size_t most_images = 40;
  std::filesystem::path out, picture, compare;
  MirrorModel model;
  std::string front_end = "by_images";
  bool force = false;
};

/// Counts images that cannot be read. A damaged image among good ones does not end the search.
struct Unread {
  int count = 0;
  FileErrors first;

  std::optional<ImageFile> read(const std::filesystem::path& file) {
    FileResult<ImageFile> image = read_image(file);
    if (image) return *std::move(image);
    if (count++ == 0) first = image.error();
    return std::nullopt;
  }
};

MirrorSearch find_mirror(const MirrorOptions& options) {
  FileResult<std::vector<std::filesystem::path>> files = image_files(options.images, options.most_images);
  if (!files) refuse(files.error());
  MirrorFinder finder;
  MirrorSearch search;
  Unread unread;
  for (const std::filesystem::path& file : *files) {
    std::optional<ImageFile> image = unread.read(file);
    if (!image) continue;
    if (!finder.add(image->view()))
      refuse(file.string() +
             ": is of another size than the images before it, or smaller than any mirror can be seen in");
    if (search.images++ == 0) search.first = *std::move(image);
  }
  if (search.images == 0) refuse(unread.first);
  if (unread.count > 0)
    print_error(fmt::format("left out: {} of {} images, which cannot be read: {}", unread.count, files->size(),
                            unread.first.front().text()));
  const std::optional<MirrorCircle> mirror = finder.find();
  if (!mirror) fail("no mirror found: no circle in these images is surely its rim; more images of other places help");
  search.mirror = *mirror;
  return search;
}

void print_mirror(const MirrorSearch& search) {
  const MirrorCircle& mirror = search.mirror;
  fmt::print("mirror      centre ({:.2f}, {:.2f}) px +- {:.2f}, radius {:.2f} px +- {:.2f}, in {} image{}\n",
             mirror.rim.centre_px.x(), mirror.rim.centre_px.y(), mirror.sigma_centre_px, mirror.rim.radius_px,
             mirror.sigma_radius_px, search.images, search.images == 1 ? "" : "s");
  fmt::print("rim         {:.0f} % of it in the image, an edge on {:.0f} % of that, clearness {:.2f}\n",
             100.0 * mirror.rim_in_image, 100.0 * mirror.rim_seen, mirror.clearness);
  if (mirror.clearness < kClear) fmt::print("doubtful    look at --picture, and give images of more places\n");
  if (mirror.inner) {
    fmt::print("inner disc  centre ({:.1f}, {:.1f}) px, radius {:.1f} px\n", mirror.inner->centre_px.x(),
               mirror.inner->centre_px.y(), mirror.inner->radius_px);
  } else {
    fmt::print("inner disc  none found\n");
  }
}

FrontEndsSeenAgain front_ends_seen(const MirrorOptions& options, const Rig& rig) {
  const auto files = image_files(options.images, std::numeric_limits<std::size_t>::max());
  if (!files) refuse(files.error());
  FrontEndTrial trial(rig.camera);
  Unread unread;
  for (const auto& [earlier, later] : image_pairs(*files, kMostPairs)) {
    const std::optional<ImageFile> before = unread.read(earlier), after = unread.read(later);
    if (before && after) trial.add(before->view(), after->view());
  }
  return trial.seen();
}

/// Sets the rig's front end and returns the reason for the choice.
std::string choose_front_end(const MirrorOptions& options, Rig& rig, bool quiet = false) {
  const FrontEndsSeenAgain seen = front_ends_seen(options, rig);
  rig.front_end = front_end_for(seen);
  std::string why = reason(seen);
  if (quiet) return why;
  fmt::print("front end   {}: {}\n", rig.front_end == FrontEnd::colour ? "colour" : "sift", why);
  if (is_doubtful(seen)) fmt::print("doubtful    hardly anything is seen again: record several images to a metre\n");
  return why;
}

/// Prints the next command if the rig was written into a run folder.
void say_what_next(const MirrorOptions& options) {
  const std::filesystem::path& run = options.images.front();
  std::error_code ignored;
  if (std::filesystem::exists(run / "odometry.csv", ignored) &&
      std::filesystem::equivalent(run / "rig.toml", options.out, ignored))
    fmt::print(
        "next: azimuth replay {0} --plot map.png; azimuth check {0} says whether the heading is up in the image\n",
        run.string());
}

/// Writes the rig only if it can be read back, since the model may need a parameter that was not given.
void write_rig(const MirrorSearch& search, const MirrorOptions& options) {
  if (!options.force && std::filesystem::exists(options.out))
    refuse(options.out.string() + ": exists already; --force replaces it");
  Rig rig = mirror_rig(search.mirror, search.first.format, options.model);
  std::string why;
  if (options.front_end == "by_images")
    why = choose_front_end(options, rig);
  else
    rig.front_end = options.front_end == "colour" ? FrontEnd::colour : FrontEnd::sift;
  const std::string text = mirror_rig_text(rig, search.images, why);
  if (const FileResult<Rig> read = read_rig(text, options.out.string()); !read) refuse(read.error());
  write_text(text, options.out);
  say_what_next(options);
}

void draw(const MirrorSearch& search, const std::filesystem::path& file) {
  PlotCanvas picture = mirror_picture(search.first.view(), search.mirror);
  if (const auto problem = picture.write(file)) fail(file.string() + ": " + *problem);
}

void compare(const MirrorSearch& search, const std::filesystem::path& file) {
  const FileResult<Rig> rig = read_rig_file(file);
  if (!rig) refuse(rig.error());
  const ImageRig& image = rig->camera.image;
  if (!is_size_of(search.first.format, image)) refuse(file.string() + ": is for images of another size");
  if (!image.centre_px && !(image.width_px && image.height_px)) refuse(file.string() + ": says no centre");
  const CentreComparison comparison = compare_centre(search.mirror, image);
  fmt::print("{}\n", text(comparison, shown(file)));
  if (!comparison.agrees) throw CommandError{kFailure, ""};
}

void calibrate_mirror(const MirrorOptions& options) {
  if (!options.picture.empty() && plot_format(options.picture) != PlotFormat::png)
    refuse(options.picture.string() + ": the name of a picture of pixels must end in .png");
  check_writable(options.picture);
  const MirrorSearch search = find_mirror(options);
  print_mirror(search);
  if (!options.picture.empty()) draw(search, options.picture);
  if (!options.out.empty()) write_rig(search, options);
  if (!options.compare.empty()) compare(search, options.compare);
}

void add_model_options(CLI::App& command, MirrorOptions& options) {
  command.add_option("--model", options.model.model, "Camera model in rig.toml; radial knows azimuths only")
      ->check(CLI::IsMember({"radial", "hyperbolic_mirror", "parabolic_mirror"}))
      ->capture_default_str();
  command.add_option("--mirror-a-mm", options.model.mirror_a_mm,
                     "Semi-axis a of hyperbolic_mirror: z^2/a^2 - r^2/b^2 = 1");
  command.add_option("--mirror-b-mm", options.model.mirror_b_mm, "Semi-axis b of hyperbolic_mirror");
  command.add_option("--focal-length-px", options.model.focal_length_px,
                     "Focal length of the camera of hyperbolic_mirror");
  command.add_option("--horizon-radius-px", options.model.horizon_radius_px,
                     "Radius of the horizon of parabolic_mirror");
  command
      .add_option("--front-end", options.front_end,
                  "Front end in rig.toml; by_images: the one that recognises more in the images")
      ->check(CLI::IsMember({"by_images", "sift", "colour"}))
      ->capture_default_str();
}

}  // namespace

RigByMirror rig_by_mirror(const std::filesystem::path& run, bool quiet) {
  MirrorOptions options;
  options.images = {run};
  RigByMirror found{.search = find_mirror(options), .rig = {}};
  if (!quiet) print_mirror(found.search);
  found.rig = mirror_rig(found.search.mirror, found.search.first.format, options.model);
  choose_front_end(options, found.rig, quiet);
  return found;
}

void add_calibrate_mirror_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "mirror",
      "Find the mirror's circle and centre in images; exit code 1: there is none, or the compared rig is off");
  const auto options = std::make_shared<MirrorOptions>();
  command
      ->add_option("IMAGE", options->images,
                   "Images (JPEG, PGM, PPM), folders of images or run folders; several places are better than one")
      ->required();
  command->add_option("--most-images", options->most_images, "Number of images to look at, evenly spread")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--out", options->out, "Write a rig.toml with the mirror that was found");
  command->add_flag("--force", options->force, "Replace the file of --out if it exists");
  command->add_option("--picture", options->picture, "Draw the mirror that was found on the first image, as PNG");
  command->add_option("--compare", options->compare, "Say how far off the centre in this rig.toml is");
  add_model_options(*command, *options);
  command->callback([options] { calibrate_mirror(*options); });
}

}  // namespace azimuth
