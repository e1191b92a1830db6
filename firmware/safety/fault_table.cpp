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

}  // namespace

const FaultRow& fault_row(Fault fault) {
  const auto code = static_cast<std::size_t>(fault);
  return kFaultRows[code < kFaultRows.size() ? code : 0];
}

bool cuts_pilot(Fault fault) { return fault_row(fault).cuts_pilot; }

bool cuts_pilot(const FaultSet& faults) {
  bool cuts = false;
  for (Fault fault = faults.first(); fault != Fault::kNone; fault = faults.after(fault)) {
    cuts = cuts || cuts_pilot(fault);
  }
  return cuts;
}

}  // namespace graben
