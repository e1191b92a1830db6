// SPDX-License-Identifier: Apache-2.0
#include "app/scope/sim/sim_wish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace graben::scope {
namespace {

using nlohmann::json;
using Do = SimWish::Do;

/// A message's keys beside `do`.
struct Form {
  const char* name;
  Do what;
  bool has_value;
  bool has_id;
};
constexpr std::array<Form, 9> kForms{{{"run", Do::kRun, false, false},
                                      {"stop", Do::kStop, false, false},
                                      {"restart", Do::kRestart, false, false},
                                      {"clear", Do::kClear, false, false},
                                      {"pace", Do::kPace, true, false},
                                      {"speed", Do::kSpeed, true, false},
                                      {"soil", Do::kSoil, true, false},
                                      {"obstacle", Do::kObstacle, true, false},
                                      {"fault", Do::kFault, true, true}}};

/// What is shown of something that may be anything.
std::string shown(const json& value) {
  constexpr std::size_t kMost = 40;
  const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

/// Why not, or nothing.
std::string wrong_keys(const json& message, const Form& form) {
  for (const auto& [key, value] : message.items()) {
    const bool known =
        key == "do" || (key == "value" && form.has_value) || (key == "id" && form.has_id);
    if (!known) {
      return fmt::format("{}: no such key: {}", form.name, shown(key));
    }
  }
  if (form.has_value && !message.contains("value")) {
    return fmt::format("{}: 'value' is missing", form.name);
  }
  if (form.has_id && !message.contains("id")) {
    return fmt::format("{}: 'id' is missing", form.name);
  }
  return {};
}

std::string read_number(const json& value, const Form& form, double least, double most,
                        SimWish& wish) {
  // Written so that what is not a number fails.
  if (!value.is_number() || !(value.get<double>() >= least && value.get<double>() <= most)) {
    return fmt::format("{}: {}; allowed: {} .. {}", form.name, shown(value), least, most);
  }
  wish.value = value.get<double>();
  return {};
}

std::string read_switch(const json& value, const Form& form, SimWish& wish) {
  if (!value.is_boolean()) {
    return fmt::format("{}: {}; allowed: true, false", form.name, shown(value));
  }
  wish.on = value.get<bool>();
  return {};
}

std::string read_fault(const json& id, const std::vector<SimFault>& faults, SimWish& wish) {
  const auto found = std::find_if(faults.begin(), faults.end(), [&id](const SimFault& fault) {
    return id.is_string() && id.get_ref<const std::string&>() == fault.id;
  });
  if (found == faults.end()) {
    return fmt::format("fault: {}; allowed: an id of the setup's list of faults", shown(id));
  }
  wish.fault = static_cast<std::size_t>(std::distance(faults.begin(), found));
  return {};
}

/// Of what `form` has beside its name.
std::string read_rest(const json& message, const Form& form, const std::vector<SimFault>& faults,
                      bool has_ground, SimWish& wish) {
  switch (form.what) {
    case Do::kPace:
      return read_number(message["value"], form, kPaceLeast, kPaceMost, wish);
    case Do::kSpeed:
      return read_number(message["value"], form, kSpeedLeast, kSpeedMost, wish);
    case Do::kSoil:
    case Do::kObstacle:
      return has_ground ? read_switch(message["value"], form, wish)
                        : fmt::format("{}: not of this simulation", form.name);
    case Do::kFault: {
      const std::string why = read_fault(message["id"], faults, wish);
      return why.empty() ? read_switch(message["value"], form, wish) : why;
    }
    case Do::kRun:
    case Do::kStop:
    case Do::kRestart:
    case Do::kClear:
      break;
  }
  return {};
}

}  // namespace

std::variant<SimWish, std::string> read_wish(const json& message,
                                             const std::vector<SimFault>& faults, bool has_ground) {
  const json name = message.is_object() ? message.value("do", json()) : json();
  const auto* const form = std::find_if(kForms.begin(), kForms.end(), [&name](const Form& one) {
    return name.is_string() && name.get_ref<const std::string&>() == one.name;
  });
  if (form == kForms.end()) {
    return fmt::format(
        "{}; allowed: an object whose 'do' is run, stop, restart, clear, pace, "
        "speed, soil, obstacle or fault",
        shown(message));
  }
  SimWish wish;
  wish.what = form->what;
  std::string why = wrong_keys(message, *form);
  if (why.empty()) {
    why = read_rest(message, *form, faults, has_ground, wish);
  }
  if (!why.empty()) {
    return why;
  }
  return wish;
}

}  // namespace graben::scope
