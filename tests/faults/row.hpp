// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The rows of the table, each with the function that tries it once.

#include <algorithm>
#include <string>
#include <vector>

#include "tests/faults/dozer_kind.hpp"
#include "tests/faults/excavator_kind.hpp"
#include "tests/faults/trial.hpp"

namespace graben::faults {

struct RowText {
  int number = 0;
  const char* fault = "";
  const char* expected = "";
  bool is_tried = true;  ///< Else `expected` says why not.
};

template <class Kind>
struct Row : RowText {
  Row(int of_number, const char* of_fault, const char* what, void (*how)(Trial<Kind>& trial))
      : RowText{of_number, of_fault, what, how != nullptr}, run(how) {}

  void (*run)(Trial<Kind>& trial);  ///< Null: not tried here.
};

/// A cylinder on its way: to its end, and the pressure in its chambers.
struct AtEnd {
  double left_m = 0.0;
  double peak_pa = 0.0;
};

/// Set up where a cylinder is about to come to its end: the machine goes on, slower, and no chamber
/// sees much more than its relief. `look` says what is there after each cycle.
template <class Kind, class Look>
void expect_slowed_at_end(Trial<Kind>& trial, TimeUs during_us, double relief_pa,
                          const Look& look) {
  Rig<Kind>& rig = *trial.rig;
  rig.run(200 * kMillisecondUs);
  rig.ask(true, Task::kNone);
  rig.run(100 * kMillisecondUs);
  rig.ask(true, Kind::kTask);
  rig.run(50 * kMillisecondUs);
  AtEnd seen{1e3, 0.0};
  bool active = true;
  bool slowed = false;
  rig.run_until(during_us, [&] {
    const AtEnd now = look(rig.plant.plant());
    seen = {std::min(seen.left_m, now.left_m), std::max(seen.peak_pa, now.peak_pa)};
    active = active && rig.mode() == EcuMode::kActive;
    const auto& statuses = rig.record.statuses;
    slowed = slowed || (!statuses.empty() && statuses.back().limit.kind == LimitKind::kStrokeEnd);
    return false;
  });
  trial.check(active, "did not go on");
  trial.check(slowed, "no limit StrokeEnd on the bus; closest " +
                          std::to_string(1e3 * seen.left_m) + " mm");
  constexpr double kPeakShare = 1.1;
  trial.check(seen.peak_pa <= kPeakShare * relief_pa,
              "a chamber saw " + std::to_string(1e-6 * seen.peak_pa) + " MPa");
  trial.saw("D");
}

template <class Kind>
using Rows = std::vector<Row<Kind>>;

template <class Kind>
[[nodiscard]] Rows<Kind> silence_rows();  ///< 1 - 4, 6
template <class Kind>
[[nodiscard]] Rows<Kind> message_rows();  ///< 7 - 16
template <class Kind>
[[nodiscard]] Rows<Kind> format_rows();  ///< 17 - 23
template <class Kind>
[[nodiscard]] Rows<Kind> bus_rows();  ///< 24 - 32
template <class Kind>
[[nodiscard]] Rows<Kind> machine_rows();  ///< 33 - 36, 80
template <class Kind>
[[nodiscard]] Rows<Kind> process_rows();  ///< 41 - 48, 50
template <class Kind>
[[nodiscard]] Rows<Kind> motion_rows();  ///< 58, 59
template <class Kind>
[[nodiscard]] Rows<Kind> conduct_rows();  ///< 52, 61, 62, 64, 66
template <class Kind>
[[nodiscard]] Rows<Kind> guard_rows();  ///< 67 - 73
template <class Kind>
[[nodiscard]] Rows<Kind> link_rows();  ///< 53, 56
template <class Kind>
[[nodiscard]] Rows<Kind> external_rows();  ///< 91 - 93
/// Those that each kind has in its own way, or not at all: 5, 37 - 40, 49.
[[nodiscard]] Rows<Excavator> excavator_rows();
[[nodiscard]] Rows<Excavator> pressure_rows();                   ///< 65
[[nodiscard]] Rows<Excavator> imu_rows();                        ///< 76, 90
[[nodiscard]] Rows<Excavator> sold_rows();                       ///< 77
[[nodiscard]] Rows<Excavator> direction_rows(const Excavator&);  ///< 51
[[nodiscard]] Rows<Dozer> direction_rows(const Dozer&);
[[nodiscard]] Rows<Excavator> tube_rows(const Excavator&);  ///< 57
[[nodiscard]] Rows<Dozer> tube_rows(const Dozer&);
[[nodiscard]] Rows<Excavator> hand_rows(const Excavator&);  ///< 74, 75, 89
[[nodiscard]] Rows<Dozer> hand_rows(const Dozer&);          ///< And 76, 77, 90: it has none.
[[nodiscard]] Rows<Dozer> dozer_rows();
[[nodiscard]] Rows<Dozer> pose_rows();              ///< 54, 60
[[nodiscard]] Rows<Dozer> tilt_rows(const Dozer&);  ///< 78, 79
[[nodiscard]] Rows<Excavator> tilt_rows(const Excavator&);
[[nodiscard]] Rows<Excavator> mark_rows(const Excavator&);  ///< 86
[[nodiscard]] Rows<Dozer> mark_rows(const Dozer&);
[[nodiscard]] Rows<Excavator> site_rows(const Excavator&);  ///< 94
[[nodiscard]] Rows<Dozer> site_rows(const Dozer&);
[[nodiscard]] Rows<Excavator> engine_rows(const Excavator&);  ///< 85, 87, 88
[[nodiscard]] Rows<Dozer> engine_rows(const Dozer&);
[[nodiscard]] Rows<Excavator> stroke_rows();  ///< 55, 82 - 84: a dozer has one stroke.
/// All of a kind, by their numbers.
template <class Kind>
[[nodiscard]] Rows<Kind> all_rows();

}  // namespace graben::faults
