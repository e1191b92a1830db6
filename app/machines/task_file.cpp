// SPDX-License-Identifier: Apache-2.0
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
#include "app/machines/step_tables.hpp"
#include "app/machines/task_text.hpp"

namespace graben::machines {
namespace {

constexpr Range kPlace{-30.0, 30.0, "m"};
/// What the teeth may dip below their line while a drive breaks loose or lags, and some more.
constexpr double kLeastClearance_m = 0.03;

Eigen::Vector3d read_vector(TomlReader& reader, const std::string& key, const Range& range,
                            const char* help) {
  const std::vector<double> values = reader.numbers(key, range, 3, help);
  return {values[0], values[1], values[2]};
}

DesignPlane read_design(TomlReader& reader) {
  DesignPlane design;
  design.through_m =
      read_vector(reader, "design.through", kPlace, "a point of the design plane: x, y, z");
  design.up = read_direction(reader, "design.normal", 3, "upward normal of the plane: x, y, z");
  design.clearance_m = reader.number("design.clearance", {kLeastClearance_m, 1.0, "m"},
                                     "least distance of a dig's ends from the design");
  if (design.up.z() < kDesignUpLeast) {
    reader.fail("design.normal",
                fmt::format("must point up; its upward part is {:.3f} of its length; allowed: {} "
                            ".. 1",
                            design.up.z(), kDesignUpLeast));
  }
  return design;
}

void read_fences(TomlReader& reader, ProgramRequest& request) {
  if (reader.has("fence")) {
    const bool one_less = request.has_design && !reader.lists();
    const int most = one_less ? kFenceMost - 1 : kFenceMost;
    request.fences.count =
        reader.table_count("fence", 1, most, "fences, a table each; one less with a design");
  }
  for (int i = 0; i < request.fences.count; ++i) {
    request.fences.fence[static_cast<unsigned>(i)] =
        read_fence(reader, fmt::format("fence[{}]", i));
  }
}

}  // namespace

ProgramRequest read_area_task(TomlReader& reader, const ExcavatorProfile& profile) {
  ProgramRequest request = read_area(reader, profile);
  read_fences(reader, request);
  return request;
}

ProgramRequest read_step_task(TomlReader& reader, const ExcavatorProfile& profile) {
  ProgramRequest request;
  read_steps(reader, profile, request);
  request.has_design = reader.has("design");
  if (request.has_design) {
    request.design = read_design(reader);
  }
  read_rounds(reader, request);
  read_fences(reader, request);
  return request;
}

TaskFile load_task(const std::filesystem::path& file, const ExcavatorProfile& profile) {
  const ProfileDocument document = read_document(file);
  refuse_other_sort(document, kTaskSort);
  TomlReader reader(document.root);
  TaskFile task;
  task.name = file.stem().string();
  task.request =
      reader.has("area") ? read_area_task(reader, profile) : read_step_task(reader, profile);
  reader.refuse_unknown_keys();
  throw_errors(document, reader);
  task.hash = reader.hash();
  task.result = plan_program(profile, task.request);
  if (task.result.refusal != ProgramRefusal::kNone) {
    reader.fail(reader.has("area") ? "area" : fmt::format("step[{}]", task.result.step),
                program_refusal_words(profile, task.request, task.result));
  } else {
    refuse_unmet_planes(reader, task.request, task.result.program);
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
