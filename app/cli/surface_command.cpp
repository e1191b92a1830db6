// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/design/design_source.hpp"
#include "app/design/surface_grid.hpp"
#include "app/machines/missing_file.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::cli {
namespace {

struct SurfaceCommand {
  design::DesignSource design;
  design::GridCut cut;
  std::vector<double> around_m;
  std::string out;
};

void make_grid(const SurfaceCommand& told) {
  design::DesignSource source = told.design;
  source.file = machines::find_design(source.file);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(source.file, ignored)) {
    throw std::runtime_error(
        machines::unread_text(source.file, "a design: LandXML, DXF, or points (.xyz, .csv, .pts)"));
  }
  assert_apart({source.file.string()}, {told.out});
  const design::Surface surface = design::surface_of(source);
  design::GridCut cut = told.cut;
  if (!told.around_m.empty()) {
    cut.around_m = Eigen::Vector2d(told.around_m[0], told.around_m[1]);
  }
  const machines::HeightGrid grid = [&] {
    try {
      return design::grid_of(surface, cut);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}: {}", source.file.string(), error.what()));
    }
  }();
  const auto known = std::count_if(grid.height_m.begin(), grid.height_m.end(),
                                   [](double height_m) { return !std::isnan(height_m); });
  if (known == 0) {
    throw std::runtime_error(fmt::format("{}: no face has a height there", source.file.string()));
  }
  write_whole(told.out, design::ascii_grid_text(grid));
  fmt::print("{}\n{:<24}{}\n{:<24}{} by {}, {} m apart\n{:<24}{} ({:.1f} %)\n", told.out, "faces",
             surface.face.size(), "heights", grid.columns, grid.rows, grid.step_m, "of them known",
             known, 100.0 * static_cast<double>(known) / static_cast<double>(grid.height_m.size()));
}

}  // namespace

void add_surface(CLI::App& app, int& status) {
  auto options = std::make_shared<SurfaceCommand>();
  CLI::App* command = add_command(app, "surface");
  command
      ->add_option("--design", options->design.file,
                   "LandXML surface, 3DFACEs of a DXF, or points x y z (.xyz, .csv, .pts, or as "
                   "--columns say), or a "
                   "shipped one")
      ->required();
  command->add_option(
      "--surface", options->design.surface,
      "Of a LandXML file with several: its name, '#2', or state=proposed; of a DXF its layer");
  command->add_option("--columns", options->design.columns,
                      "Of points, a letter each: P, N or Y, E or X, Z, D, as PNEZD");
  command
      ->add_option("--units", options->design.units,
                   "Of points: m, ft, us-ft; m unless told. Of a DXF instead of its own")
      ->check(one_of({"m", "ft", "us-ft"}));
  command->add_option("--step", options->cut.step_m, "Between two heights, m, 0.01 .. 0.5")
      ->check(number_between(machines::kLeastStep_m, machines::kMostStep_m))
      ->capture_default_str();
  command
      ->add_option("--around", options->around_m,
                   "Place of the machine: east and north, m; all of the surface unless told")
      ->expected(2)
      ->delimiter(',');
  command
      ->add_option("--half", options->cut.half_m,
                   "Half of the square's side about that place, m, 1 .. 1000")
      ->check(number_between(1.0, 1000.0))
      ->capture_default_str();
  command->add_option("--out", options->out, "ESRI ASCII grid to write")->required();
  add_examples(*command, {"surface --design crest.xml --out out/crest.asc",
                          "surface --design site.xml --around 4321,8765 --out out/site.asc"});
  command->callback(
      [options, &status] { status = guarded("surface", [&] { make_grid(*options); }); });
}

}  // namespace graben::cli
