// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/reports/page_setup.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/machines/written_task.hpp"

/// Heights by their places in the list, as the page has them; not a number: none.
std::vector<double> heights_of(const nlohmann::json& surface) {
  std::vector<double> heights;
  int before = 0;
  for (const nlohmann::json& rise : surface.at("heights")) {
    before += rise.is_null() ? 0 : rise.get<int>();
    heights.push_back(rise.is_null() ? std::nan("")
                                     : surface.at("base_m").get<double>() +
                                           surface.at("unit_m").get<double>() * before);
  }
  return heights;
}

/// A ditch's heights are the controller's own at each of their places, and none where it has none.
TEST(the_page_has_the_heights_of_the_controllers_design) {
  const test::Written file(
      "[design.ditch]\nfrom = [4.0, -4.0, -1.0]\nto = [6.0, 4.0]\nsides = [0.5, 1.0]\ntop = 1.5\n");
  const ExcavatorProfile& profile = test::profile("excavator_12t");
  const machines::TaskFile task = machines::load_task(file.path(), profile);
  const nlohmann::json told = reports::task_json(task, profile);
  assert_true(told.at("design").is_null());
  const nlohmann::json& surface = told.at("surface");
  const int columns = surface.at("columns").get<int>();
  const int rows = surface.at("rows").get<int>();
  const double step_m = surface.at("step_m").get<double>();
  assert_true(step_m <= 0.0501);
  const std::vector<double> heights = heights_of(surface);
  assert_int_equal(heights.size(), columns * rows);
  const double turn_rad = surface.at("heading_rad").get<double>();
  int known = 0;
  for (int row = 1; row + 2 < rows; row += 3) {
    for (int column = 1; column + 2 < columns; column += 3) {
      const double u = column * step_m - surface.at("machine_m").at(0).get<double>();
      const double v = row * step_m - surface.at("machine_m").at(1).get<double>();
      const double x_m = std::cos(turn_rad) * u + std::sin(turn_rad) * v;
      const double y_m = std::cos(turn_rad) * v - std::sin(turn_rad) * u;
      double height_m = 0.0;
      // A hair inwards: on the border itself a cell may be the next one.
      if (task.surface->surface.height_at(x_m + 1e-7, y_m + 1e-7, height_m)) {
        assert_near(heights[static_cast<std::size_t>(row * columns + column)], height_m, 1e-5);
        ++known;
      }
    }
  }
  assert_true(known > 1000);
}

TEST(a_plane_is_told_as_a_plane) {
  const test::Written file("[design]\nthrough = [5.0, 0.0, -0.5]\nslope = 0.1\n");
  const ExcavatorProfile& profile = test::profile("excavator_12t");
  const nlohmann::json told =
      reports::task_json(machines::load_task(file.path(), profile), profile);
  assert_true(told.at("surface").is_null());
  assert_near(told.at("design").at("through_m").at(2).get<double>(), -0.5, 1e-9);
}
