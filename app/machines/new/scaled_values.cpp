// SPDX-License-Identifier: Apache-2.0
#include "app/machines/new/scaled_values.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "app/machines/axis_names.hpp"
#include "app/machines/new/data_sheet.hpp"

namespace graben::machines {
namespace {

std::vector<double> numbers_at(const ProfileDocument& document, const std::string& key) {
  std::vector<double> numbers;
  const toml::node* node = document.root.at_path(key).node();
  if (node == nullptr) {
    return numbers;
  }
  if (const toml::array* array = node->as_array()) {
    for (const toml::node& entry : *array) {
      numbers.push_back(entry.value_or(0.0));
    }
  } else {
    numbers.push_back(node->value_or(0.0));
  }
  return numbers;
}

/// What is told over what was, of a key with one number; 1 where it is neither.
double ratio_of(const ProfileDocument& like, const CommentedValues& told, const std::string& key) {
  const auto found = told.find(key);
  const double before = like.root.at_path(key).value_or(0.0);
  return found == told.end() || before == 0.0 ? 1.0 : found->second.numbers.front() / before;
}

double number_of(const ProfileDocument& like, const CommentedValues& told, const std::string& key) {
  return like.root.at_path(key).value_or(0.0) * ratio_of(like, told, key);
}

/// Adds keys times their factors.
class Scaler {
 public:
  Scaler(const ProfileDocument& document, CommentedValues& told)
      : document_(document), told_(told) {}

  void all(double factor, const char* what, std::initializer_list<const char*> keys) {
    for (const char* key : keys) {
      by(factor, what, std::string(key));
    }
  }
  void by(double factor, const char* what, const std::string& key) {
    const std::vector<double> numbers = numbers_at(document_, key);
    each(std::vector<double>(numbers.size(), factor), what, key);
  }
  /// Of a key with as many numbers.
  template <class Factors>
  void each(const Factors& factors, const char* what, const std::string& key) {
    std::vector<double> numbers = numbers_at(document_, key);
    bool changes = false;
    for (std::size_t i = 0; i < numbers.size() && i < factors.size(); ++i) {
      changes = changes || std::abs(factors[i] - 1.0) > 1e-9;
      numbers[i] *= factors[i];
    }
    if (changes && told_.count(key) == 0) {
      told_[key] = {numbers, {}, fmt::format("{}'s, {}", document_.file.stem().string(), what)};
    }
  }

 private:
  const ProfileDocument& document_;
  CommentedValues& told_;
};

constexpr const char* kByWeight = "by the weight";
constexpr const char* kByInertia = "by weight and squared size";
constexpr const char* kBySize = "by the links";
constexpr const char* kByFlow = "by the flow";
constexpr const char* kByAreas = "by the pistons' areas";

void scale_dozer(const ProfileDocument& like, const Ratios& ratios, CommentedValues& told) {
  Scaler scaler(like, told);
  scaler.all(ratios.weight, kByWeight,
             {"body.suspension.stiffness", "body.suspension.damping", "travel.push_max"});
  scaler.all(ratios.weight * ratios.size * ratios.size, kByInertia, {"body.pitch_inertia"});
  scaler.all(ratios.width, "by the blade's width", {"tilt.edge_width"});
}

void scale_links(const ProfileDocument& like, const Ratios& ratios, CommentedValues& told) {
  Scaler scaler(like, told);
  scaler.all(ratios.weight, kByWeight, {"oil.mass"});
  scaler.all(ratios.weight * ratios.size * ratios.size, kByInertia,
             {"oil.inertia", "swing.inertia"});
  scaler.each(ratios.swept, "by what the pistons sweep", "oil.dead_volume");
  for (unsigned i = 0; i < kAxisCount; ++i) {
    scaler.by(ratios.link[i], kBySize, fmt::format("oil.mass_centre.{}", kAxisNames[i]));
  }
  scaler.all(ratios.link[0], kBySize, {"boom.bend"});
  scaler.all(ratios.link[2], kBySize, {"bucket.floor"});
  scaler.all(ratios.width * ratios.link[2] * ratios.link[2], "by width and length",
             {"bucket.capacity"});
  scaler.all(ratios.size, kBySize,
             {"boom.radius", "arm.radius", "body.counterweight.radius", "body.counterweight.width",
              "body.counterweight.corner", "body.counterweight.height"});
}

void scale_valve(const ProfileDocument& like, const Ratios& ratios, CommentedValues& told) {
  Scaler scaler(like, told);
  scaler.all(ratios.section, kByFlow, {"valve.boom", "valve.arm", "valve.bucket", "valve.swing"});
  scaler.all(ratios.flow, kByFlow, {"valve.bypass.open"});
  scaler.all(ratios.turn, kByFlow, {"swing.displacement"});
  for (const char* drive : kDriveNames) {
    scaler.by(ratios.section, kByFlow, fmt::format("valve.bypass.closed.{}", drive));
    for (const char* which : {"c_drain", "c_check"}) {
      scaler.by(ratios.section, kByFlow, fmt::format("valve.regeneration.{}.{}", drive, which));
    }
  }
  const toml::array* pumps = like.root["pump"].as_array();
  for (std::size_t j = 0; pumps != nullptr && j < pumps->size(); ++j) {
    const std::string at = fmt::format("pump[{}].", j);
    const double displacement = ratio_of(like, told, at + "displacement");
    for (const char* key : {"leak_linear", "leak_quadratic"}) {
      scaler.by(displacement, "by its displacement", at + key);
    }
    scaler.by(displacement * ratio_of(like, told, at + "speed"), kByFlow, at + "bypass_series");
  }
  scaler.all(ratios.power, "by flow and relief", {"task.pump_power"});
  scaler.all(ratios.area[0], kByAreas, {"control.lambda_rise_reserve"});
}

}  // namespace

Ratios ratios_of(const ProfileDocument& like, const ProfileAnswers& answers,
                 const CommentedValues& told) {
  Ratios ratios;
  const bool is_dozer = profile_kind(like) == MachineKind::kDozer;
  double before_m = 0.0;
  double after_m = 0.0;
  for (unsigned i = 0; i < kAxisCount && !is_dozer; ++i) {
    const std::string axis = kAxisNames[i];
    before_m += number_of(like, {}, axis + ".length");
    after_m += number_of(like, told, axis + ".length");
    ratios.link[i] = ratio_of(like, told, axis + ".length");
    const double bore = ratio_of(like, told, axis + ".cylinder.bore");
    ratios.area[i] = bore * bore;
    ratios.swept[i] = ratios.area[i] * ratio_of(like, told, axis + ".cylinder.stroke");
  }
  ratios.size = is_dozer ? ratio_of(like, told, "body.track_contact") : after_m / before_m;
  const auto weight = answers.find(kWeightKey);
  ratios.weight = weight != answers.end()
                      ? weight->second.front() / sheet_questions(like).front().before.front()
                      : std::pow(ratios.size, 3.0);
  const double bore = ratio_of(like, told, "blade.cylinder.bore");
  ratios.area[0] = is_dozer ? bore * bore : ratios.area[0];
  ratios.width = is_dozer ? 1.0 : ratio_of(like, told, "bucket.width");
  if (const auto blade = answers.find(kBladeWidthKey); blade != answers.end()) {
    ratios.width = blade->second.front() / sheet_questions(like)[1].before.front();
  } else if (is_dozer) {
    ratios.width = ratios.size;
  }
  const toml::array* pumps = like.root["pump"].as_array();
  double flow = 0.0;
  double flow_before = 0.0;
  double power = 0.0;
  double power_before = 0.0;
  for (std::size_t j = 0; pumps != nullptr && j < pumps->size(); ++j) {
    const std::string at = fmt::format("pump[{}].", j);
    const double was = number_of(like, {}, at + "displacement") * number_of(like, {}, at + "speed");
    const double is =
        number_of(like, told, at + "displacement") * number_of(like, told, at + "speed");
    flow_before += was;
    flow += is;
    power_before += was * number_of(like, {}, at + "relief");
    power += is * number_of(like, told, at + "relief");
  }
  ratios.flow = flow_before > 0.0 ? flow / flow_before : 1.0;
  ratios.power = power_before > 0.0 ? power / power_before : 1.0;
  ratios.section = ratio_of(like, told, "valve.section_flow");
  ratios.turn = ratios.section / ratio_of(like, told, "swing.speed_max");
  return ratios;
}

void scale_profile(const ProfileDocument& like, const Ratios& ratios, CommentedValues& told) {
  if (profile_kind(like) == MachineKind::kDozer) {
    scale_dozer(like, ratios, told);
    return;
  }
  scale_links(like, ratios, told);
  scale_valve(like, ratios, told);
  scale_path(like, "task.path", ratios.size, told);
}

void scale_simulation(const ProfileDocument& simulation, const Ratios& ratios,
                      CommentedValues& told) {
  Scaler scaler(simulation, told);
  const double inertia = ratios.weight * ratios.size * ratios.size;
  if (profile_kind(simulation) == MachineKind::kDozer) {
    scaler.all(ratios.weight, kByWeight, {"blade.mass", "engine.power", "tilt.inertia"});
    scaler.all(ratios.size, "by the track contact", {"blade.reach", "blade.height"});
    scaler.all(ratios.width, "by the blade's width", {"blade.width"});
    scaler.all(ratios.area[0], kByAreas,
               {"implement.coulomb", "implement.viscous", "implement.dead_volume"});
    scaler.all(inertia, kByInertia, {"hst.inertia"});
    return;
  }
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const std::string axis = kAxisNames[i];
    scaler.by(ratios.weight, kByWeight, axis + ".mass");
    scaler.by(inertia, kByInertia, axis + ".inertia");
    scaler.by(ratios.link[i], kBySize, axis + ".mass_centre");
  }
  scaler.all(ratios.width, "as told", {"bucket.width"});
  scaler.all(ratios.width * ratios.link[2] * ratios.link[2], "by width and length",
             {"bucket.capacity"});
  scaler.each(ratios.area, kByAreas, "friction.coulomb");
  scaler.each(ratios.area, kByAreas, "friction.viscous");
  scaler.each(ratios.swept, "by what the pistons sweep", "valve.dead_volume");
  scaler.all(inertia, kByInertia, {"swing.inertia"});
  scaler.all(ratios.turn, kByFlow,
             {"swing.coulomb", "swing.viscous", "swing.dead_volume", "swing.leak"});
  scaler.all(ratios.weight, kByWeight, {"experiment.soil.bias", "experiment.air.payload"});
  scaler.all(
      ratios.size, kBySize,
      {"experiment.soil.ground", "experiment.line.from.position", "experiment.line.to.position"});
  scaler.all(ratios.link[2], kBySize, {"experiment.air.payload_centre"});
  const std::array<double, 3> start = {ratios.size, ratios.size, 1.0};
  scaler.each(start, kBySize, "experiment.air.start");
  scale_path(simulation, "experiment.air.path", ratios.size, told);
}

void scale_path(const ProfileDocument& document, const std::string& at, double ratio,
                CommentedValues& told) {
  if (std::abs(ratio - 1.0) < 1e-9) {
    return;
  }
  Scaler scaler(document, told);
  const std::string what = fmt::format("by the links' ratio, {:.3f}", ratio);
  for (const char* key : {".x", ".y", ".corner_radius"}) {
    scaler.by(ratio, what.c_str(), at + key);
  }
  const toml::array* corners = document.root.at_path(at + ".attitude").as_array();
  CommentedValue attitude{{}, {}, "at the path's ends"};
  for (std::size_t i = 0; corners != nullptr && i < corners->size(); ++i) {
    const toml::array& pair = *corners->get(i)->as_array();
    attitude.rows.push_back({pair.get(0)->value_or(0.0) * ratio, pair.get(1)->value_or(0.0)});
  }
  told[at + ".attitude"] = attitude;
}

}  // namespace graben::machines
