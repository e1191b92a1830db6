// SPDX-License-Identifier: Apache-2.0
#pragma once
/// `graben commission --can`, and what it shares with the simulated one.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "app/commission/commission_plan.hpp"
#include "app/commission/dozer_plan.hpp"
#include "app/runs/led_commission.hpp"

namespace graben::cli {

/// What is to be left out.
struct SequenceChoice {
  std::vector<std::string> only;      ///< Drives; all if empty.
  std::vector<std::string> no_touch;  ///< "boom-extended" ...
  bool no_steps = false;
  bool no_bursts = false;
  bool no_pairs = false;
};

struct BusCommission {
  std::string interface;
  std::string profile = "excavator_22t";
  std::string log = "out/commission.log";
  std::string windows;
  SequenceChoice choice;
  std::string gamepad;
  bool keyboard = false;
  double silent_after_s = 20.0;
  bool resume = false;
};

void choose(const SequenceChoice& choice, commission::SequenceOptions& options);
/// Throws std::runtime_error where the choice names what no dozer, or not this one, has.
void choose(const SequenceChoice& choice, commission::DozerOptions& options);
/// The part of it that goes before what windows say.
void leave_touches(const SequenceChoice& choice, commission::SequenceOptions& options);

/// What the choice, or that nobody has confirmed it, keeps from being tried, and that there is no
/// swing to be tried, as lines; empty: nothing.
[[nodiscard]] std::string left_out_text(const SequenceChoice& choice,
                                        const commission::SequenceOptions& options);
[[nodiscard]] std::string left_out_text(const SequenceChoice& choice,
                                        const commission::DozerOptions& options);

/// The command that makes a profile of the log, as a line.
[[nodiscard]] std::string next_text(const BusCommission& options);

/// A simulated one's steps that were done, as a table; `speed` says a step's by its number.
void print_steps(const std::vector<std::string>& texts,
                 const std::vector<commission::StepResult>& steps,
                 const std::function<std::string(std::size_t)>& speed);
/// Why a simulated one was stopped; `wrong` says a wrong way. Empty where it was not.
[[nodiscard]] std::string stop_text(
    const runs::CommissionResult& result,
    const std::function<std::string(const commission::WrongWay&)>& wrong);

/// Of the profile's kind: listens, has the windows confirmed, a dozer's by a file, leads through
/// the sequence. Throws std::runtime_error, with the reason and what to do next, unless all is done
/// in the end.
void commission_on_bus(const BusCommission& options);

}  // namespace graben::cli
