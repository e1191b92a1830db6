// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A dozer's design from whatever file somebody has.

#include "app/design/track_section.hpp"

namespace graben::design {

/// Which file, and what of it.
struct DesignSource {
  std::filesystem::path
      file;             ///< By its ending: LandXML .xml, points .xyz .csv .pts, else corners.
  std::string surface;  ///< Of a LandXML file with several.
  std::vector<double> track_m;  ///< Corners in plan, x and y by turns; none: along its middle.
  double datum_m = 0.0;         ///< Height of the plane in the file.
  double radius_m = 0.0;        ///< Of an arc at each of those corners; 0: they are in line.
  /// The track instead, of a LandXML file's, by its name.
  std::optional<std::string> alignment;
  std::vector<double> stations_m;  ///< Of that, from and to; none: all of it.

  /// Says more than which surface of a file.
  [[nodiscard]] bool has_track() const {
    return !track_m.empty() || datum_m != 0.0 || radius_m > 0.0 || alignment || !stations_m.empty();
  }
};

/// The design along the track. Throws as the readers, and std::runtime_error where an option is
/// told that such a file has no use for.
[[nodiscard]] machines::DesignLine line_of(const DesignSource& source, const BladeAcross& blade);

}  // namespace graben::design
