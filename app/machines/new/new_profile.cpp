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
#include "app/machines/new/data_sheet.hpp"
#include "app/machines/new/profile_keys.hpp"
#include "app/machines/new/scaled_values.hpp"
#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/excavator_controller.hpp"

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
                                                    "bucket.capacity",
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
                                                "blade.range",
                                                "implement.pump.displacement",
                                                "implement.valve_flow_max",
                                                "hst.engine_speed",
                                                "hst.engine_range",
                                                "hst.pump_displacement",
                                                "hst.motor_displacement",
                                                "hst.gear_ratio",
                                                "hst.sprocket_radius",
                                                "safety.idle"};

const std::map<std::string, WorkshopUnit> kUnits = {{"m", {"mm", 1e-3}},
                                                    {"rad", {"deg", kPi / 180.0}},
                                                    {"rad/s", {"rpm", kPi / 30.0}},
                                                    {"Pa", {"bar", 1e5}},
                                                    {"m3/s", {"L/min", 1.0 / 6e4}},
                                                    {"m3/rev", {"cm3/rev", 1e-6}},
                                                    {"m3", {"m3", 1.0}},
                                                    {"", {"ratio", 1.0}}};

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

/// Pivot to cylinder base follows from both pins.
void set_blade_pins(const ProfileDocument& like, CommentedValues& told) {
  const auto of = [&](const char* key) {
    const auto found = told.find(key);
    return found == told.end() ? numbers_of(*like.root.at_path(key).node()) : found->second.numbers;
  };
  if (told.count("blade.pivot") == 0 && told.count("blade.cylinder.base") == 0) {
    return;
  }
  const std::vector<double> pivot_m = of("blade.pivot");
  const std::vector<double> base_m = of("blade.cylinder.base");
  told["blade.L11"] = {
      {std::hypot(base_m[0] - pivot_m[0], base_m[1] - pivot_m[1])}, {}, "what the pins give"};
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

/// A path that is scaled need not lie in the new machine's reach: it is made smaller about its
/// middle and shifted until it does; where nothing helps, the check of what is written says so.
void fit_path(const ProfileDocument& document, const std::string& at, ExcavatorProfile profile,
              const DigPath& path, CommentedValues& told) {
  const double boom_m = profile.geometry.boom_length_m;
  const auto fits = [&](const DigPath& tried) {
    profile.dig_path = tried;
    return profile_check(profile).path == ReachStatus::kOk;
  };
  if (fits(path)) {
    return;
  }
  const double middle_x_m = 0.5 * (path.x_min_m + path.x_max_m);
  const double middle_y_m = 0.5 * (path.y_min_m + path.y_max_m);
  for (const double size : {1.0, 0.85, 0.7, 0.55, 0.4}) {
    for (const double x : {0.0, -0.06, 0.06, -0.12, 0.12, -0.2}) {
      for (const double y : {0.0, 0.06, -0.06, 0.12, -0.12, 0.2}) {
        const double at_x_m = middle_x_m + x * boom_m;
        const double at_y_m = middle_y_m + y * boom_m;
        DigPath tried = path;
        tried.x_min_m = at_x_m + size * (path.x_min_m - middle_x_m);
        tried.x_max_m = at_x_m + size * (path.x_max_m - middle_x_m);
        tried.y_min_m = at_y_m + size * (path.y_min_m - middle_y_m);
        tried.y_max_m = at_y_m + size * (path.y_max_m - middle_y_m);
        tried.corner_radius_m = size * path.corner_radius_m;
        if (fits(tried)) {
          const std::string from =
              fmt::format("{}'s, brought into this machine's reach", document.file.stem().string());
          told[at + ".x"] = {{tried.x_min_m, tried.x_max_m}, {}, from};
          told[at + ".y"] = {{tried.y_min_m, tried.y_max_m}, {}, from};
          told[at + ".corner_radius"] = {{tried.corner_radius_m}, {}, from};
          told[at + ".attitude"] = {{},
                                    {{tried.x_min_m, path.attitude_at_x_min_rad},
                                     {tried.x_max_m, path.attitude_at_x_max_rad}},
                                    "at the path's ends"};
          return;
        }
      }
    }
  }
}

ExcavatorProfile profile_of(const std::string& text) {
  const toml::table root = toml::parse(text);
  TomlReader reader(root);
  return read_excavator_sections(reader);
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
  // Nor has any so much less pressure; but a MPa has 10 bar.
  constexpr double kNoSuchPressure = 0.2;
  if (question.unit.name == std::string_view("bar") && told > 0.0 &&
      told < kNoSuchPressure * norm_of(question.before)) {
    throw std::runtime_error(fmt::format("{:.6g} bar; in MPa? then it is {:.6g} bar",
                                         numbers.front(), 10.0 * numbers.front()));
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

namespace {

/// What was answered, in SI units.
CommentedValues told_by(const ProfileDocument& like, const ProfileAnswers& answers) {
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
  const auto weight = answers.find(kWeightKey);
  if (weight != answers.end() && like.root.at_path("body.mass").node() != nullptr) {
    const double weight_t = weight->second.front();
    told["body.mass"] = {{1e3 * weight_t}, {}, fmt::format("told: {:.6g} t", weight_t)};
  }
  return told;
}

std::string head(const std::string& name, const std::string& after) {
  return fmt::format(
      "# {}: made by `graben new-machine` after {}. A value marked 'as {}' was not asked "
      "for\n# or not told: check it before anything moves. SI units; frames as in the "
      "reference of all keys.\n\n",
      name, after, after);
}

}  // namespace

std::string new_profile_text(const ProfileDocument& like, const std::string& name,
                             const ProfileAnswers& answers) {
  const CommentedValues answered = told_by(like, answers);
  CommentedValues told = answered;
  const bool is_dozer = profile_kind(like) == MachineKind::kDozer;
  scale_profile(like, ratios_of(like, answers, answered), told);
  set_blade_pins(like, told);
  const std::vector<KeyEntry> keys = profile_keys(like);
  const std::string like_name = like.file.stem().string();
  // It says every value itself, and the other file need not be beside it.
  toml::table root = like.root;
  root.erase("like");
  const auto text = [&] {
    return head(name, like_name) + commented_toml(root, keys, told, "as " + like_name);
  };
  if (!is_dozer) {
    set_joint_ranges(text(), told);
    const ExcavatorProfile profile = profile_of(text());
    fit_path(like, "task.path", profile, profile.dig_path, told);
  }
  return text();
}

std::string new_simulation_text(const ProfileDocument& simulation, const ProfileDocument& like,
                                const std::string& name, const ProfileAnswers& answers,
                                const std::string& profile_text) {
  const CommentedValues answered = told_by(like, answers);
  CommentedValues told;
  const Ratios ratios = ratios_of(like, answers, answered);
  scale_simulation(simulation, ratios, told);
  const std::string like_name = like.file.stem().string();
  const auto text = [&] {
    return head(name, like_name) + commented_toml(simulation.root, {}, told, "as " + like_name);
  };
  if (profile_kind(like) == MachineKind::kExcavator) {
    const toml::table root = toml::parse(text());
    TomlReader reader(root);
    fit_path(simulation, "experiment.air.path", profile_of(profile_text),
             read_path(reader, "experiment.air.path"), told);
  }
  return text();
}

}  // namespace graben::machines
