// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Figures of the papers that have a like in our runs, drawn as the papers draw them (axes,
/// colours, what is marked), with the numbers that stand in the papers beside ours. The papers'
/// curves themselves are pictures: they are not redrawn.

#include <string>
#include <vector>

#include "app/reports/figure/svg_figure.hpp"
#include "app/runs/dig_run.hpp"
#include "app/runs/grade_run.hpp"
#include "app/runs/plan_run.hpp"

namespace graben::reports {

/// Kim et al.: "kim9" to "kim15".
[[nodiscard]] const std::vector<std::string>& kim_figure_names();

/// Before the run: throws std::runtime_error where a figure of these names is of another kind of
/// run than this machine's, and says which option is lacking. See kim_figure().
void assert_kim_figures(const std::vector<std::string>& names,
                        const machines::SimulatedExcavator& machine, bool meets_obstacle);

/// Kim's runs are in soil (9 to 13) or meet an obstacle (14, 15). Throws std::runtime_error where
/// the run is not of that kind.
[[nodiscard]] PaperFigure kim_figure(const std::string& name,
                                     const machines::SimulatedExcavator& machine,
                                     const runs::DigResult& result,
                                     const runs::DigSummary& summary);

/// Mononen and Mattila: "mononen7" to "mononen9".
[[nodiscard]] const std::vector<std::string>& mononen_figure_names();

/// Before the run, as mononen_figure() after it: throws std::runtime_error where one of them is of
/// the other kind of speed.
void assert_mononen_figures(const std::vector<std::string>& names, bool is_constant_speed);
/// Of these figures, one that the paper has of a constant speed.
[[nodiscard]] bool is_of_constant_speed(const std::string& name);

/// 7 and 8 are of the bounded speed, 9 of a constant one. Throws std::runtime_error where the run
/// is not of that kind.
[[nodiscard]] PaperFigure mononen_figure(const std::string& name, bool is_constant_speed,
                                         const machines::SimulatedDozer& machine,
                                         const runs::GradeResult& result,
                                         const runs::GradeSummary& summary);

/// Zhang et al.: "zhang5" to "zhang10".
[[nodiscard]] const std::vector<std::string>& zhang_figure_names();

/// Of a plan from the paper's J to its K. Throws std::runtime_error where it is another line.
[[nodiscard]] PaperFigure zhang_figure(const std::string& name, const std::string& machine,
                                       const std::vector<runs::PlanSample>& samples);

}  // namespace graben::reports
