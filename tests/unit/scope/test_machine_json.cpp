// SPDX-License-Identifier: Apache-2.0
/// What a page is told of machines, against their profiles.

#include "app/reports/page_setup.hpp"

#include <set>

#include "firmware/dozer/grade_profile.hpp"
#include "firmware/excavator/motion/field/dig_field.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"
#include "tests/unit/scope/temporary_file.hpp"

using nlohmann::json;

constexpr double kRounding = 1e-6;

machines::SimulatedExcavator excavator(const char* name) {
  return machines::load_simulated_excavator(machines::find_profile(name));
}

const json& machine_named(const json& setup, const std::string& name) {
  for (const json& machine : setup["machines"]) {
    if (machine["name"] == name) {
      return machine;
    }
  }
  throw std::runtime_error("no machine " + name);
}

TEST(every_shipped_machine_is_there) {
  const json setup = reports::shared_setup({});
  assert_int_equal(setup["machines"].size(), 8);
  for (const char* name :
       {"excavator_12t", "excavator_22t", "excavator_22t_ls", "excavator_12t_nfc"}) {
    const json& told = machine_named(setup, name);
    const machines::SimulatedExcavator machine = excavator(name);
    assert_true(told["kind"] == "excavator");
    assert_int_equal(told["hash"].get<std::uint32_t>(), machine.hash);
  }
  const json& dozer = machine_named(setup, "dozer_9t");
  assert_true(dozer["kind"] == "dozer");
  assert_int_equal(dozer["hash"].get<std::uint32_t>(),
                   machines::load_simulated_dozer(machines::find_profile("dozer_9t")).hash);
}

TEST(geometry_is_the_profile_s) {
  const machines::SimulatedExcavator machine = excavator("excavator_12t");
  const ExcavatorGeometry& geometry = machine.profile.geometry;
  const json told = reports::machine_json(machine, {});
  assert_near(told["boom_m"].get<double>(), geometry.boom_length_m, 0.0);
  assert_near(told["arm_m"].get<double>(), geometry.arm_length_m, 0.0);
  assert_near(told["bucket_m"].get<double>(), geometry.bucket_length_m, 0.0);
  assert_near(told["boom_foot_m"][0].get<double>(), geometry.boom_foot_m.x(), 0.0);
  assert_near(told["boom_foot_m"][1].get<double>(), geometry.boom_foot_m.y(), 0.0);
  const char* names[] = {"boom", "arm", "bucket"};
  for (unsigned i = 0; i < 3; ++i) {
    const json& cylinder = told["cylinders"][names[i]];
    const CylinderGeometry& own = geometry.cylinder[i];
    assert_int_equal(cylinder["count"].get<int>(), own.count);
    assert_near(cylinder["bore_m"].get<double>(), own.bore_m, 0.0);
    assert_near(cylinder["rod_m"].get<double>(), own.rod_m, 0.0);
    assert_near(cylinder["closed_length_m"].get<double>(), own.closed_length_m, 0.0);
    assert_near(cylinder["stroke_m"].get<double>(), own.stroke_m, 0.0);
    assert_near(cylinder["base_m"][1].get<double>(), own.base_m.y(), 0.0);
    assert_near(cylinder["eye_m"][0].get<double>(), own.eye_m.x(), 0.0);
  }
  assert_near(told["linkage"]["rocker_m"].get<double>(), geometry.linkage.rocker_m, 0.0);
  assert_near(told["linkage"]["coupler_m"].get<double>(), geometry.linkage.coupler_m, 0.0);
  assert_near(told["linkage"]["rocker_pivot_m"][0].get<double>(),
              geometry.linkage.rocker_pivot_m.x(), 0.0);
  assert_near(told["linkage"]["lug_m"][1].get<double>(), geometry.linkage.lug_m.y(), 0.0);
  assert_true(told["has_swing"].get<bool>());
  assert_int_equal(told["pumps"].get<int>(), machine.profile.pump_count);
  assert_near(told["relief_pa"].get<double>(), machine.profile.pump[0].relief_pa, 0.0);
  assert_false(reports::machine_json(excavator("excavator_22t"), {})["has_swing"].get<bool>());
}

/// Closed, in short steps, and every point of it on the rectangle, seen from the boom foot.
TEST(the_path_is_the_task_s) {
  for (const char* name :
       {"excavator_12t", "excavator_22t", "excavator_22t_ls", "excavator_12t_nfc"}) {
    const machines::SimulatedExcavator machine = excavator(name);
    const Eigen::Vector2d foot_m = machine.profile.geometry.boom_foot_m;
    const RoundedRectangle path(machine.profile.dig_path);
    const json told = reports::machine_json(machine, {})["dig"];
    const json& points = told["path"];
    assert_true(points.front() == points.back());
    double length_m = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Eigen::Vector2d at_m(points[i][0].get<double>(), points[i][1].get<double>());
      const Eigen::Vector2d before_m(points[i - 1][0].get<double>(),
                                     points[i - 1][1].get<double>());
      const double step_m = (at_m - before_m).norm();
      assert_true(step_m > 0.01 && step_m < 0.0201);
      length_m += step_m;
      const PathPoint own = path.closest(at_m - foot_m);
      assert_near((own.position_m - at_m + foot_m).norm(), 0.0, 2.0 * kRounding);
      assert_near(points[i][2].get<double>(), own.attitude_rad, 1e-5);
    }
    assert_near(length_m, path.length_m(), 0.01);
    assert_near(told["speed_mps"].get<double>(), machine.profile.dig_speed_mps, 0.0);
    assert_near(told["ground_z_m"].get<double>(), machine.experiment.soil.ground_y_m + foot_m.y(),
                1e-12);
  }
}

TEST(the_bucket_is_as_wide_as_the_profile_says) {
  machines::SimulatedExcavator machine = excavator("excavator_22t");
  const json told = reports::machine_json(machine, {});
  assert_near(told["bucket_width_m"].get<double>(), 1.2, 0.0);
  assert_near(told["bucket_capacity_m3"].get<double>(), 1.1, 0.0);
  machine.profile.geometry.body = {};
  assert_false(reports::machine_json(machine, {}).contains("bucket_width_m"));
}

TEST(ground_that_is_cut_lies_at_its_level) {
  machines::Scenario scenario;
  scenario.ground = "loam";
  machines::SimulatedExcavator machine = machines::arranged(excavator("excavator_22t"), scenario);
  assert_near(reports::machine_json(machine, {})["dig"]["ground_z_m"].get<double>(), 0.0, 0.0);
}

TEST(the_field_is_the_controller_s) {
  const machines::SimulatedExcavator machine = excavator("excavator_22t");
  const Eigen::Vector2d foot_m = machine.profile.geometry.boom_foot_m;
  const DigField field(machine.profile, ExcavatorKinematics(machine.profile.geometry));
  const json told = reports::machine_json(machine, {})["dig"]["field"];
  // 3 m by 2.4 m, a metre more on every side.
  assert_int_equal(told.size(), 21 * 19);
  for (int i = 0; i < 21 * 19; ++i) {
    // Exactly: on the path's medial axis a rounded number is nearest to another side of it.
    const Eigen::Vector2d at_m(2.5 + 0.25 * (i / 19), -3.2 + 0.25 * (i % 19));
    const json& arrow = told[static_cast<std::size_t>(i)];
    assert_near(arrow[0].get<double>(), at_m.x() + foot_m.x(), kRounding);
    assert_near(arrow[1].get<double>(), at_m.y() + foot_m.y(), kRounding);
    const double attitude_rad = field.path().closest(at_m).attitude_rad;
    const TipVelocity own = field.contour({at_m.x(), at_m.y(), attitude_rad});
    assert_near(arrow[2].get<double>(), own.linear_mps.x(), kRounding);
    assert_near(arrow[3].get<double>(), own.linear_mps.y(), kRounding);
    const double speed_mps = std::hypot(arrow[2].get<double>(), arrow[3].get<double>());
    assert_true(speed_mps > 0.0 && speed_mps < machine.profile.dig_speed_mps + 1e-5);
  }
}

Eigen::Vector3d vector(const json& told) {
  return {told[0].get<double>(), told[1].get<double>(), told[2].get<double>()};
}

DriveVector drives(const json& told) {
  return {told[0].get<double>(), told[1].get<double>(), told[2].get<double>(),
          told[3].get<double>()};
}

/// Each step from where the one before ends; its drives put the teeth where it says.
TEST(steps_join_and_their_drives_fit) {
  const machines::SimulatedExcavator machine = excavator("excavator_12t");
  const SwingKinematics kinematics(machine.profile.geometry);
  const machines::TaskFile task =
      machines::load_task(machines::find_task("truck_by_steps"), machine.profile);
  const json told = reports::task_json(task, machine.profile);
  const json& steps = told["steps"];
  assert_int_equal(steps.size(), 5);
  const char* kinds[] = {"dig", "lift", "swing", "dump", "return"};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const json& step = steps[i];
    assert_true(step["kind"] == kinds[i]);
    assert_true(step["straight"].get<bool>() == (i < 2));
    assert_near(step["duration_s"].get<double>(), task.result.program.step[i].duration_s(),
                kRounding);
    assert_near(
        (vector(steps[(i + 1) % 5]["from"]["position_m"]) - vector(step["to"]["position_m"]))
            .norm(),
        0.0, 1e-5);
    for (const char* end : {"from", "to"}) {
      const DriveVector at = drives(step[std::string(end) + "_drives"]);
      const TeethPose teeth = kinematics.teeth_from_joints(kinematics.joints_from_drive(at).value);
      assert_near((teeth.position_m - vector(step[end]["position_m"])).norm(), 0.0, 5e-5);
      assert_near(teeth.attitude_rad, step[end]["attitude_rad"].get<double>(), 5e-5);
    }
  }
}

TEST(fences_have_words_and_the_design_is_the_last) {
  const machines::SimulatedExcavator machine = excavator("excavator_12t");
  const json told = reports::task_json(
      machines::load_task(machines::find_task("truck_by_steps"), machine.profile), machine.profile);
  const char* words[] = {"ceiling at 6.50 m", "floor at -0.80 m", "wall", "design surface"};
  assert_int_equal(told["fences"].size(), 4);
  for (std::size_t i = 0; i < 4; ++i) {
    assert_string_equal(told["fences"][i]["words"].get<std::string>().c_str(), words[i]);
  }
  assert_near(told["fences"][2]["offset_m"].get<double>(), 7.5, kRounding);
  assert_near((vector(told["fences"][2]["normal"]) - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-9);
  assert_near(vector(told["design"]["through_m"]).z(), -0.5, kRounding);
  assert_near(vector(told["design"]["up"]).z(), 1.0, kRounding);
  const json flatten = reports::task_json(
      machines::load_task(machines::find_task("flatten"), machine.profile), machine.profile);
  assert_true(flatten["design"].is_null());
  assert_int_equal(flatten["fences"].size(), 0);
}

TEST(the_dozer_is_the_profile_s) {
  const machines::SimulatedDozer machine =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  const json told = reports::machine_json(machine);
  const BladeGeometry& blade = machine.profile.blade;
  assert_near(told["blade"]["pivot_m"][0].get<double>(), blade.pivot_m.x(), 0.0);
  assert_near(told["blade"]["arm_m"][1].get<double>(), blade.arm_m.y(), 0.0);
  assert_near(told["blade"]["base_m"][1].get<double>(), blade.base_m.y(), 0.0);
  assert_near(told["blade"]["cutting_edge_m"].get<double>(), blade.cutting_edge_m, 0.0);
  assert_near(told["blade"]["length_home_m"].get<double>(), blade.length_home_m, 0.0);
  assert_near(told["blade"]["edge_min_m"].get<double>(), blade.edge_min_m, 0.0);
  assert_near(told["blade"]["edge_max_m"].get<double>(), blade.edge_max_m, 0.0);
  assert_int_equal(told["blade"]["cylinders"].get<int>(), blade.cylinder_count);
  assert_near(told["blade"]["bore_m"].get<double>(), blade.bore_m, 0.0);
  assert_near(told["blade"]["rod_m"].get<double>(), blade.rod_m, 0.0);
  assert_near(told["track_contact_m"].get<double>(), machine.profile.body.track_contact_m, 0.0);
  assert_near(told["half_gauge_m"].get<double>(), machine.profile.body.half_gauge_m, 0.0);
  assert_near(told["mass_centre_height_m"].get<double>(), machine.profile.body.mass_centre_height_m,
              0.0);
  assert_near(told["length_m"].get<double>(), machine.experiment.length_m, 0.0);
}

TEST(the_design_rises_in_x_and_is_the_grade) {
  const machines::SimulatedDozer machine =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  const GradeProfile grade(machine.profile.grade);
  const json design = reports::machine_json(machine)["design"];
  assert_true(design.front()[0].get<double>() <= 0.0);
  assert_true(design.back()[0].get<double>() >= machine.experiment.length_m);
  double lowest_m = 0.0;
  for (std::size_t i = 0; i < design.size(); ++i) {
    const double x_m = design[i][0].get<double>();
    assert_near(design[i][1].get<double>(), grade.at(x_m).height_m, 2.0 * kRounding);
    assert_true(i == 0 || std::fabs(x_m - design[i - 1][0].get<double>() - 0.05) < 1e-5);
    lowest_m = std::fmin(lowest_m, design[i][1].get<double>());
  }
  assert_near(lowest_m, -0.35, 1e-3);
}

TEST(every_number_has_words_of_its_own) {
  const json words = reports::text_json();
  std::set<std::string> faults;
  for (int i = 0; i < kFaultCount; ++i) {
    faults.insert(words["fault"].at(std::to_string(i)).get<std::string>());
  }
  assert_int_equal(words["fault"].size(), kFaultCount);
  assert_int_equal(faults.size(), kFaultCount);
  assert_int_equal(faults.count("unknown"), 0);
  const auto list = words["why_not_armed"].get<std::vector<std::string>>();
  const std::set<std::string> blocks(list.begin(), list.end());
  assert_int_equal(list.size(), 30);
  assert_int_equal(blocks.size(), 30);
  assert_int_equal(blocks.count("unknown"), 0);
  assert_string_equal(list[11].c_str(), "the operator drives by hand");
}

std::vector<std::string> tasks_of(const json& setup, const std::string& machine) {
  std::vector<std::string> names;
  for (const json& task : machine_named(setup, machine)["tasks"]) {
    names.push_back(task["name"]);
  }
  return names;
}

TEST(tasks_are_numbered_as_told) {
  const std::vector<std::string> shipped = {"bench",  "flatten",        "level",        "slope",
                                            "trench", "truck_by_steps", "truck_loading"};
  assert_true(tasks_of(reports::shared_setup({}), "excavator_12t") == shipped);
  assert_true(tasks_of(reports::shared_setup({}), "excavator_22t").empty());
  const std::vector<std::string> told = {"truck_by_steps", "flatten", "flatten"};
  assert_true(tasks_of(reports::shared_setup({std::nullopt, told}), "excavator_12t") == told);
}

void assert_error(const reports::SetupOptions& options, const std::string& words) {
  test::expect_refusal([&] { return reports::shared_setup(options); }, words);
}

TEST(what_is_wrong_is_said) {
  assert_error({"no_such_profile", {}}, "no_such_profile");
  assert_error({std::nullopt, {"no_such_task"}}, "no_such_task");
  assert_error({"dozer_9t", {"flatten"}}, "--task: fits no machine");
  assert_error({std::nullopt, {"flatten", "flatten", "flatten", "flatten", "flatten"}},
               "5 tasks; at most 4 are allowed");
  const test::TemporaryFile task("start = { position = [0.0, 99.0, 0.0], attitude = 2.0 }\n");
  assert_error({std::nullopt, {task.path().string()}}, "fits no machine\non excavator_12t: ");
}

TEST(a_profile_that_is_told_comes_first_and_once) {
  std::ifstream shipped(machines::find_profile("excavator_12t"));
  std::stringstream text;
  text << shipped.rdbuf();
  const test::TemporaryFile copy(text.str() + "\n# another one\n");
  const json setup = reports::shared_setup({copy.path().string(), {}});
  assert_int_equal(setup["machines"].size(), 9);
  assert_true(setup["machines"][0]["name"] == copy.path().stem().string());
  // A comment does not make another machine of it.
  assert_true(setup["machines"][0]["hash"] == machine_named(setup, "excavator_12t")["hash"]);
  const json same = reports::shared_setup({"dozer_9t", {}});
  assert_int_equal(same["machines"].size(), 8);
  assert_true(same["machines"][0]["name"] == "dozer_9t");
}

/// What of a bus tells links, and nothing else of it; one that is told comes first.
TEST(buses_tell_where_links_are) {
  const json buses = reports::shared_setup({std::nullopt, {}, "zx200"})["buses"];
  assert_true(buses.size() > 6);
  assert_true(buses[0]["name"] == "zx200");
  const json& messages = buses[0]["messages"];
  assert_int_equal(messages.size(), 1);
  assert_int_equal(messages[0]["id"].get<std::uint32_t>(), 0x18FF7DE8);
  assert_true(messages[0]["extended"] == true);
  assert_int_equal(messages[0]["signals"].size(), 3);
  const json& arm = messages[0]["signals"][1];
  assert_true(arm["tells"] == "joint_angle");
  assert_int_equal(arm["of"].get<int>(), 1);
  assert_int_equal(arm["start"].get<int>(), 16);
  assert_near(arm["scale"].get<double>(), -0.0004, 1e-12);
  assert_error({std::nullopt, {}, "no_such_bus"}, "no_such_bus");
}
