// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "app/cli/options.hpp"
#include "app/machines/missing_file.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::cli {

void add_design_options(CLI::App& command, design::DesignSource& source) {
  command.add_option(
      "--design", source.file,
      "Instead of the profile's design, a file or a shipped one (trench.xml, banked.xml, "
      "curved.xml): a LandXML surface, 3DFACEs of a DXF, points x y z (.xyz, .csv, .pts, or as "
      "--columns say), or a text (.txt) with x along the track and height over the plane, a line a "
      "corner, and where the blade tilts the slope across and the track's curvature");
  command.add_option(
      "--surface", source.surface,
      "Of a LandXML file with several: its name, its number as '#2', or its state as "
      "state=proposed; of a DXF its layer");
  command.add_option(
      "--columns", source.columns,
      "Of points, a letter each: P name, N or Y northing, E or X easting, Z height, D "
      "description, as PNEZD; as the file's first line names them, else XYZ, unless "
      "told");
  command
      .add_option(
          "--units", source.units,
          "Of points: m, ft, us-ft (US survey feet); m unless told. Of a DXF instead of its own")
      ->check(one_of({"m", "ft", "us-ft"}));
  command
      .add_option(
          "--track", source.track_m,
          "Way of the blade's middle over the surface: x and y of its start, of corners, and "
          "of its end, m; along x through the middle unless told")
      ->expected(4, 64)
      ->delimiter(',');
  command
      .add_option("--radius", source.radius_m,
                  "Of the arcs at that track's corners, m, 2 .. 1000, of a blade that tilts; "
                  "straight unless told")
      ->check(number_between(2.0, 1000.0));
  command.add_option("--alignment", source.alignment,
                     "The track instead: an alignment of the LandXML file, chosen as --surface");
  command.add_option("--alignment-file", source.alignment_file,
                     "The LandXML file with that alignment, where it is not the design's");
  command
      .add_option("--stations", source.stations_m,
                  "From and to on that alignment, m; all of it unless told")
      ->expected(2)
      ->delimiter(',');
  command
      .add_option("--datum", source.datum_m,
                  "What height of the surface is the machine's 0, m, -10000 .. 10000")
      ->check(number_between(-1e4, 1e4))
      ->capture_default_str();
}

Designed designed(const machines::SimulatedDozer& machine, const design::DesignSource& told) {
  design::DesignSource source = told;
  source.file = machines::find_design(told.file);
  if (source.file.empty()) {
    if (!source.surface.empty() || source.has_track()) {
      throw std::runtime_error(
          "--surface, --columns, --units, --track, --radius, --alignment, --alignment-file, "
          "--stations and --datum are of a --design");
    }
    return {machine, {}};
  }
  std::error_code ignored;
  if (!std::filesystem::exists(source.file, ignored) ||
      std::filesystem::is_directory(source.file, ignored)) {
    throw std::runtime_error(machines::unread_text(
        source.file,
        "a design: LandXML, DXF, points (.xyz, .csv, .pts), or a line a corner (.txt)"));
  }
  const design::BladeAcross blade{machine.plant.blade_shape.width_m,
                                  machine.profile.grade.tolerance_m, machine.profile.tilt.present};
  machines::DesignLine line = design::line_of(source, blade);
  return {
      machines::with_design(machine, line, machine.profile.grade.rounding_m, source.file.string()),
      std::move(line)};
}

}  // namespace graben::cli
