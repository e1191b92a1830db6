// SPDX-License-Identifier: Apache-2.0
#include "app/design/design_source.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "app/design/curved_section.hpp"
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

/// None: it is straight, by its corners or along the middle.
std::optional<PlanTrack> curved_track(const DesignSource& source, const std::string& ending) {
  if (source.alignment) {
    if (ending != ".xml" || !source.track_m.empty() || source.radius_m > 0.0) {
      throw std::runtime_error(
          "--alignment is the track of a LandXML file (.xml); it does not go with --track or "
          "--radius");
    }
    return read_alignment(source.file, {*source.alignment, source.stations_m});
  }
  if (!source.stations_m.empty()) {
    throw std::runtime_error("--stations are of an --alignment");
  }
  if (source.radius_m <= 0.0) {
    return std::nullopt;
  }
  demand_corners(source.track_m);
  return rounded_track(source.track_m, source.radius_m);
}

machines::DesignLine along(const Surface& surface, const DesignSource& source,
                           const std::optional<PlanTrack>& curved, const BladeAcross& blade) {
  if (curved && curved->curves()) {
    return along_curved_track(surface, *curved, source.datum_m, blade);
  }
  if (curved) {
    const TrackPiece& last = curved->piece.back();
    const Eigen::Vector2d from_m = curved->piece.front().from_m;
    const Eigen::Vector2d to_m = last.at_m(last.length_m);
    return along_track(surface, straight_track({from_m.x(), from_m.y(), to_m.x(), to_m.y()}),
                       source.datum_m, blade);
  }
  const Track track =
      source.track_m.empty() ? middle_track(surface) : straight_track(source.track_m);
  return along_track(surface, track, source.datum_m, blade);
}

}  // namespace

machines::DesignLine line_of(const DesignSource& source, const BladeAcross& blade) {
  const std::string ending = source.file.extension().string();
  if (ending != ".xml" && !is_points(ending)) {
    if (!source.surface.empty() || source.has_track()) {
      throw std::runtime_error(
          "--surface, --track, --radius, --alignment, --stations and --datum are for a surface, "
          "LandXML (.xml) or points (.xyz, .csv, "
          ".pts): any other file is a line a corner, x along the track and height over the plane");
    }
    return machines::read_design(source.file);
  }
  const Surface surface = surface_of(source, ending);
  const std::optional<PlanTrack> curved = curved_track(source, ending);
  try {
    return along(surface, source, curved, blade);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", source.file.string(), error.what()));
  }
}

}  // namespace graben::design
