// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A dozer's design from whatever file somebody has.

#include "app/design/track_section.hpp"

namespace graben::design {

/// Which file, and what of it.
struct DesignSource {
  /// LandXML or DXF by what it contains; else points, or a line a corner (kind_of).
  std::filesystem::path file;
  /// Of a LandXML file with several: its name, "#2", or "state=proposed"; of a DXF its layer.
  std::string surface;
  std::string columns;          ///< Of a file of points (PointFormat).
  std::string units;            ///< Of a file of points, or of a DXF (metres_of_unit).
  std::vector<double> track_m;  ///< Corners in plan, x and y by turns; none: along its middle.
  double datum_m = 0.0;         ///< Height of the plane in the file.
  double radius_m = 0.0;        ///< Of an arc at each of those corners; 0: they are in line.
  /// The track instead, of a LandXML file's, as its surface is chosen.
  std::optional<std::string> alignment;
  std::filesystem::path alignment_file;  ///< It is in; the design's own unless told.
  std::vector<double> stations_m;        ///< Of that, from and to; none: all of it.

  /// Says more than which surface of a file.
  [[nodiscard]] bool has_track() const {
    return !columns.empty() || !units.empty() || !alignment_file.empty() || !track_m.empty() ||
           datum_m != 0.0 || radius_m > 0.0 || alignment || !stations_m.empty();
  }
};

/// What such a file is.
enum class DesignKind { kLandXml, kDxf, kPoints, kLine };

/// By what it contains: LandXML begins with a '<', DXF with a section, or it is called .dxf. What
/// lines of numbers are their columns can't say: points where --columns say what they are or the
/// ending is .xyz, .csv or .pts, a line a corner where it is .txt, in whatever letters. Throws
/// std::runtime_error for any other ending, and for a DWG or an archive, whatever its ending.
[[nodiscard]] DesignKind kind_of(const DesignSource& source);

/// The surface of a LandXML file, a DXF or of points. Throws as their readers, and
/// std::runtime_error for a line a corner and for an option that such a file has no use for.
[[nodiscard]] Surface surface_of(const DesignSource& source);

/// The design along the track. Throws as the readers, and std::runtime_error where an option is
/// told that such a file has no use for.
[[nodiscard]] machines::DesignLine line_of(const DesignSource& source, const BladeAcross& blade);

}  // namespace graben::design
