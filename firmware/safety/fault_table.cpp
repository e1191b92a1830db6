// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/fault_table.hpp"

#include <cstddef>

#include "firmware/safety/generated/fault_rows.hpp"

namespace graben {
namespace {

constexpr bool rows_are_in_order() {
  for (std::size_t i = 0; i < kFaultRows.size(); ++i) {
    if (static_cast<std::size_t>(kFaultRows[i].fault) != i) {
      return false;
    }
  }
  return true;
}
static_assert(rows_are_in_order());

/// Faults whose rows are so.
template <class IsSo>
constexpr FaultSet faults_that(const IsSo& is_so) {
  FaultSet faults;
  for (const FaultRow& row : kFaultRows) {
    if (is_so(row)) {
      faults.add(row.fault);
    }
  }
  return faults;
}
constexpr FaultSet kCutPilot = faults_that([](const FaultRow& row) { return row.cuts_pilot; });
constexpr FaultSet kRedStop = faults_that([](const FaultRow& row) { return row.red_stop; });
constexpr FaultSet kAmberWarning = faults_that([](const FaultRow& row) { return !row.red_stop; });

}  // namespace

const FaultRow& fault_row(Fault fault) {
  const auto code = static_cast<std::size_t>(fault);
  return kFaultRows[code < kFaultRows.size() ? code : 0];
}

bool cuts_pilot(Fault fault) { return fault_row(fault).cuts_pilot; }

bool cuts_pilot(const FaultSet& faults) { return faults.has_any(kCutPilot); }

bool has_red_stop(const FaultSet& faults) { return faults.has_any(kRedStop); }
bool has_amber_warning(const FaultSet& faults) { return faults.has_any(kAmberWarning); }

}  // namespace graben
