// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "app/machines/answer_section.hpp"
#include "app/machines/axis_names.hpp"
#include "app/reports/check/machine_check.hpp"
#include "firmware/excavator/excavator_drives.hpp"

namespace graben::reports {
namespace {

std::string milliseconds(double time_s) { return fmt::format("{:.0f}", 1e3 * time_s); }

std::string percents(const machines::DrivenRange& range) {
  return range.said ? fmt::format("{:.0f} .. {:.0f}", 100.0 * range.least, 100.0 * range.most)
                    : std::string("-");
}

}  // namespace

FactTable answer_table(const machines::ExcavatorMachine& machine) {
  FactTable table{
      "Spools, as the controller takes them",
      {"", "opens at, %", "half open at, %", "fully at, %", "points", "dead time, ms", "lag, ms",
       "time constant, ms", "settles, ms", "driven, %"},
      {},
      "duties, in shares of the spool's travel; what the profile does not say of a side "
      "is the whole valve's; " +
          machines::commissioned_text(machine.driven, machine.profile.drive_count)};
  const ExcavatorBank bank = excavator_bank(machine.profile);
  for (int drive = 0; drive < bank.count; ++drive) {
    const auto k = static_cast<unsigned>(drive);
    for (const bool extends : {true, false}) {
      const SpoolAnswer& answer = bank.row[k].answer.side(extends);
      const auto percent = [&](double opening) {
        return fmt::format("{:.1f}", 100.0 * answer.spool_to_duty.at(opening));
      };
      table.rows.push_back(
          {machines::side_name(drive, extends), percent(0.0), percent(0.5), percent(1.0),
           fmt::format("{}", answer.spool_to_duty.size()), milliseconds(answer.dead_time_s),
           milliseconds(answer.lag_s), milliseconds(answer.spool_time_constant_s),
           milliseconds(bank.row[k].watch.settle_s), percents(machine.driven[k].side(extends))});
    }
  }
  return table;
}

FactTable provenance_table(const std::vector<machines::Provenance>& provenance) {
  FactTable table{"Where values are from", {"", "standard deviation", "from"}, {}, ""};
  for (const machines::Provenance& of : provenance) {
    table.rows.push_back(
        {of.key, of.deviation ? fmt::format("{:g}", *of.deviation) : "-", of.from});
  }
  if (provenance.empty()) {
    table.columns.clear();
    table.note = "the profile has no section [provenance]";
  }
  return table;
}

}  // namespace graben::reports
