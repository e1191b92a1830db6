// SPDX-License-Identifier: Apache-2.0
#include "app/machines/design_section.hpp"

#include <fmt/format.h>

#include "tests/unit/machines/written_task.hpp"
#include "tests/unit/refusal.hpp"

using test::assert_says;
using test::errors_of;

machines::TaskFile task_of(const std::string& text) {
  const test::Written file(text);
  return machines::load_task(file.path(), test::profile("excavator_12t"));
}

const Fence& last_fence(const machines::TaskFile& task) {
  const FenceSet& fences = task.result.program.fences;
  return fences.fence[static_cast<unsigned>(fences.count - 1)];
}

double under_m(const machines::TaskFile& task, double x_m, double y_m) {
  const Fence& fence = last_fence(task);
  if (fence.is_surface()) {
    const SurfacePlace place = fence.surface->at({x_m, y_m});
    return place.known ? place.height_m : std::nan("");
  }
  return -(fence.offset_m - fence.normal.x() * x_m - fence.normal.y() * y_m) / -fence.normal.z();
}

/// A plane 0.4 m under a touched point, 2 % up along its heading and 5 % up to the left of it: the
/// plane of that normal. A design alone is a task for Assist, with its fences, and has no steps.
TEST(a_plane_as_a_foreman_says_it) {
  const machines::TaskFile task = task_of(
      "[design]\nthrough = [5.0, 1.0, 0.1]\ndepth = 0.4\nslope = 0.02\ncross_slope = 0.05\n"
      "heading = 1.5707963268\n[[fence]]\nkind = \"ceiling\"\nheight = 8.0\n");
  assert_false(task.has_steps());
  assert_int_equal(task.result.program.fences.count, 2);
  assert_int_equal(last_fence(task).guard, FenceGuard::kTeeth);
  assert_near(under_m(task, 5.0, 1.0), -0.3, 1e-9);
  assert_near(under_m(task, 5.0, 2.0), -0.28, 1e-9);
  assert_near(under_m(task, 4.0, 1.0), -0.25, 1e-9);
  test::expect_refusal(
      [&] {
        machines::demand_steps(task, "autodig");
        return 0;
      },
      "no steps");
}

constexpr const char* kDitch =
    "[design.ditch]\nfrom = [6.0, -3.0, 0.0]\nto = [6.0, 5.0]\ndepth = 0.8\nslope = 0.01\n"
    "bottom = 0.5\nsides = [0.5, 1.0]\ntop = 1.0\n";

/// Bottom, left side 1:2 and right side 1:1, as seen from its begin; nothing beyond its ends and
/// tops. The left of a ditch along y is towards the machine.
TEST(a_ditch_as_a_foreman_says_it) {
  const machines::TaskFile task = task_of(kDitch);
  const double bottom_m = -0.8 + 0.03;
  assert_near(under_m(task, 6.0, 0.0), bottom_m, 1e-3);
  assert_near(under_m(task, 6.0, 4.0), bottom_m + 0.04, 1e-3);
  assert_near(under_m(task, 6.15, 0.0), bottom_m, 1e-3);
  assert_near(under_m(task, 5.0, 0.0), bottom_m + 0.375, 1e-3);
  assert_near(under_m(task, 6.75, 0.0), bottom_m + 0.5, 1e-3);
  assert_true(std::isnan(under_m(task, 7.3, 0.0)));
  assert_true(std::isnan(under_m(task, 3.7, 0.0)));
  assert_true(std::isnan(under_m(task, 6.0, -3.1)));
  // Kinks are filled, by a quarter of slope and rounding, and nothing is under the design.
  const double kink_m = under_m(task, 6.25, 0.0) - bottom_m;
  assert_true(kink_m > 0.25 * 1.0 * 0.05 * 0.8 && kink_m < 0.25 * 1.0 * 0.05 * 1.3);
}

/// Crests are raised, hollows filled; nowhere is it under the grid, and straight parts stay.
TEST(rounding_is_never_under_the_design) {
  machines::HeightGrid grid;
  grid.columns = 81;
  grid.rows = 31;
  grid.step_m = 0.025;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      grid.height_m.push_back(0.02 * row + std::abs(((column + 20) % 40) - 20) * 0.0125);
    }
  }
  const machines::HeightGrid smooth = machines::rounded(grid, 0.05);
  double most_m = 0.0;
  for (std::size_t i = 0; i < grid.height_m.size(); ++i) {
    const double over_m = smooth.height_m[i] - grid.height_m[i];
    assert_true(over_m > -1e-12);
    most_m = std::max(most_m, over_m);
  }
  assert_true(most_m < 0.02 && most_m > 0.008);
  assert_near(smooth.at(30, 15), grid.at(30, 15), 1e-12);
  assert_near(smooth.at(50, 15), grid.at(50, 15), 1e-12);
  assert_near(machines::rounded(grid, 0.0).at(40, 15), grid.at(40, 15), 0.0);
}

/// The site's frame lies under a plane and under a ditch alike: benchmark and heading.
TEST(a_design_of_the_site) {
  const std::string site =
      "[site]\nbenchmark = [1000.0, 2000.0, 50.0]\ntouched = [4.0, 0.0, 0.2]\n"
      "heading = 1.5707963268\n";
  // The machine looks north: 1 m farther out is 1 m farther north.
  const machines::TaskFile plane = task_of(
      "[design]\nthrough = [1000.0, 2000.0, 49.5]\nslope = 0.1\nheading = 1.5707963268\n" + site);
  assert_near(under_m(plane, 4.0, 0.0), -0.3, 1e-6);
  assert_near(under_m(plane, 5.0, 3.0), -0.2, 1e-6);
  const machines::TaskFile ditch = task_of(
      "[design.ditch]\nfrom = [996.0, 2001.5, 49.5]\nto = [1004.0, 2001.5]\nbottom = 1.0\n"
      "slope = 0.05\nsides = [1.0, 1.0]\ntop = 1.0\n" +
      site);
  assert_near(under_m(ditch, 5.5, 0.0), -0.3 + 0.05 * 4.0, 1e-3);
  assert_near(under_m(ditch, 5.5, 2.0), -0.3 + 0.05 * 2.0, 1e-3);
}

/// Points that were touched say it too, and are refused too near, and where they contradict.
TEST(a_site_by_touched_points) {
  const auto text = [](const std::string& second, const std::string& bound) {
    return "[design]\nthrough = [10.0, 20.0, 5.0]\nslope = 0.0\n[site]\n" + bound +
           "[[site.point]]\nplace = [10.0, 20.0, 5.0]\ntouched = [5.0, 0.0, 0.1]\n"
           "[[site.point]]\n" +
           second;
  };
  const machines::TaskFile task =
      task_of(text("place = [10.0, 26.0, 5.1]\ntouched = [0.0, 3.3166, 0.2]\n", ""));
  assert_near(under_m(task, 5.0, 0.0), 0.1, 1e-9);
  assert_says(errors_of(text("place = [11.0, 20.0, 5.0]\ntouched = [6.0, 0.0, 0.1]\n", "")),
              "1.00 m apart");
  const std::string off = "place = [10.0, 26.0, 5.1]\ntouched = [0.0, 3.3166, 0.25]\n";
  assert_says(errors_of(text(off, "")), "touched point 2: 0.000 m in plan and +0.050 m in height");
  assert_says(errors_of(text(off, "bound = 0.06\n")), "");
  assert_true(errors_of(text(off, "bound = 0.06\n")).empty());
  assert_says(errors_of(text("place = [10.0, 26.2, 5.1]\ntouched = [0.0, 3.3166, 0.2]\n", "")),
              "0.200 m in plan");
}

machines::HeightGrid read_text(const std::string& text) {
  const test::Written file(text);
  return machines::read_ascii_grid(file.path());
}

/// An ESRI grid has its rows from the north, its corner is its first cell's.
TEST(a_grid_of_a_file) {
  const machines::HeightGrid grid = read_text(
      "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 0.5\nNODATA_value -9999\n"
      "1 2 3\n4 -9999 6e0\n");
  assert_near(grid.first_m.x(), 10.25, 0.0);
  assert_near(grid.first_m.y(), 20.25, 0.0);
  assert_near(grid.at(0, 1), 1.0, 0.0);
  assert_near(grid.at(2, 0), 6.0, 0.0);
  assert_true(std::isnan(grid.at(1, 0)));
  const std::string head = "ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 0.1\n";
  for (const auto& [text, words] : std::initializer_list<std::pair<std::string, const char*>>{
           {head + "1 2 3", "line 6: a height: ''; allowed: a number"},
           {head + "1 2 3 4 5", "more than 2 by 2"},
           {head + "1 2 3 x", "'x'; allowed: a number"},
           {head + "1 2 3 nan", "'nan'; allowed: a number"},
           {head + "1 2 3 20000", "a height of 20000 m; allowed: -10000 .. 10000 m"},
           {"ncols 2.5\nnrows 2\n", "ncols 2.5; allowed: 2 .. "},
           {"ncols 40000\nnrows 40000\nxllcenter 0\nyllcenter 0\ncellsize 0.1\n", "in all"},
           {"nrows 2\n", "ncols is missing"},
           {"ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 2\n",
            "cellsize 2 m; allowed: 0.01"},
           {"ncols 2\nnrows 2\nxllcenter 0\ncellsize 0.1\n1 2 3 4", "yllcorner and yllcenter"},
           {"ncols 2\nncols 2\n", "a second time"},
           {"north 2\n", "'north'; allowed in front"},
           {"<LandXML/>", "graben surface"}}) {
    test::expect_refusal([&, wrong = text] { return read_text(wrong); }, words);
  }
}

/// A file beside the task, under the site's frame; one that lies elsewhere, or is not there, is
/// refused with its place.
TEST(a_design_of_a_file) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("graben_grid_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::string grid = "ncols 60\nnrows 60\nxllcenter 100\nyllcenter 200\ncellsize 0.1\n";
  for (int i = 0; i < 3600; ++i) {
    grid += fmt::format("{} ", 7.0 + 0.05 * (i % 60) * 0.1);
  }
  std::ofstream(folder / "site.asc") << grid;
  const auto written = [&](const std::string& site) {
    std::ofstream(folder / "task.toml") << "[design]\nfile = \"site.asc\"\n[site]\n" + site;
    return machines::load_task(folder / "task.toml", test::profile("excavator_12t"));
  };
  {
    const machines::TaskFile task =
        written("benchmark = [103.0, 203.0, 7.0]\ntouched = [6.0, 0.0, -0.2]\nheading = 0.5\n");
    const double east_m = 3.0 + std::cos(0.5) * 0.5;
    assert_near(under_m(task, 6.5, 0.0), -0.2 + 0.05 * east_m, 1e-3);
    assert_true(std::isnan(under_m(task, 1.0, 0.0)));
    assert_true(
        task.hash !=
        written("benchmark = [103.0, 203.0, 7.0]\ntouched = [6.0, 0.0, -0.1]\nheading = 0.5\n")
            .hash);
  }
  test::expect_refusal(
      [&] {
        return written("benchmark = [0.0, 0.0, 0.0]\ntouched = [0.0, 0.0, 0.0]\nheading = 0.0\n");
      },
      "no height lies within the");
  std::filesystem::remove(folder / "site.asc");
  test::expect_refusal(
      [&] {
        return written(
            "benchmark = [103.0, 203.0, 7.0]\ntouched = [6.0, 0.0, 0.0]\nheading = 0.0\n");
      },
      "site.asc");
  std::filesystem::remove_all(folder);
}

TEST(wrong_designs_say_key_and_range) {
  const std::string plane = "[design]\nthrough = [5.0, 0.0, -0.4]\n";
  for (const auto& [text, words] : std::initializer_list<std::pair<std::string, const char*>>{
           {plane, "design.normal"},
           {plane + "slope = 3.0\n", "design.slope"},
           {plane + "slope = 0.1\nnormal = [0.0, 0.0, 1.0]\n", "stands with slope"},
           {plane + "slope = 0.1\ndepth = -0.1\n", "design.depth"},
           {plane + "slope = 0.1\nfile = \"a.asc\"\n", "design.slope"},
           {plane + "slope = 0.1\nrounding = 0.1\n", "design.rounding"},
           {"[design]\nfile = \"a.asc\"\n", "allowed: with a section [site]"},
           {"[design]\nslope = 0.1\n", "design.through"},
           {std::string(kDitch) +
                "[site]\nbenchmark = [0.0, 0.0, 0.0]\ntouched = [0.0, 0.0, 0.0]\n",
            "site.heading"},
           {std::string(kDitch) + "depth_m = 1.0\n", "design.ditch.depth_m"},
           {"[site]\nbenchmark = [0.0, 0.0, 0.0]\ntouched = [0.0, 0.0, 0.0]\nheading = 0.0\n",
            "start"},
           {"[design.ditch]\nfrom = [6.0, 0.0, 0.0]\nto = [6.5, 0.0]\nsides = [1.0, 1.0]\ntop = "
            "1.0\n",
            "0.500 m from where it begins; allowed: 1 m"},
           {"[design.ditch]\nfrom = [26.0, 0.0, 0.0]\nto = [26.0, 9.0]\nsides = [1.0, 1.0]\n"
            "top = 1.0\n",
            "no height lies within"},
           {"[design.ditch]\nfrom = [6.0, 0.0, 0.0]\nto = [6.0, 9.0]\nsides = [1.0, 5.0]\n"
            "top = 1.0\n",
            "design.ditch.sides"}}) {
    assert_says(errors_of(text), words);
  }
}

/// A dig that would go under a surface is refused by its fence; over it, it is planned.
TEST(a_dig_keeps_over_a_surface) {
  const std::string ditch =
      "[design.ditch]\nfrom = [-2.0, 5.4, {}]\nto = [6.0, 5.4]\nbottom = 8.0\nsides = [1.0, 1.0]\n"
      "top = 1.0\n";
  const std::string shipped = test::shipped("flatten");
  const auto at = [&](const char* height) {
    std::string text = ditch;
    text.replace(text.find("{}"), 2, height);
    return shipped + "\n" + text;
  };
  assert_says(errors_of(at("0.1")), "the design surface");
  assert_true(errors_of(at("-0.2")).empty());
}

constexpr const char* kTouchedSite =
    "[site]\nbenchmark = [4321.5, 8765.2, 54.3]\nsecond = [4325.5, 8765.2, 54.5]\n"
    "[design]\nthrough = [4321.5, 8766.2, 54.1]\nslope = 0.1\n";

/// Points that are touched at run time: the design as if the machine stood on the benchmark.
TEST(a_site_that_is_touched_at_run_time) {
  const machines::TaskFile task = task_of(kTouchedSite);
  assert_true(task.site && task.site->points.by_touch);
  assert_true(task.site->points.can_touch);
  assert_near(task.site->points.benchmark_m.norm(), 0.0, 1e-9);
  assert_near((task.site->points.second_m - Eigen::Vector3d(4.0, 0.0, 0.2)).norm(), 0.0, 1e-9);
  assert_near(under_m(task, 0.0, 1.0), -0.2, 1e-9);
  assert_near(under_m(task, 1.0, 1.0), -0.1, 1e-9);
  // Twice the reach about the benchmark.
  const std::string site = std::string(kTouchedSite, std::string(kTouchedSite).find("[design]"));
  const machines::TaskFile ditch =
      task_of(site +
              "[design.ditch]\nfrom = [4333.5, 8765.2, 54.0]\nto = [4333.5, 8770.2]\n"
              "bottom = 0.6\nsides = [1.0, 1.0]\ntop = 1.0\n");
  assert_near(under_m(ditch, 12.0, 2.0), -0.3, 2e-3);
}

/// A frame of the file can be touched again where it has a second point; of touched points the one
/// that is farthest from the benchmark.
TEST(a_given_site_can_be_touched_again) {
  const std::string design = "[design]\nthrough = [1.0, 2.0, 3.0]\nslope = 0.0\n";
  const machines::TaskFile given = task_of(
      "[site]\nbenchmark = [1.0, 2.0, 3.0]\ntouched = [5.0, 0.0, 0.1]\n"
      "heading = 1.5707963268\nsecond = [1.0, 6.0, 3.0]\n" +
      design);
  assert_false(given.site->points.by_touch);
  assert_near((given.site->points.benchmark_m - Eigen::Vector3d(5.0, 0.0, 0.1)).norm(), 0.0, 1e-9);
  assert_near((given.site->points.second_m - Eigen::Vector3d(9.0, 0.0, 0.1)).norm(), 0.0, 1e-9);
  const machines::TaskFile points = task_of(
      "[[site.point]]\nplace = [0.0, 0.0, 0.0]\ntouched = [5.0, 0.0, 0.0]\n"
      "[[site.point]]\nplace = [0.0, 3.5, 0.0]\ntouched = [5.0, 3.5, 0.0]\n"
      "[[site.point]]\nplace = [-1.0, 4.0, 0.0]\ntouched = [4.0, 4.0, 0.0]\n" +
      design);
  assert_true(points.site->points.can_touch);
  assert_near(points.site->points.second_m.y(), 4.0, 1e-6);
}

TEST(a_site_that_cannot_be_touched_is_refused) {
  const std::string near = "[site]\nbenchmark = [0.0, 0.0, 0.0]\nsecond = [2.9, 0.0, 9.0]\n";
  const std::string design = "[design]\nthrough = [0.0, 0.0, 0.0]\nslope = 0.0\n";
  assert_says(errors_of(near + design), "2.90 m from the benchmark, seen from above; allowed: 3 m");
  assert_says(errors_of("[site]\nbenchmark = [0.0, 0.0, 0.0]\n" + design), "site.touched");
  assert_says(errors_of("[site]\nbenchmark = [0.0, 0.0, 0.0]\nheading = 0.0\n"
                        "second = [4.0, 0.0, 0.0]\n" +
                        design),
              "site.touched");
  assert_says(
      errors_of(test::shipped("flatten") +
                "\n[site]\nbenchmark = [0.0, 0.0, 0.0]\nsecond = [4.0, 0.0, 0.0]\n" + design),
      "steps are planned before");
}

/// Tasks of one machine stand on one site, touched or given alike.
TEST(tasks_stand_on_one_site) {
  const auto both = [](const std::string& one, const std::string& other) {
    const test::Written first(one);
    const std::filesystem::path second =
        std::filesystem::temp_directory_path() /
        ("graben_other_site_" + std::to_string(getpid()) + ".toml");
    std::ofstream(second) << other;
    const std::string said = test::refusal_of([&] {
      return machines::load_tasks({first.path().string(), second.string()}, {},
                                  test::profile("excavator_12t"));
    });
    std::filesystem::remove(second);
    return said;
  };
  std::string moved = kTouchedSite;
  moved.replace(moved.find("4325.5"), 6, "4326.5");
  const std::string own = "[design]\nthrough = [5.0, 0.0, 0.0]\nslope = 0.0\n";
  assert_true(both(kTouchedSite, kTouchedSite).empty());
  assert_says(both(kTouchedSite, moved), "its [site] is another one");
  assert_says(both(kTouchedSite, own), "its [site] is another one");
  assert_says(both(own, kTouchedSite), "its [site] is another one");
}
