// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

Rows<Excavator> own_rows(const Excavator&) {
  Rows<Excavator> rows = excavator_rows();
  for (const Row<Excavator>& row : pressure_rows()) {
    rows.push_back(row);
  }
  for (const Row<Excavator>& row : imu_rows()) {
    rows.push_back(row);
  }
  for (const Row<Excavator>& row : sold_rows()) {
    rows.push_back(row);
  }
  for (const Row<Excavator>& row : stroke_rows()) {
    rows.push_back(row);
  }
  for (const Row<Excavator>& row : tilt_rows(Excavator())) {
    rows.push_back(row);
  }
  return rows;
}
Rows<Dozer> own_rows(const Dozer&) {
  Rows<Dozer> rows = dozer_rows();
  for (const Row<Dozer>& row : pose_rows()) {
    rows.push_back(row);
  }
  for (const Row<Dozer>& row : tilt_rows(Dozer())) {
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

template <class Kind>
Rows<Kind> all_rows() {
  Rows<Kind> rows;
  for (const Rows<Kind>& some :
       {silence_rows<Kind>(), message_rows<Kind>(), format_rows<Kind>(), bus_rows<Kind>(),
        machine_rows<Kind>(), process_rows<Kind>(), conduct_rows<Kind>(), guard_rows<Kind>(),
        link_rows<Kind>(), external_rows<Kind>(), motion_rows<Kind>(), direction_rows(Kind{}),
        tube_rows(Kind{}), hand_rows(Kind{}), mark_rows(Kind{}), site_rows(Kind{}),
        engine_rows(Kind{}), own_rows(Kind{})}) {
    rows.insert(rows.end(), some.begin(), some.end());
  }
  std::sort(rows.begin(), rows.end(),
            [](const auto& a, const auto& b) { return a.number < b.number; });
  return rows;
}

template Rows<Excavator> all_rows();
template Rows<Dozer> all_rows();

}  // namespace graben::faults
