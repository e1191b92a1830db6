// SPDX-License-Identifier: Apache-2.0
#include "app/cli/faults_on_bus.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/cli/console.hpp"
#include "app/runs/code_text.hpp"
#include "app/workshop/workshop_bus.hpp"
#include "hal/j1939/ids.hpp"
#include "hal/link/dm1.hpp"

namespace graben::cli {
namespace {

using nlohmann::ordered_json;
using workshop::Answer;
using workshop::TroubleCode;
using workshop::TroubleCodes;

struct Group {
  std::uint32_t pgn;
  const char* name;
};

constexpr Group kDm1{j1939::kActiveCodesPgn, "DM1"};
constexpr Group kDm2{j1939::kPreviousCodesPgn, "DM2"};
constexpr Group kDm3{j1939::kClearPreviousPgn, "DM3"};
constexpr Group kDm11{j1939::kClearActivePgn, "DM11"};

/// The fault's number; 0: the code is none of ours.
int fault_of(const TroubleCode& code) {
  const bool is_ours = code.spn > kDm1FirstSpn && code.spn < kDm1FirstSpn + kFaultCount;
  return is_ours ? static_cast<int>(code.spn - kDm1FirstSpn) : 0;
}

[[noreturn]] void refuse(const FaultsOnBus& options, const Group& group, const char* what) {
  throw std::runtime_error(
      fmt::format("{}: address {}: {}: {}", options.interface, options.address, group.name, what));
}

workshop::Answered ask(const FaultsOnBus& options, const Group& group) {
  const workshop::Answered answered =
      workshop::ask(options.interface, group.pgn, static_cast<std::uint8_t>(options.address));
  switch (answered.answer) {
    case Answer::kMessage:
    case Answer::kDone:
      return answered;
    case Answer::kRefused:
      refuse(options, group,
             "refused: it does not know this, or may not do it now; records are "
             "not cleared while the machine is armed or active");
    case Answer::kNotNow:
      refuse(options, group, "not now; try again when the machine is not armed");
    case Answer::kSilent:
      refuse(options, group, "no answer to three requests; is this the ECU's address and bus?");
    case Answer::kNone:
      break;
  }
  throw std::runtime_error("stopped");
}

void print_codes(const char* title, const TroubleCodes& codes) {
  fmt::print("{}{}{}\n", title, codes.red_stop ? ", red stop lamp" : "",
             codes.amber_warning ? ", amber warning lamp" : "");
  if (codes.code.empty()) {
    fmt::print("  none\n");
    return;
  }
  constexpr const char* kRow = "  {:>5}  {:>7}  {:>3}  {:>5}  {}\n";
  fmt::print(kRow, "fault", "SPN", "FMI", "times", "what");
  for (const TroubleCode& code : codes.code) {
    const int fault = fault_of(code);
    fmt::print(kRow, fault == 0 ? "-" : std::to_string(fault), code.spn, code.failure_mode,
               code.occurrences > kDm1MaxOccurrences ? "-" : std::to_string(code.occurrences),
               fault == 0 ? "none of Graben's" : runs::fault_words(static_cast<Fault>(fault)));
  }
}

ordered_json codes_json(const TroubleCodes& codes) {
  ordered_json json;
  json["red_stop_lamp"] = codes.red_stop;
  json["amber_warning_lamp"] = codes.amber_warning;
  json["codes"] = ordered_json::array();
  for (const TroubleCode& code : codes.code) {
    const int fault = fault_of(code);
    ordered_json one;
    one["fault"] = fault == 0 ? ordered_json(nullptr) : ordered_json(fault);
    one["spn"] = code.spn;
    one["fmi"] = code.failure_mode;
    one["occurrences"] = code.occurrences > kDm1MaxOccurrences ? ordered_json(nullptr)
                                                               : ordered_json(code.occurrences);
    json["codes"].push_back(one);
  }
  return json;
}

}  // namespace

void faults_on_bus(const FaultsOnBus& options) {
  if (!options.clear.empty()) {
    static_cast<void>(ask(options, options.clear == "active" ? kDm11 : kDm3));
    fmt::print(
        "{}: address {}: records of faults that are {} are cleared; what is active stays so, "
        "and no stop ends\n",
        options.interface, options.address, options.clear == "active" ? "active" : "not active");
    return;
  }
  const TroubleCodes active = workshop::codes_in(ask(options, kDm1).message);
  const TroubleCodes previous = workshop::codes_in(ask(options, kDm2).message);
  if (options.json) {
    ordered_json json;
    json["interface"] = options.interface;
    json["address"] = options.address;
    json["active"] = codes_json(active);
    json["previous"] = codes_json(previous);
    fmt::print("{}\n", json.dump(1));
    return;
  }
  fmt::print("{}, address {}\n", options.interface, options.address);
  print_codes("active (DM1)", active);
  print_codes("stored, not active (DM2)", previous);
}

}  // namespace graben::cli
