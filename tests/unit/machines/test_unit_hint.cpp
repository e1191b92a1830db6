// SPDX-License-Identifier: Apache-2.0
// Which other unit a number may be in, and that what follows from one slip is not told as another.

#include <fmt/format.h>
#include <toml++/toml.h>

#include <string>

#include "app/machines/toml_reader.hpp"
#include "app/machines/unit_hint.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using graben::machines::unit_hint;

TEST(a_number_in_the_unit_of_a_data_sheet) {
  const struct {
    double value;
    double least;
    double most;
    const char* unit;
    const char* hint;
  } cases[] = {
      {1900.0, 10.0, 1000.0, "rad/s", "; in rpm? then it is 199 rad/s"},
      {1450.0, 10.0, 1000.0, "rad/s", "; in rpm? then it is 151.8 rad/s"},
      {5700.0, 0.1, 30.0, "m", "; in mm? then it is 5.7 m"},
      {350.0, 1e6, 1e8, "Pa", "; in bar? then it is 3.5e+07 Pa"},
      {214.0, 1e-5, 0.1, "m3/s", "; in L/min? then it is 0.003567 m3/s"},
      {119.0, 1e-6, 0.01, "m3/rev", "; in cm3/rev? then it is 0.000119 m3/rev"},
      {-45.0, -7.0, 7.0, "rad", "; in degrees? then it is -0.7854 rad"},
      {95.0, 0.0, 1.0, "", "; in %? then it is 0.95"},
      {0.8, -0.3, 0.3, "", ""},
      {30.0, -0.3, 0.3, "", "; in %? then it is 0.3"},
      {38.0, 1e6, 1e8, "Pa", "; in bar? then it is 3.8e+06 Pa; or in MPa: 3.8e+07"},
      {99.0, -30.0, 30.0, "m", ""},
      {0.0, 0.1, 30.0, "m", ""},
      {1e9, 0.1, 30.0, "m", ""},
  };
  for (const auto& each : cases) {
    assert_string_equal(unit_hint(each.value, each.least, each.most, each.unit).c_str(), each.hint);
  }
}

TEST(the_first_slip_alone_is_told) {
  const toml::table root = toml::parse("[weight]\nradius = 28.3\nwidth = 2.7\n[other]\nx = 1.0\n");
  graben::machines::TomlReader reader(root);
  static_cast<void>(reader.number("weight.radius", {0.5, 10.0, "m"}, ""));
  reader.fail("weight.width", "2.7 m; allowed: less than twice the radius, 1 m");
  reader.fail("other.x", "is wrong by itself");
  assert_int_equal(reader.errors().size(), 2);
  assert_non_null(
      strstr(reader.errors()[0].c_str(), "weight.radius (line 2): 28.3 is out of range"));
  assert_non_null(strstr(reader.errors()[1].c_str(), "other.x (line 5): is wrong by itself"));
}
