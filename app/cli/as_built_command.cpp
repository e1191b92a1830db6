// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "app/built/built_files.hpp"
#include "app/built/edge_log.hpp"
#include "app/built/ground_folder.hpp"
#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/design/design_source.hpp"
#include "app/machines/missing_file.hpp"
#include "app/machines/profile_file.hpp"
#include "app/reports/built/built_page.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

/// Earlier stamps, of 2001, are no clock's: of a simulation, or of one that was never set.
constexpr double kClock_s = 1e9;

struct AsBuiltCommand {
  std::vector<std::string> logs;
  std::string record;
  built::EdgeAsk ask;
  design::DesignSource design;
  std::string out;
  std::string points;
  std::string ascii;
  std::string html;
  std::string project;
  std::string ground = "load";
  std::string height = "lowest";
  double grid_m = 0.1;
  double tolerance_m = 0.03;

  /// Beside the grid: it has no place for date and machine.
  [[nodiscard]] std::string ascii_head() const { return ascii.empty() ? "" : ascii + ".aux.xml"; }
  [[nodiscard]] std::vector<std::string> outputs() const {
    return {out, points, ascii, ascii_head(), html};
  }
};

machines::AnyMachine machine_of(const AsBuiltCommand& options) {
  machines::AnyMachine machine = machines::load_any(machines::find_profile(options.ask.profile));
  if (!options.ask.bus.empty()) {
    auto* excavator = std::get_if<machines::ExcavatorMachine>(&machine);
    if (excavator == nullptr) {
      throw std::runtime_error(fmt::format(
          "--bus {}: a dozer is on no bus but ours; allowed: an excavator", options.ask.bus));
    }
    machines::put_on_bus(options.ask.bus, *excavator);
  }
  return machine;
}

std::string machine_words(const machines::AnyMachine& machine) {
  return std::visit(
      [](const auto& any) { return fmt::format("{} (profile {:08x})", any.name, any.hash); },
      machine);
}

/// None: none was told.
std::optional<design::Surface> design_of(const design::DesignSource& told) {
  if (told.file.empty()) {
    if (!told.surface.empty() || !told.columns.empty() || !told.units.empty()) {
      throw std::runtime_error("--surface, --columns and --units are of a --design");
    }
    return std::nullopt;
  }
  design::DesignSource source = told;
  source.file = machines::find_design(told.file);
  std::error_code ignored;
  if (!fs::exists(source.file, ignored) || fs::is_directory(source.file, ignored)) {
    throw std::runtime_error(
        machines::unread_text(source.file, "a design: LandXML, DXF, or points (.xyz, .csv, .pts)"));
  }
  return design::surface_of(source);
}

/// Each log after the other: what is newest goes by their times.
built::CellGrid read_logs(const AsBuiltCommand& options, const machines::AnyMachine& machine,
                          built::BuiltHead& head, std::vector<std::string>& notes) {
  built::CellGrid grid(options.grid_m);
  ProgressBar bar("as-built");
  for (std::size_t n = 0; n < options.logs.size(); ++n) {
    const std::string& name = options.logs[n];
    bar.show(static_cast<double>(n) / static_cast<double>(options.logs.size()), name);
    const built::EdgeLog log = built::read_edge(
        name, machine, options.ask, [&grid](const built::EdgeStep& step) { grid.add(step); });
    if (n > 0 && log.from_s < head.until_s) {
      throw std::runtime_error(fmt::format(
          "{}: begins at {}, before {} ends ({}); allowed: logs one after the other, "
          "in their order",
          name, built::utc_text(log.from_s), options.logs[n - 1], built::utc_text(head.until_s)));
    }
    head.from_s = n == 0 ? log.from_s : head.from_s;
    head.until_s = log.until_s;
    head.way_m += log.way_m;
    head.worked_m += log.worked_m;
    const std::vector<std::string> said = log.read.notes();
    notes.insert(notes.end(), said.begin(), said.end());
  }
  if (grid.size() == 0) {
    throw std::runtime_error(fmt::format(
        "{}: the edge went {:.1f} m, {:.1f} m of it at work, and over no cell of {} m; {}",
        options.logs.back(), head.way_m, head.worked_m, options.grid_m,
        head.worked_m > 0.0 ? "a smaller --grid has more"
                            : "with --ground every each place where it was counts"));
  }
  return grid;
}

/// Of what the controller itself has kept.
built::CellGrid read_record(const AsBuiltCommand& options, const machines::AnyMachine& machine,
                            built::BuiltHead& head, std::vector<std::string>& notes) {
  built::GroundFolder found = built::read_ground_folder(
      options.record, std::visit([](const auto& any) { return any.hash; }, machine),
      options.ask.any_machine);
  notes.insert(notes.end(), found.notes.begin(), found.notes.end());
  head.of_record = true;
  head.from_s = found.from_s;
  head.until_s = found.until_s;
  return std::move(found.grid);
}

void refuse_beside_record(const AsBuiltCommand& options, const CLI::App& command) {
  for (const char* name : {"--grid", "--ground", "--width"}) {
    if (!options.record.empty() && command.count(name) > 0) {
      throw std::runtime_error(
          fmt::format("{}: of logs; a record has cells of {} m, made as the controller knew them",
                      name, ground::kCell_m));
    }
  }
}

void as_built(AsBuiltCommand options) {
  std::vector<std::string> inputs = options.logs;
  if (!options.design.file.empty()) {
    inputs.push_back(machines::find_design(options.design.file).string());
  }
  inputs.push_back(machines::find_profile(options.ask.profile).string());
  assert_apart(inputs, options.outputs());
  options.ask.every = options.ground == "every";
  const machines::AnyMachine machine = machine_of(options);
  const std::optional<design::Surface> design = design_of(options.design);
  for (const std::string& file : options.outputs()) {
    if (!file.empty()) {
      assert_writable(file);
    }
  }
  built::BuiltHead head;
  head.machine = machine_words(machine);
  head.version = GRABEN_VERSION;
  head.tolerance_m = options.tolerance_m;
  head.height =
      options.height == "newest" ? built::BuiltHeight::kNewest : built::BuiltHeight::kLowest;
  const fs::path source = options.record.empty() ? options.logs.front() : options.record;
  head.project = options.project.empty() ? source.filename().string() : options.project;
  std::vector<std::string> notes;
  built::BuiltGround ground =
      built::built_ground(options.record.empty() ? read_logs(options, machine, head, notes)
                                                 : read_record(options, machine, head, notes),
                          head.height);
  if (ground.face.empty()) {
    throw std::runtime_error(
        fmt::format("{} cells of {} m were made, and no three side by side make a surface{}",
                    ground.point.size(), ground.grid_m,
                    options.record.empty() ? "; a smaller --grid has more" : ""));
  }
  if (head.until_s < kClock_s) {
    notes.emplace_back(fmt::format("the {} stamps are no clock's: its dates count from 1970",
                                   head.of_record ? "record's" : "log's"));
  }
  std::optional<built::DesignFigures> figures;
  if (design) {
    try {
      built::lay_over(*design, ground);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}: {}", options.design.file.string(), error.what()));
    }
    figures = built::design_figures(ground, head.tolerance_m);
  }
  // All of it is made before anything is written.
  const std::string landxml = built::landxml_text(ground, head);
  const std::string points = built::points_text(ground, head);
  const std::string ascii = options.ascii.empty() ? "" : built::ascii_text(ground);
  const std::string html =
      options.html.empty() ? "" : reports::built_page(ground, head, figures, notes);
  const auto write = [](const std::string& file, const std::string& text) {
    if (!file.empty()) {
      write_whole(file, text);
    }
  };
  write(options.out, landxml);
  write(options.points, points);
  write(options.ascii, ascii);
  write(options.ascii_head(), built::ascii_head_text(head));
  write(options.html, html);
  fmt::print("{}", built::table_text(ground, head, figures));
  for (const std::string& note : notes) {
    fmt::print("note: {}\n", note);
  }
  fmt::print("LandXML  {}\n", options.out);
  if (!options.html.empty()) {
    fmt::print("page     {}\n", options.html);
  }
}

}  // namespace

void add_as_built(CLI::App& app, int& status) {
  auto options = std::make_shared<AsBuiltCommand>();
  CLI::App* command = add_command(app, "as-built");
  auto* source = command->add_option_group("source", "What the ground is read from");
  source
      ->add_option("--log", options->logs,
                   "candump log, plain or gzip; several in the order of their times")
      ->expected(1, 100);
  source->add_option("--record", options->record,
                     "The controller's own record instead: the folder that graben-ecu had as "
                     "--store; it may run meanwhile");
  source->require_option(1);
  command
      ->add_option("--profile", options->ask.profile,
                   "Profile of their machine: a file or a shipped name")
      ->required();
  command->add_option("--bus", options->ask.bus,
                      "Bus profile that its machine was put on: a file or a shipped name");
  command->add_option("--out", options->out, "LandXML 1.2 to write: a surface of triangles")
      ->required();
  command->add_option("--points", options->points,
                      "The same as points (CSV): x, y, z, time, how often, lowest, newest");
  command->add_option("--ascii", options->ascii,
                      "The same as ESRI ASCII grid; date and machine stand in FILE.aux.xml");
  command->add_option("--html", options->html, "Map in colours and figures as one HTML page");
  command->add_option(
      "--design", options->design.file,
      "What the ground was to become: LandXML, DXF, or points x y z (.xyz, .csv, .pts, "
      "or as --columns say), in the machine's own frame");
  command->add_option(
      "--surface", options->design.surface,
      "Of a LandXML file with several: its name, '#2', or state=proposed; of a DXF its layer");
  command->add_option("--columns", options->design.columns,
                      "Of points, a letter each: P, N or Y, E or X, Z, D, as PNEZD");
  command
      ->add_option("--units", options->design.units,
                   "Of points: m, ft, us-ft; m unless told. Of a DXF instead of its own")
      ->check(one_of({"m", "ft", "us-ft"}));
  command
      ->add_option("--tolerance", options->tolerance_m,
                   "That ground may be off the design, m, 0.001 .. 1")
      ->check(number_between(0.001, 1.0))
      ->capture_default_str();
  command->add_option("--grid", options->grid_m, "Side of a cell, m, 0.02 .. 2")
      ->check(number_between(built::kLeastGrid_m, built::kMostGrid_m))
      ->capture_default_str();
  command
      ->add_option("--ground", options->ground,
                   "Which places of the edge count: load, where it was at work, or every")
      ->check(one_of({"load", "every"}))
      ->capture_default_str();
  command
      ->add_option("--height", options->height, "Of a cell: of its lowest pass, or of its newest")
      ->check(one_of({"lowest", "newest"}))
      ->capture_default_str();
  command
      ->add_option("--width", options->ask.width_m,
                   "Of the edge, m, 0.1 .. 8, where the profile does not say it")
      ->check(number_between(0.1, 8.0));
  command->add_option("--project", options->project,
                      "Name in the files; that of the first log unless told");
  command->add_flag("--any-machine", options->ask.any_machine,
                    "Take a log whose machine says another profile, or none");
  add_examples(*command, {"as-built --log day.log --profile excavator_12t --out asbuilt.xml",
                          "as-built --log day.log --profile my.toml --design site.xml --out a.xml",
                          "as-built --record /var/lib/graben-ecu --profile my.toml --out a.xml"});
  command->callback([options, command, &status] {
    status = guarded("as-built", [&] {
      refuse_beside_record(*options, *command);
      as_built(*options);
    });
  });
}

}  // namespace graben::cli
