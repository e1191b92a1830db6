#include "app/machines/task_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "app/machines/area_task.hpp"
#include "app/machines/excavator_sections.hpp"
#include "app/machines/fence_tables.hpp"
#include "app/machines/profile_document.hpp"
#include "app/machines/task_text.hpp"

namespace graben::machines {
namespace {

constexpr Range kPlace{-30.0, 30.0, "m"};
/// A drive move without a pace of its own leaves half of the limits to the others on the pump.
constexpr double kUsualPace = 0.5;
/// What the teeth may dip below their line while a drive breaks loose or lags, and some more.
constexpr double kLeastClearance_m = 0.03;

Eigen::Vector3d read_vector(TomlReader& reader, const std::string& key, const Range& range,
                            const char* help) {
  const std::vector<double> values = reader.numbers(key, range, 3, help);
  return {values[0], values[1], values[2]};
}

enum class PathForm { kLine = 0, kDrives = 1 };

bool is_straight(TomlReader& reader, const std::string& at, StepKind kind) {
  const std::string key = at + ".path";
  if (!reader.has(key)) {
    return kind == StepKind::kDig || kind == StepKind::kLift;
  }
  return static_cast<PathForm>(reader.choice(
             key, {"line", "drives"},
             "way of the step: line of the teeth or move of the drives; dig and lift: line")) ==
         PathForm::kLine;
}

void read_line_pace(TomlReader& reader, const std::string& at, double usual_mps,
                    StepRequest& step) {
  if (reader.has(at + ".duration")) {
    step.duration_s = reader.number(at + ".duration", {0.1, 600.0, "s"},
                                    "duration of the step; on a line instead of speed");
    if (reader.has(at + ".speed")) {
      static_cast<void>(
          reader.number(at + ".speed", {0.01, 3.0, "m/s"}, "speed of the teeth on a line at most"));
      reader.fail(at, "has a speed and a duration; allowed: one of them");
    }
    return;
  }
  step.speed_mps = reader.number_or(usual_mps, at + ".speed", {0.01, 3.0, "m/s"},
                                    "speed of the teeth on a line at most");
}

void read_drive_pace(TomlReader& reader, const std::string& at, StepRequest& step) {
  step.pace_ratio = reader.number_or(kUsualPace, at + ".pace", {0.01, 1.0, ""},
                                     "share of the drives' limits on a move");
  step.duration_s = reader.number_or(0.0, at + ".duration", {0.1, 600.0, "s"},
                                     "duration of the step; on a line instead of speed");
}

StepRequest read_step(TomlReader& reader, const std::string& at, const ExcavatorProfile& profile) {
  constexpr std::array<StepKind, 5> kKinds = {StepKind::kDig, StepKind::kLift, StepKind::kSwing,
                                              StepKind::kDump, StepKind::kReturnToDig};
  std::vector<std::string> names;
  names.reserve(kKinds.size());
  for (const StepKind kind : kKinds) {
    names.emplace_back(step_name(kind));
  }
  StepRequest step;
  step.kind = kKinds[static_cast<unsigned>(reader.choice(at + ".do", names, "kind of step"))];
  step.to = read_teeth(reader, at + ".to");
  step.straight = is_straight(reader, at, step.kind);
  if (step.straight) {
    read_line_pace(reader, at, profile.dig_speed_mps, step);
  } else {
    read_drive_pace(reader, at, step);
  }
  return step;
}

DesignPlane read_design(TomlReader& reader) {
  constexpr double kLeastUp = 0.2;
  DesignPlane design;
  design.through_m =
      read_vector(reader, "design.through", kPlace, "a point of the design plane: x, y, z");
  design.up = read_direction(reader, "design.normal", 3, "upward normal of the plane: x, y, z");
  design.clearance_m = reader.number("design.clearance", {kLeastClearance_m, 1.0, "m"},
                                     "least distance of a dig's ends from the design");
  if (design.up.z() < kLeastUp) {
    reader.fail("design.normal",
                fmt::format("must point up; its upward part is {:.3f} of its length; allowed: {} "
                            ".. 1",
                            design.up.z(), kLeastUp));
  }
  return design;
}

void read_fences(TomlReader& reader, ProgramRequest& request) {
  if (reader.has("fence")) {
    const int most = request.has_design ? kFenceMost - 1 : kFenceMost;
    request.fences.count =
        reader.table_count("fence", 1, most, "fences, a table each; one less with a design");
  }
  for (int i = 0; i < request.fences.count; ++i) {
    request.fences.fence[static_cast<unsigned>(i)] =
        read_fence(reader, fmt::format("fence[{}]", i));
  }
}

ProgramRequest read_request(TomlReader& reader, const ExcavatorProfile& profile) {
  ProgramRequest request;
  if (reader.has("area")) {
    request = read_area(reader, profile);
    read_fences(reader, request);
    return request;
  }
  request.start = read_teeth(reader, "start");
  request.repeats =
      reader.boolean_or(false, "repeat", "starts again at its end, which has to be its start");
  request.step_count = reader.table_count("step", 1, kStepMost, "steps, a table each");
  for (int i = 0; i < request.step_count; ++i) {
    request.step[static_cast<unsigned>(i)] = read_step(reader, fmt::format("step[{}]", i), profile);
  }
  request.has_design = reader.has("design");
  if (request.has_design) {
    request.design = read_design(reader);
  }
  read_fences(reader, request);
  return request;
}

}  // namespace

TaskFile load_task(const std::filesystem::path& file, const ExcavatorProfile& profile) {
  const ProfileDocument document = read_document(file);
  TomlReader reader(document.root);
  TaskFile task;
  task.name = file.stem().string();
  task.request = read_request(reader, profile);
  reader.refuse_unknown_keys();
  throw_errors(document, reader);
  task.hash = reader.hash();
  task.result = plan_program(profile, task.request);
  if (task.result.refusal != ProgramRefusal::kNone) {
    reader.fail(fmt::format("step[{}]", task.result.step),
                program_refusal_words(profile, task.request, task.result));
  }
  throw_errors(document, reader);
  return task;
}

std::filesystem::path find_task(const std::string& name,
                                const std::vector<std::filesystem::path>& folders) {
  return find_file("task", name, folders);
}

TaskBook load_tasks(const std::vector<std::string>& names,
                    const std::vector<std::filesystem::path>& folders,
                    const ExcavatorProfile& profile) {
  if (names.size() > kTaskMost) {
    throw std::runtime_error(fmt::format("{} tasks; allowed: at most {}", names.size(), kTaskMost));
  }
  TaskBook book;
  std::vector<std::string> errors;
  for (const std::string& name : names) {
    try {
      TaskProgram& program = book.program[static_cast<unsigned>(book.count++)];
      program = load_task(find_task(name, folders), profile).result.program;
    } catch (const std::exception& error) {
      errors.emplace_back(error.what());
    }
  }
  if (!errors.empty()) {
    throw std::runtime_error(fmt::format("{}", fmt::join(errors, "\n")));
  }
  return book;
}

}  // namespace graben::machines
