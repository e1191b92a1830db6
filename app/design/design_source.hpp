#pragma once
/// A dozer's design from whatever file somebody has.

#include "app/design/track_section.hpp"
#include "app/machines/simulated/simulated_dozer.hpp"

namespace graben::design {

/// Which file, and what of it.
struct DesignSource {
  std::filesystem::path file;    ///< By its ending: LandXML .xml, points .xyz .csv .pts, else corners.
  std::string surface;           ///< Of a LandXML file with several.
  std::vector<double> track_m;   ///< Corners in plan, x and y by turns; none: along its middle.
  double datum_m = 0.0;          ///< Height of the plane in the file.
};

/// Corners along the track. Throws as the readers, and std::runtime_error where an option is told
/// that such a file has no use for.
[[nodiscard]] std::vector<GradePoint> corners_of(const DesignSource& source,
                                                 const BladeAcross& blade);

/// The machine with these corners as its design, all of it to be made, and what it is simulated
/// with. Throws std::runtime_error with what of it this machine can't make.
[[nodiscard]] machines::SimulatedDozer with_design(machines::SimulatedDozer machine,
                                                   const std::vector<GradePoint>& corners,
                                                   const std::string& file);

}  // namespace graben::design
