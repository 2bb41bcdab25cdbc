#pragma once
// The tables of azimuth.toml below its top, each bound to what it sets, which must outlive it. Internal to settings/.
// Those of colours are in colour_section.hpp.

#include "settings/configuration.hpp"
#include "settings/section.hpp"

namespace azimuth {

/// Of a section that has one.
inline Key preset_key(Preset& preset, std::string_view help) {
  return choice<Preset>("preset", preset, {{"default", Preset::recommended}, {"paper", Preset::paper}}, help);
}

Section fastslam_section(FastSlamSettings& fastslam, FastSlamPreset& preset);
/// The preset's values.
FastSlamSettings fastslam_preset(FastSlamPreset preset);

Section health_section(HealthSettings& health);
Section identity_section(IdentitySettings& identity, Preset& preset);
Section lamp_ekf_section(LampEkfSettings& lamp_ekf);
Section lamps_section(LampSettings& lamps);
Section map_section(MapStart& start);
Section relocalisation_section(RelocalisationSettings& relocalisation);
Section sift_section(SiftSettings& sift, Preset& preset);
Section smoother_section(HindsightSettings& smoother);

}  // namespace azimuth
