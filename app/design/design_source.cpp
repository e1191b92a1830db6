// SPDX-License-Identifier: Apache-2.0
#include "app/design/design_source.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "app/machines/design_file.hpp"

namespace graben::design {
namespace {

bool is_points(const std::string& ending) {
  return ending == ".xyz" || ending == ".csv" || ending == ".pts";
}

Surface surface_of(const DesignSource& source, const std::string& ending) {
  if (ending == ".xml") {
    return read_landxml(source.file, source.surface);
  }
  if (!source.surface.empty()) {
    throw std::runtime_error("--surface chooses one of a LandXML file's, which ends in .xml");
  }
  return read_points(source.file);
}

}  // namespace

machines::DesignLine line_of(const DesignSource& source, const BladeAcross& blade) {
  const std::string ending = source.file.extension().string();
  if (ending != ".xml" && !is_points(ending)) {
    if (!source.surface.empty() || !source.track_m.empty() || source.datum_m != 0.0) {
      throw std::runtime_error(
          "--surface, --track and --datum are for a surface, LandXML (.xml) or points (.xyz, .csv, "
          ".pts): any other file is a line a corner, x along the track and height over the plane");
    }
    return machines::read_design(source.file);
  }
  const Surface surface = surface_of(source, ending);
  const Track track =
      source.track_m.empty() ? middle_track(surface) : straight_track(source.track_m);
  try {
    return along_track(surface, track, source.datum_m, blade);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", source.file.string(), error.what()));
  }
}

}  // namespace graben::design
