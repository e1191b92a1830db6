// SPDX-License-Identifier: Apache-2.0
#include "app/machines/new/new_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "app/machines/axis_names.hpp"
#include "app/machines/excavator_sections.hpp"
#include "app/machines/new/commented_toml.hpp"
#include "app/machines/new/profile_keys.hpp"
#include "app/machines/toml_reader.hpp"

namespace graben::machines {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// What a person can measure or read from a data sheet, in the order of walking round the machine.
const std::vector<const char*> kAskedOfExcavator = {"body.boom_foot",
                                                    "boom.length",
                                                    "boom.cylinder.bore",
                                                    "boom.cylinder.rod",
                                                    "boom.cylinder.closed_length",
                                                    "boom.cylinder.stroke",
                                                    "boom.cylinder.AB",
                                                    "boom.cylinder.BC",
                                                    "boom.cylinder.angle_ABX0",
                                                    "boom.cylinder.angle_CBX1",
                                                    "boom.cylinder.base",
                                                    "boom.cylinder.eye",
                                                    "arm.length",
                                                    "arm.cylinder.bore",
                                                    "arm.cylinder.rod",
                                                    "arm.cylinder.closed_length",
                                                    "arm.cylinder.stroke",
                                                    "arm.cylinder.base",
                                                    "arm.cylinder.eye",
                                                    "bucket.length",
                                                    "bucket.width",
                                                    "bucket.cylinder.bore",
                                                    "bucket.cylinder.rod",
                                                    "bucket.cylinder.closed_length",
                                                    "bucket.cylinder.stroke",
                                                    "bucket.cylinder.base",
                                                    "bucket.linkage.rocker_pivot",
                                                    "bucket.linkage.rocker",
                                                    "bucket.linkage.coupler",
                                                    "bucket.linkage.lug",
                                                    "swing.speed_max",
                                                    "swing.range",
                                                    "pump[0].displacement",
                                                    "pump[0].speed",
                                                    "pump[0].relief",
                                                    "pump[0].rated_pressure",
                                                    "pump[1].displacement",
                                                    "pump[1].speed",
                                                    "pump[1].relief",
                                                    "pump[1].rated_pressure",
                                                    "valve.rated_pressure",
                                                    "valve.section_flow",
                                                    "safety.idle",
                                                    "sensors.pressure_range"};
const std::vector<const char*> kAskedOfDozer = {"body.mass_centre_height",
                                                "body.track_contact",
                                                "body.half_gauge",
                                                "blade.pivot",
                                                "blade.arm",
                                                "blade.cutting_edge",
                                                "blade.cylinder.bore",
                                                "blade.cylinder.rod",
                                                "blade.cylinder.base",
                                                "blade.cylinder.length_home",
                                                "blade.L11",
                                                "blade.range",
                                                "implement.pump.displacement",
                                                "implement.valve_flow_max",
                                                "hst.engine_speed",
                                                "hst.engine_range",
                                                "hst.pump_displacement",
                                                "hst.motor_displacement",
                                                "hst.sprocket_radius",
                                                "safety.idle"};

const std::map<std::string, WorkshopUnit> kUnits = {
    {"m", {"mm", 1e-3}},  {"rad", {"deg", kPi / 180.0}},  {"rad/s", {"rpm", kPi / 30.0}},
    {"Pa", {"bar", 1e5}}, {"m3/s", {"L/min", 1.0 / 6e4}}, {"m3/rev", {"cm3/rev", 1e-6}}};

std::vector<double> numbers_of(const toml::node& node) {
  std::vector<double> numbers;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& entry : *array) {
      numbers.push_back(entry.value<double>().value_or(0.0));
    }
  } else {
    numbers.push_back(node.value<double>().value_or(0.0));
  }
  return numbers;
}

std::optional<ProfileQuestion> question_of(const ProfileDocument& like,
                                           const std::vector<KeyEntry>& keys, const char* key) {
  const toml::node* node = like.root.at_path(key).node();
  const auto entry = std::find_if(keys.begin(), keys.end(),
                                  [&](const KeyEntry& other) { return other.key == key; });
  if (node == nullptr || entry == keys.end()) {
    return std::nullopt;
  }
  ProfileQuestion question{key, entry->help, kUnits.at(entry->unit), numbers_of(*node)};
  if (std::sscanf(entry->allowed.c_str(), "%lf .. %lf", &question.least, &question.most) != 2) {
    return std::nullopt;
  }
  question.least /= question.unit.si;
  question.most /= question.unit.si;
  for (double& number : question.before) {
    number /= question.unit.si;
  }
  return question;
}

/// Links of the new machine over those of the old one.
double reach_ratio(const ProfileDocument& like, const CommentedValues& told) {
  double before_m = 0.0;
  double after_m = 0.0;
  for (const char* axis : kAxisNames) {
    const std::string key = fmt::format("{}.length", axis);
    const double length_m = like.root.at_path(key).value_or(0.0);
    const auto found = told.find(key);
    before_m += length_m;
    after_m += found == told.end() ? length_m : found->second.numbers.front();
  }
  return after_m / before_m;
}

void scale_path(const ProfileDocument& like, CommentedValues& told) {
  const double ratio = reach_ratio(like, told);
  if (ratio == 1.0) {
    return;
  }
  for (const char* key : {"task.path.x", "task.path.y", "task.path.corner_radius"}) {
    std::vector<double> numbers = numbers_of(*like.root.at_path(key).node());
    for (double& number : numbers) {
      number *= ratio;
    }
    told[key] = {numbers,
                 {},
                 fmt::format("{}'s by the links' ratio, {:.3f}", like.file.stem().string(), ratio)};
  }
  const toml::array* corners = like.root.at_path("task.path.attitude").as_array();
  CommentedValue attitude{{}, {}, "at the path's ends"};
  for (std::size_t i = 0; corners != nullptr && i < corners->size(); ++i) {
    std::vector<double> pair = numbers_of(*corners->get(i));
    pair.front() *= ratio;
    attitude.rows.push_back(pair);
  }
  told["task.path.attitude"] = attitude;
}

/// What pins and strokes give; where they give none, the check of what is written says so.
void set_joint_ranges(const std::string& text, CommentedValues& told) {
  const toml::table root = toml::parse(text);
  TomlReader reader(root);
  const ExcavatorProfile profile = read_excavator_sections(reader);
  const auto ranges = joint_ranges(profile.geometry);
  for (unsigned i = 0; ranges && i < kAxisCount; ++i) {
    told[fmt::format("{}.angle", kAxisNames[i])] = {
        {(*ranges)[i][0], (*ranges)[i][1]}, {}, "what pins and strokes give"};
  }
}

double norm_of(const std::vector<double>& numbers) {
  double squares = 0.0;
  for (const double number : numbers) {
    squares += number * number;
  }
  return std::sqrt(squares);
}

}  // namespace

std::vector<ProfileQuestion> profile_questions(const ProfileDocument& like) {
  const std::vector<KeyEntry> keys = profile_keys(like);
  const bool is_dozer = profile_kind(like) == MachineKind::kDozer;
  std::vector<ProfileQuestion> questions;
  for (const char* key : is_dozer ? kAskedOfDozer : kAskedOfExcavator) {
    if (const auto question = question_of(like, keys, key)) {
      questions.push_back(*question);
    }
  }
  return questions;
}

void assert_fits(const ProfileDocument& like, const ProfileQuestion& question,
                 const std::vector<double>& numbers, const ProfileAnswers& answers) {
  // No machine is so much smaller than another, but a metre has 1000 mm.
  constexpr double kNoSuchRatio = 0.01;
  const double told = norm_of(numbers);
  if (question.unit.name == std::string_view("mm") && told > 0.0 &&
      told < kNoSuchRatio * norm_of(question.before)) {
    std::string text;
    for (const double number : numbers) {
      text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ", 1e3 * number);
    }
    throw std::runtime_error(fmt::format("in metres? then it is {} mm", text));
  }
  const std::string& key = question.key;
  const std::size_t rod = key.rfind(".rod");
  if (rod == std::string::npos || rod + 4 != key.size()) {
    return;
  }
  const std::string bore = key.substr(0, rod) + ".bore";
  const auto answer = answers.find(bore);
  const double bore_mm = answer != answers.end()
                             ? answer->second.front()
                             : like.root.at_path(bore).value_or(0.0) / question.unit.si;
  if (!(numbers.front() < bore_mm)) {
    throw std::runtime_error(fmt::format(
        "{:.6g} mm is no rod in a bore of {:.6g} mm; allowed: less", numbers.front(), bore_mm));
  }
}

std::string new_profile_text(const ProfileDocument& like, const std::string& name,
                             const ProfileAnswers& answers) {
  CommentedValues told;
  for (const ProfileQuestion& question : profile_questions(like)) {
    const auto answer = answers.find(question.key);
    if (answer == answers.end()) {
      continue;
    }
    CommentedValue value;
    for (const double number : answer->second) {
      value.numbers.push_back(number * question.unit.si);
      value.from += fmt::format("{}{:.6g}", value.from.empty() ? "told: " : ", ", number);
    }
    value.from += fmt::format(" {}", question.unit.name);
    told[question.key] = value;
  }
  const std::vector<KeyEntry> keys = profile_keys(like);
  const std::string like_name = like.file.stem().string();
  // It says every value itself, and the other file need not be beside it.
  toml::table root = like.root;
  root.erase("like");
  const auto text = [&] {
    return fmt::format(
               "# {}: made by `graben new-machine` after {}. A value marked 'as {}' was not asked "
               "for\n# or not told: check it before anything moves. SI units; frames as in the "
               "reference of all keys.\n\n",
               name, like_name, like_name) +
           commented_toml(root, keys, told, "as " + like_name);
  };
  if (profile_kind(like) == MachineKind::kExcavator) {
    scale_path(like, told);
    set_joint_ranges(text(), told);
  }
  return text();
}

}  // namespace graben::machines
