// SPDX-License-Identifier: Apache-2.0
#include "app/cli/identify_dozer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/cli/console.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/cli/program.hpp"
#include "app/identify/dozer/dozer_text.hpp"
#include "app/reports/identify/dozer_page.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;
using identify::DozerLog;
using identify::DozerScore;

constexpr const char* kScoreNames[] = {"blade", "tilt", "tracks"};

std::vector<DozerLog> dozer_logs(const IdentifyLogCommand& options,
                                 const machines::DozerMachine& machine) {
  std::vector<DozerLog> logs;
  for (const std::string& file : options.logs) {
    logs.push_back(identify::read_dozer_log(file));
    const DozerLog& log = logs.back();
    for (const std::string& note : log.notes) {
      fmt::print("note: {}\n", note);
    }
    for (std::size_t n = 0; n + 1 < logs.size(); ++n) {
      if (logs[n].sha256 == log.sha256) {
        throw std::runtime_error(fmt::format("{}: is the same log as {}", file, options.logs[n]));
      }
    }
    const bool is_from =
        std::any_of(machine.provenance.begin(), machine.provenance.end(), [&](const auto& value) {
          return value.from.find(log.sha256.substr(0, kShortHash)) != std::string::npos;
        });
    if (!options.any_machine && !is_from && log.profile_hash != 0 &&
        log.profile_hash != machine.hash) {
      throw std::runtime_error(fmt::format(
          "{}: is of a machine with another profile (hash {:08x}, this one's is {:08x}); "
          "--any-machine takes it all the same",
          file, log.profile_hash, machine.hash));
    }
    fmt::print("{}: {:.0f} s, {} frames\n", log.name, log.length_s(), log.frames);
  }
  return logs;
}

std::string score_text(double score) {
  return score < 0.0 ? std::string("-") : fmt::format("{:.1f} %", 100.0 * score);
}

void print_scores(const std::vector<std::pair<const char*, DozerScore>>& columns) {
  fmt::print(
      "error of the speed that the profile predicts by the duties, RMS over the speed's own\n");
  fmt::print("{:<8}", "");
  for (const auto& column : columns) {
    fmt::print("{:>10}", column.first);
  }
  fmt::print("\n");
  for (std::size_t at = 0; at < std::size(kScoreNames); ++at) {
    fmt::print("{:<8}", kScoreNames[at]);
    for (const auto& column : columns) {
      fmt::print("{:>10}", score_text(column.second[at]));
    }
    fmt::print("\n");
  }
}

void write_dozer_summary(const std::string& file, const std::vector<identify::DozerChange>& changes,
                         const identify::DozerEstimate& found, const DozerScore& before,
                         const DozerScore& after) {
  nlohmann::json root;
  for (const identify::DozerChange& change : changes) {
    root["found"][change.path()] = {
        {"before", change.before}, {"after", change.after}, {"deviation", change.deviation}};
  }
  root["not_found"] = found.missing;
  root["notes"] = identify::dozer_sentences(found);
  for (std::size_t at = 0; at < std::size(kScoreNames); ++at) {
    if (before[at] >= 0.0) {
      root["speed_error_ratio"][kScoreNames[at]] = {{"before", before[at]}, {"after", after[at]}};
    }
  }
  write_whole(file, root.dump(1) + "\n");
}

/// What was found has to say more of what was driven than what was there before.
void assert_says_more(const DozerScore& before, const DozerScore& after) {
  constexpr double kNoise = 0.005;
  for (std::size_t at = 0; at < before.size(); ++at) {
    if (after[at] > before[at] + kNoise) {
      throw std::runtime_error(fmt::format(
          "nothing was written: the new profile predicts the {} worse than the old one ({} and {} "
          "of the speed): are the logs of one machine?",
          kScoreNames[at], score_text(after[at]), score_text(before[at])));
    }
  }
}

void check_dozer(const IdentifyLogCommand& options, const machines::DozerMachine& machine) {
  const std::vector<DozerLog> logs = dozer_logs(options, machine);
  std::vector<std::pair<const char*, DozerScore>> columns;
  if (!options.before.empty()) {
    const machines::DozerMachine old = machines::load_dozer(machines::find_profile(options.before));
    columns.emplace_back("before", identify::score_dozer(old.profile, logs));
  }
  columns.emplace_back("now", identify::score_dozer(machine.profile, logs));
  print_scores(columns);
  fmt::print("{}\n", machines::commissioned_text(machine.driven, machine.profile.tilt.present));
  const DozerScore& now = columns.back().second;
  const double most = *std::max_element(now.begin(), now.end());
  if (options.limit_percent > 0.0 && 100.0 * most > options.limit_percent) {
    throw std::runtime_error(fmt::format("a speed is {:.1f} % off; --limit allows {} %",
                                         100.0 * most, options.limit_percent));
  }
}

void assert_dozer_outputs(const IdentifyLogCommand& options, const fs::path& profile) {
  if (options.strokes_measured) {
    throw std::runtime_error("--strokes-measured: a dozer's strokes are not judged by its oil");
  }
  std::vector<std::string> inputs = options.logs;
  inputs.push_back(profile.string());
  assert_apart(inputs, {options.out, options.summary, options.report});
  if (!options.out.empty() && fs::exists(options.out) && !options.force) {
    throw std::runtime_error(
        fmt::format("{}: is there already; --force overwrites it", options.out));
  }
  for (const std::string& file : {options.out, options.summary, options.report}) {
    if (!file.empty()) {
      assert_writable(file);
    }
  }
}

}  // namespace

void identify_dozer_logs(const IdentifyLogCommand& options) {
  const fs::path file = machines::find_profile(options.profile);
  const machines::DozerMachine machine = machines::load_dozer(file);
  assert_dozer_outputs(options, file);
  if (options.check) {
    return check_dozer(options, machine);
  }
  assert_same_base(file, options.out);
  const std::vector<DozerLog> logs = dozer_logs(options, machine);
  const identify::DozerEstimate found = identify::identify_dozer(machine.profile, logs);
  const DozerProfile profile = identify::identified_dozer(machine.profile, found);
  const DozerScore before = identify::score_dozer(machine.profile, logs);
  const DozerScore after = identify::score_dozer(profile, logs);
  print_scores({{"old", before}, {"new", after}});
  const std::vector<identify::DozerChange> changes = identify::dozer_changes(machine, found);
  for (const identify::DozerChange& change : changes) {
    if (change.after.size() < 32) {
      fmt::print("{:<42} {:>12} -> {:<24} {}\n", change.path(),
                 change.before.empty() ? "-" : change.before, change.after,
                 change.deviation.empty() ? "" : "+- " + change.deviation);
    }
  }
  for (const std::string& line : found.missing) {
    fmt::print("{}\n", line);
  }
  for (const std::string& line : identify::dozer_sentences(found)) {
    fmt::print("{}\n", line);
  }
  assert_says_more(before, after);
  std::vector<NamedLog> named;
  for (const DozerLog& log : logs) {
    named.push_back({log.name, log.sha256});
  }
  const std::string text =
      identify::identified_dozer_text(text_of(file), changes, source_text(named));
  identify::assert_dozer_reads_back(text, options.out, profile);
  if (!options.summary.empty()) {
    write_dozer_summary(options.summary, changes, found, before, after);
  }
  if (!options.report.empty()) {
    write_whole(options.report, reports::dozer_page({machine, profile, found, changes, before,
                                                     after, source_text(named)}));
  }
  write_whole(options.out, text);
  const machines::DozerMachine written = machines::load_dozer(options.out);
  fmt::print("profile  {}\n{}\n", options.out,
             machines::commissioned_text(written.driven, written.profile.tilt.present));
  if (!options.report.empty()) {
    fmt::print("report   {}\n", options.report);
  }
  fmt::print("next     graben identify --check --log {} --profile {} --before {}\n",
             shell_word(options.logs.back()), shell_word(options.out), shell_word(options.profile));
}

}  // namespace graben::cli
