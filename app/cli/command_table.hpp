// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Commands of `graben`, and the program that has each of them. `graben` itself is small: it looks
/// a command up here and becomes its program, so that nobody builds what he does not call.

#include <string>

namespace CLI {
class App;
}

namespace graben::cli {

struct CommandRow {
  const char* name;
  const char* program;  ///< Its file is called graben-PROGRAM.
  const char* help;
};

/// In the order of the help.
inline constexpr CommandRow kCommands[] = {
    {"check", "machine",
     "What a profile means: reach, joint ranges, speeds, forces, modes, and warnings of what is "
     "allowed but implausible; as text and as a drawing. A wrong profile ends with status 1"},
    {"dig", "dig", "Dig round Kim's path on the simulated machine, over a CAN bus in memory"},
    {"grade", "grade",
     "Cut the profile's grade with the simulated dozer, over a CAN bus in memory"},
    {"campaign", "campaign", "Many runs and their distribution"},
    {"solve", "machine",
     "Solve cases of the valve's optimisation: JSON lines from standard input, one "
     "result line each"},
    {"pose", "machine", "Tip pose and joint angles at given strokes, as JSON"},
    {"strokes", "machine",
     "Strokes for a tip pose, as JSON; a pose that can't be had gives strokes null and a status"},
    {"autodig", "dig",
     "Run a task, an area to be dug or straight lines step by step, with swing, on the simulated "
     "machine, over a CAN bus in memory, in the air or in soil. The task is planned first; one "
     "that can't be had ends with status 1 and says where"},
    {"plan", "plan",
     "Plan a straight line of the bucket's teeth, with swing, or a task; nothing moves. Without "
     "--task, --from, --to and a pace: the line of NAME.sim.toml. What can't be had ends with "
     "status 1 and says where, as autodig does"},
    {"plant", "bus", "The simulated machine in real time on a CAN interface, valve side and all"},
    {"operate", "bus",
     "The operator's station of an excavator on a bus: a gamepad moves the machine while its left "
     "shoulder button is held. Shows what the controller says. Until SIGINT or SIGTERM"},
    {"commission", "bus",
     "Leads a machine through what identify needs, one drive and direction at a time, guarded by "
     "its ECU: edges, steps at five speeds, pulses, touches of the stroke's ends, two drives of "
     "one pump. With --can a real one, while the operator holds the deadman; without it a "
     "simulated one in memory. Writes a log; changes nothing in the profile"},
    {"identify", "identify",
     "How a machine answers its commands, found from recorded motion: dead time, lags, curves of "
     "each direction, pumps, zeros of sensors; judged by motion that was left out. From logs "
     "into a better profile, or of foreign recordings into figures"},
    {"verdict", "identify",
     "What a log of any machine is good for: what is in it, how each drive answers its command and "
     "how well that is known, what a profile of the machine still lacks, what to drive next, and "
     "the tip error to be expected. Columns and units are guessed and said. A log with nothing in "
     "it ends with status 1"},
    {"drift", "identify",
     "What wears: dead bands, leakage, friction, pumps' flow and zeros of the sensors, from logs "
     "of "
     "many days; a work order in plain words where one has changed beyond its noise"},
    {"measure-up", "identify",
     "How the IMUs sit on their links, from a log in which the bucket's edge stood on one fixed "
     "point in several postures, each for 10 s; into the profile's [imu]. --record makes such a "
     "log with a simulated machine"},
    {"as-built", "built",
     "The ground as a machine's cutting edge has left it, from a day's logs: LandXML, points, "
     "ASCII "
     "grid, with date and machine; against a design cut and fill. What no edge has touched it does "
     "not know"},
    {"surface", "built",
     "A design as an excavator's task takes it: of a LandXML surface or of points heights on an "
     "even grid, cut out about the machine, as an ESRI ASCII grid"},
    {"site", "built",
     "Where a machine stands on its site, from points that its teeth have touched: a benchmark and "
     "one or more for the heading; prints the section [site] of a task. Points too near to each "
     "other, or that contradict each other, end with status 1"},
    {"scope", "scope",
     "The machine in a browser: posed, with plots and faults, from what is on the bus. Serves a "
     "page until SIGINT or SIGTERM; a bus is only heard. Needs no privilege"},
    {"compare", "scope",
     "Two runs over each other, from their logs (candump -L): figures beside each other, and one "
     "page with the first run's frames, the second's curves dashed, and the differences. Both are "
     "counted from where their controllers became active"},
    {"export", "scope",
     "A log (candump -L) for other tools: MCAP, which Foxglove "
     "and PlotJuggler open. A channel for "
     "each message of the bus, in SI units; the controller's "
     "state in words; its faults as events"},
    {"film", "scope",
     "The scope's picture of a log (candump -L) as a film. Needs Chromium and ffmpeg; takes some "
     "tenths of a second for each picture"},
    {"faults", "machine",
     "Faults that a controller has stored: how often, when first and last, power cycles since, and "
     "what the machine did as each came, from the folder of graben-ecu's --store, or a copy of it; "
     "or, "
     "over CAN, which are active and which are stored, and their records are cleared"},
    {"new-machine", "machine",
     "Asks for a machine's measures in mm, degrees, bar, rpm and L/min, a line each on standard "
     "input, and writes its profile with a comment on every key. What is not told stays as it is "
     "in another profile and is marked so"},
};

/// Row of a command; nullptr: there is none of that name.
[[nodiscard]] const CommandRow* command_row(const std::string& name);

/// Adds a command with the help of its row.
CLI::App* add_command(CLI::App& app, const std::string& name);

}  // namespace graben::cli
