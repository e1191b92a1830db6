// SPDX-License-Identifier: Apache-2.0
#include "app/machines/mark_section.hpp"

#include <vector>

namespace graben::machines {
namespace {

constexpr double kSecondsPerHour = 3600.0;

}  // namespace

MarkProfile read_mark(TomlReader& reader, bool swings, const char* place_help) {
  MarkProfile mark;
  if (!reader.has("mark")) {
    return mark;
  }
  const std::vector<double> place_m =
      reader.numbers("mark.place", {-1000.0, 1000.0, "m"}, swings ? 3 : 2, place_help);
  mark.place_m = {place_m.front(), swings ? place_m[1] : 0.0, place_m.back()};
  mark.tolerance_m =
      reader.number("mark.tolerance", {0.005, 0.25, "m"},
                    "so far off its mark the tool may be shown; beyond it nothing arms");
  mark.most_age_s =
      kSecondsPerHour * reader.number_or(0.0, "mark.most_age", {0.0, 1000.0, "h"},
                                         "an older check is said; 0: however old it is");
  mark.required = reader.boolean_or(false, "mark.required",
                                    "nothing arms while the check is older than mark.most_age");
  if (mark.required && mark.most_age_s == 0.0) {
    reader.fail("mark.required", "true; allowed: only with mark.most_age above 0 h");
  }
  return mark;
}

}  // namespace graben::machines
