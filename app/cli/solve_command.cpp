// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/help.hpp"
#include "app/cli/mcv_json.hpp"
#include "app/cli/options.hpp"

namespace graben::cli {
namespace {

/// Reads cases until the input ends; a bad line is told and skipped.
int solve_lines(std::istream& cases, McvPolicy policy) {
  int status = 0;
  std::string line;
  for (long number = 1; std::getline(cases, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    try {
      const McvCase mcv_case = parse_mcv_case(line);
      const McvSolution solution = solve_mcv(mcv_case.machine, mcv_case.input, policy);
      if (solution.status == SolveStatus::kBadInput) {
        throw std::runtime_error(defect_text(solution.defect));
      }
      fmt::print("{}\n", solution_json(mcv_case, solution).dump());
    } catch (const std::exception& error) {
      // Results so far first, so that both streams read in order on one terminal.
      std::fflush(stdout);
      fmt::print(stderr, "graben solve: line {}: {}\n", number, error.what());
      status = 1;
    }
  }
  // std::cin shares stdio's buffer, so that a read error is known there.
  if (cases.bad() || std::ferror(stdin) != 0) {
    fmt::print(stderr, "graben solve: standard input can't be read\n");
    status = 1;
  }
  return status;
}

std::vector<std::string> policy_names() {
  std::vector<std::string> names;
  for (const auto& [name, policy] : policies()) {
    names.push_back(name);
  }
  return names;
}

}  // namespace

void add_solve(CLI::App& app, int& status) {
  CLI::App* command = add_command(app, "solve");
  auto policy = std::make_shared<std::string>("global");
  command
      ->add_option("--policy", *policy,
                   "How lambda is chosen: algorithm1, as in Kim et al.; connected, the end of the "
                   "feasible interval that contains 0; global, the largest feasible")
      ->check(one_of(policy_names()))
      ->capture_default_str();
  add_examples(*command, {"solve --policy algorithm1 < cases.jsonl"});
  command->callback([policy, &status] { status = solve_lines(std::cin, policies().at(*policy)); });
}

}  // namespace graben::cli
