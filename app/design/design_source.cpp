// SPDX-License-Identifier: Apache-2.0
#include "app/design/design_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

#include "app/design/curved_section.hpp"
#include "app/design/dxf_groups.hpp"
#include "app/machines/design_file.hpp"
#include "app/machines/plain_text.hpp"

namespace graben::design {
namespace {

constexpr const char* kOfSurface =
    "--surface, --columns, --units, --track, --radius, --alignment, --alignment-file, --stations "
    "and "
    "--datum are for a surface, LandXML, DXF or points";

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

/// By its first character, in any encoding that XML may have.
bool is_xml(const std::string& text) {
  const std::size_t at =
      text.find_first_not_of(std::string_view("\xEF\xBB\xBF\xFF\xFE\0 \t\r\n", 10));
  return at != std::string::npos && text[at] == '<';
}

/// What a program keeps for itself: by its first letters, whatever its ending says.
void refuse_closed(const std::filesystem::path& file, const std::string& text) {
  const char* wrong = text.compare(0, 4, "AC10") == 0
                          ? "is a DWG; allowed: DXF of text, as CAD saves it too"
                      : text.compare(0, 4, "PK\3\4") == 0 || text.compare(0, 2, "\x1F\x8B") == 0
                          ? "is an archive; allowed: the file that is in it"
                          : nullptr;
  if (wrong != nullptr) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), wrong));
  }
}

Surface surface_of(const DesignSource& source, DesignKind kind) {
  if (kind == DesignKind::kLandXml) {
    if (!source.columns.empty() || !source.units.empty()) {
      throw std::runtime_error("--columns and --units are of points; a LandXML file says its own");
    }
    return read_landxml(source.file, source.surface);
  }
  if (kind == DesignKind::kDxf) {
    if (!source.columns.empty()) {
      throw std::runtime_error("--columns are of points; a DXF has faces");
    }
    return read_dxf(source.file, source.surface, source.units);
  }
  if (!source.surface.empty()) {
    throw std::runtime_error("--surface chooses one of a LandXML file's, or a layer of a DXF");
  }
  return read_points(source.file, {source.columns, metres_of_unit(source.units)});
}

/// None: it is straight, by its corners or along the middle.
std::optional<PlanTrack> curved_track(const DesignSource& source, DesignKind kind) {
  const bool is_other = !source.alignment_file.empty();
  if (source.alignment || is_other) {
    if ((kind != DesignKind::kLandXml && !is_other) || !source.track_m.empty() ||
        source.radius_m > 0.0) {
      throw std::runtime_error(
          "--alignment is the track of a LandXML file, the design's or --alignment-file; it does "
          "not "
          "go with --track or --radius");
    }
    return read_alignment(is_other ? source.alignment_file : source.file,
                          {source.alignment.value_or(""), source.stations_m});
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

Surface surface_of(const DesignSource& source) {
  const DesignKind kind = kind_of(source);
  if (kind == DesignKind::kLine) {
    throw std::runtime_error(
        fmt::format("{}: is a line a corner, which is no surface; allowed: LandXML, DXF, or points "
                    "(.xyz, .csv, "
                    ".pts, or as --columns say)",
                    source.file.string()));
  }
  return surface_of(source, kind);
}

DesignKind kind_of(const DesignSource& source) {
  const std::string ending = ending_of(source.file);
  const std::string text = machines::file_text(source.file, "a design");
  refuse_closed(source.file, text);
  if (is_xml(text)) {
    return DesignKind::kLandXml;
  }
  if (ending == ".dxf" || is_dxf(text)) {
    return DesignKind::kDxf;
  }
  const bool is_points = ending == ".xyz" || ending == ".csv" || ending == ".pts";
  if (is_points || !source.columns.empty()) {
    return DesignKind::kPoints;
  }
  if (ending != ".txt") {
    throw std::runtime_error(fmt::format(
        "{}: is no LandXML and no DXF, and its ending '{}' does not say what its numbers are; "
        "allowed: .xyz, "
        ".csv and .pts for points or --columns that say so, as XYZ or PNEZD; .txt for a line a "
        "corner, x along the track and height over the plane",
        source.file.string(), ending));
  }
  return DesignKind::kLine;
}

machines::DesignLine line_of(const DesignSource& source, const BladeAcross& blade) {
  const DesignKind kind = kind_of(source);
  if (kind == DesignKind::kLine) {
    if (!source.surface.empty() || source.has_track()) {
      throw std::runtime_error(fmt::format(
          "{}: this one is a line a corner, x along the track and height over the plane, unless "
          "--columns say what a point's are",
          kOfSurface));
    }
    return machines::read_design(source.file);
  }
  const Surface surface = surface_of(source, kind);
  const std::optional<PlanTrack> curved = curved_track(source, kind);
  try {
    return along(surface, source, curved, blade);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", source.file.string(), error.what()));
  }
}

}  // namespace graben::design
