#include "tools/azimuth/html_output.hpp"

#include <algorithm>

#include "tools/azimuth/command.hpp"
#include "tools/replay_page/page_run.hpp"

namespace azimuth {
namespace {

/// The limits of one run's pictures: all runs share the bytes of the page.
PictureLimits limits_of(const HtmlWishes& wishes, std::size_t runs) {
  PictureLimits limits;
  limits.bytes /= std::max<std::size_t>(1, runs);
  limits.pictures = wishes.pictures;
  return limits;
}

}  // namespace

void add_html_options(CLI::App& command, HtmlWishes& wishes) {
  command.add_option("--html", wishes.file,
                     "Write one self-contained page for a browser: map, errors and 2 sigma over time, NIS and ANEES, "
                     "bearings, health with its reasons, images with the landmarks seen in them");
  command
      .add_option("--html-pictures", wishes.pictures,
                  "Most images of each run in the page of --html; they are drawn smaller so that all take no more than "
                  "4 MB. 0: none")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
}

ReplayWatch HtmlOutput::watch(const ReplaySetup& setup) {
  log_ = {};
  pictures_.reset();
  if (!is_wanted()) return {};
  if (wishes_.pictures > 0 && !setup.run.frames.empty() && takes_images(setup.rig.camera.model))
    pictures_.emplace(setup.run, setup.rig.camera, limits_of(wishes_, runs_));
  return {.before_update =
              [this](const BearingSet& set, const Estimator& before) {
                log_.before_update(set, before);
                if (pictures_) pictures_->before_update(set, before);
              },
          .after_step =
              [this](const Estimate& estimate) {
                log_.after_step(estimate);
                if (pictures_) pictures_->after_step(estimate);
              }};
}

void HtmlOutput::add(const ReplaySetup& setup, const ReplayResult& result, const Report& report) {
  if (!is_wanted() || result.estimates.empty()) return;
  const auto pictures = pictures_ ? std::span(pictures_->pictures()) : std::span<const PagePicture>();
  done_.push_back(page_run({.run = setup.run,
                            .result = result,
                            .report = report,
                            .steps = log_.steps(),
                            .pictures = pictures,
                            .classes = setup.configuration.perception.colour.classes},
                           runs_));
}

void HtmlOutput::write() const {
  if (!done_.empty() && !wishes_.file.empty()) write_text(replay_page(done_, "azimuth " AZIMUTH_VERSION), wishes_.file);
}

}  // namespace azimuth
