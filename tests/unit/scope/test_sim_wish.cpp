// SPDX-License-Identifier: Apache-2.0
// What a page may not ask of a simulation, and in which words it is refused.

#include <limits>
#include <set>

#include "tests/unit/refusal.hpp"
#include "tests/unit/scope/sim_watch.hpp"

using test::json;
using test::options_of;
using test::SimWatch;

/// Its text has to name what is wrong, and what is allowed.
void refused(SimWatch& sim, const json& message, const char* words) {
  const std::optional<std::string> why = sim.session.control(message);
  if (!why || why->find(words) == std::string::npos) {
    print_error("%s: '%s', expected '%s'\n", message.dump().c_str(), why.value_or("taken").c_str(),
                words);
  }
  assert_true(why && why->find(words) != std::string::npos);
}

TEST(messages_that_are_none) {
  SimWatch sim("dig");
  const json before = sim.state();
  const char* kinds = "run, stop, restart, clear, pace, speed, soil, obstacle or fault";
  for (const char* text : {"null", "7", "\"run\"", "[]", "{}", "{\"do\":7}", "{\"do\":\"Run\"}",
                           "{\"do\":null}", "{\"run\":true}"}) {
    refused(sim, json::parse(text), kinds);
  }
  refused(sim, {{"do", std::string(3000, 'x')}}, "...; allowed");
  refused(sim, {{"do", "run"}, {"value", 1}}, "run: no such key: \"value\"");
  refused(sim, {{"do", "pace"}, {"value", 1}, {"id", "x"}}, "pace: no such key: \"id\"");
  refused(sim, {{"do", "fault"}, {"id", "babble"}, {"value", true}, {"x", 1}},
          "no such key: \"x\"");
  refused(sim, {{"do", "pace"}}, "pace: 'value' is missing");
  refused(sim, {{"do", "fault"}, {"value", true}}, "fault: 'id' is missing");
  refused(sim, {{"do", "fault"}, {"id", "babble"}}, "fault: 'value' is missing");
  sim.run(0.05);
  assert_true(sim.state() == before);
}

TEST(values_out_of_their_range) {
  SimWatch sim("dig");
  for (const json& value : {json(0.0999), json(10.001), json(-1), json(0), json("1"), json(true),
                            json(nullptr), json(std::numeric_limits<double>::quiet_NaN())}) {
    refused(sim, {{"do", "pace"}, {"value", value}}, "allowed: 0.1 .. 10");
  }
  for (const json& value : {json(0.0499), json(1.001), json(-0.5), json(json::array())}) {
    refused(sim, {{"do", "speed"}, {"value", value}}, "allowed: 0.05 .. 1");
  }
  for (const char* what : {"soil", "obstacle"}) {
    refused(sim, {{"do", what}, {"value", 1}}, "allowed: true, false");
  }
  refused(sim, {{"do", "fault"}, {"id", "babble"}, {"value", "on"}}, "allowed: true, false");
  refused(sim, {{"do", "fault"}, {"id", "none"}, {"value", true}}, "fault: \"none\"; allowed");
  refused(sim, {{"do", "fault"}, {"id", 24}, {"value", true}}, "fault: 24; allowed");
  for (const double value : {0.1, 10.0}) {
    sim.wish({{"do", "pace"}, {"value", value}});
  }
  for (const double value : {0.05, 1.0}) {
    sim.wish({{"do", "speed"}, {"value", value}});
  }
  // A track speed is nothing that an excavator has.
  refused(sim, {{"do", "fault"}, {"id", "track-speed"}, {"value", true}}, "allowed");
}

TEST(more_wishes_than_can_wait) {
  SimWatch sim("grade");
  for (std::size_t n = 0; n < scope::SimSession::kWishesMost; ++n) {
    sim.wish({{"do", "stop"}});
  }
  refused(sim, {{"do", "stop"}}, "more than 64 wishes");
  sim.run(0.01);
  sim.wish({{"do", "stop"}});
}

TEST(options_that_do_not_fit) {
  const struct {
    const char* task;
    std::optional<std::string> profile, task_file;
    const char *soil, *words;
  } rows[] = {
      {"plough", {}, {}, "", "allowed: dig, grade, autodig"},
      {"grade", "excavator_22t", {}, "", "needs a dozer"},
      {"dig", "dozer_9t", {}, "", "needs an excavator"},
      {"autodig", "excavator_22t", {}, "", "swing drive"},
      {"dig", {}, "flatten", "", "of the task autodig alone"},
      {"grade", {}, {}, "loam", "of an excavator alone"},
      {"autodig", {}, {}, "kim", "of the task dig alone"},
      {"autodig", {}, {}, "mud", "sand, loam, clay, stones"},
  };
  for (const auto& row : rows) {
    scope::SimOptions options = options_of(row.task);
    options.profile = row.profile;
    options.task_file = row.task_file;
    options.soil = row.soil;
    test::expect_refusal([&] { return SimWatch(options); }, row.words);
  }
}

TEST(only_the_digging_machine_has_ground) {
  assert_true(SimWatch("dig").session.setup()["can"] ==
              json::parse(R"({"soil": true, "obstacle": true})"));
  for (const char* task : {"grade", "autodig"}) {
    SimWatch sim(task);
    assert_true(sim.session.setup()["can"] == json::parse(R"({"soil": false, "obstacle": false})"));
    refused(sim, {{"do", "soil"}, {"value", true}}, "soil: not of this simulation");
    refused(sim, {{"do", "obstacle"}, {"value", false}}, "obstacle: not of this simulation");
  }
  scope::SimOptions options = options_of("dig");
  options.soil = "kim";
  SimWatch field(options);
  field.run(0.1);
  assert_true(field.state()["soil"] == true);
  options.soil = "loam";
  assert_true(SimWatch(options).session.setup()["can"] ==
              json::parse(R"({"soil": false, "obstacle": false})"));
}

TEST(setup_names_its_faults) {
  for (const char* task : {"dig", "grade", "autodig"}) {
    const json setup = SimWatch(task).session.setup();
    assert_true(setup["task"] == task);
    std::set<std::string> ids;
    for (const json& fault : setup["faults"]) {
      ids.insert(fault["id"].get<std::string>());
      assert_true(fault["once"].is_boolean());
      assert_false(fault["words"].get<std::string>().empty());
      assert_false(fault["reaction"].get<std::string>().empty());
    }
    assert_int_equal(ids.size(), setup["faults"].size());
  }
}
