// SPDX-License-Identifier: Apache-2.0
#include "app/machines/task_file.hpp"

#include <fmt/format.h>

#include <exception>
#include <stdexcept>
#include <utility>

#include "app/machines/area_task.hpp"
#include "app/machines/design_section.hpp"
#include "app/machines/fence_tables.hpp"
#include "app/machines/profile_document.hpp"
#include "app/machines/step_tables.hpp"
#include "app/machines/task_text.hpp"

namespace graben::machines {
namespace {

/// The last fence is the design's, whatever it is.
void add_surface(const TaskDesign& design, TaskContent& content) {
  content.request.has_design = design.is_plane;
  content.request.design = design.plane;
  content.surface = design.surface;
  if (design.surface != nullptr) {
    FenceSet& fences = content.request.fences;
    fences.fence[static_cast<unsigned>(fences.count++)] = surface_fence(design.surface->surface);
  }
}

/// Without steps nothing is planned: what there is are the fences.
ProgramResult without_steps(const ProgramRequest& request) {
  ProgramResult result;
  result.refusal = ProgramRefusal::kNone;
  FenceSet& fences = result.program.fences;
  fences = request.fences;
  if (request.has_design) {
    fences.fence[static_cast<unsigned>(fences.count++)] = request.design.fence();
  }
  return result;
}

void read_fences(TomlReader& reader, bool has_design, ProgramRequest& request) {
  if (reader.has("fence")) {
    const bool one_less = has_design && !reader.lists();
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
  read_fences(reader, true, request);
  return request;
}

TaskContent read_step_task(TomlReader& reader, const ExcavatorProfile& profile,
                           const std::filesystem::path& folder) {
  TaskContent content;
  ProgramRequest& request = content.request;
  const bool has_design = reader.has("design");
  const bool digs = !has_design || reader.has("step") || reader.has("start");
  if (digs) {
    read_steps(reader, profile, request);
  }
  DesignPlaces places;
  places.folder = folder;
  places.has_site = reader.has("site");
  if (places.has_site) {
    content.site = read_site(reader);
    places.site = content.site->frame;
    places.by_touch = content.site->points.by_touch;
    if (places.by_touch && digs && !reader.lists()) {
      reader.fail("site",
                  "has neither touched nor heading: its points are touched at run time, and steps "
                  "are planned before; allowed: a design without steps, for task Assist");
    }
  }
  TaskDesign design;
  if (has_design) {
    design = read_task_design(reader, profile, places, digs);
    request.has_design = design.is_plane;
    request.design = design.plane;
  } else if (places.has_site) {
    reader.fail("site", "stands without a [design]; steps and fences are the machine's");
  }
  if (digs) {
    read_rounds(reader, request);
  }
  read_fences(reader, has_design, request);
  if (has_design) {
    add_surface(design, content);
  }
  return content;
}

void demand_steps(const TaskFile& task, const std::string& wanted_by) {
  if (!task.has_steps()) {
    throw std::runtime_error(fmt::format(
        "{}: has a design and no steps, as task Assist wants it; allowed for {}: a task with steps "
        "or an area",
        task.name, wanted_by));
  }
}

TaskFile load_task(const std::filesystem::path& file, const ExcavatorProfile& profile) {
  const ProfileDocument document = read_document(file);
  refuse_other_sort(document, kTaskSort);
  TomlReader reader(document.root);
  TaskFile task;
  task.name = file.stem().string();
  if (reader.has("area")) {
    task.request = read_area_task(reader, profile);
  } else {
    TaskContent content = read_step_task(reader, profile, file.parent_path());
    task.request = content.request;
    task.surface = std::move(content.surface);
    task.site = content.site;
  }
  reader.refuse_unknown_keys();
  throw_errors(document, reader);
  task.hash = reader.hash() ^ (task.surface != nullptr ? task.surface->hash : 0U);
  if (!task.has_steps()) {
    task.result = without_steps(task.request);
    return task;
  }
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

namespace {

/// The site of all of them into the book.
void join_site(const TaskFile& task, bool is_first, std::optional<SiteSection>& site,
               TaskBook& book) {
  const bool has_design = graben::has_design(task.result.program.fences);
  const bool by_touch = site && site->points.by_touch;
  const bool other = task.site && site && !task.site->is_like(*site);
  // A design of the machine's own frame does not move with one that has to be touched.
  const bool mixed =
      has_design && !is_first && (task.site ? task.site->points.by_touch && !site : by_touch);
  if (other || mixed) {
    throw std::runtime_error(fmt::format(
        "{}: its [site] is another one than that of a task before it; allowed: the same of all, "
        "for the machine stands in one place",
        task.name));
  }
  if (task.site) {
    site = task.site;
    book.site = site->points;
  }
}

}  // namespace

TaskShelf load_tasks(const std::vector<std::string>& names,
                     const std::vector<std::filesystem::path>& folders,
                     const ExcavatorProfile& profile) {
  if (names.size() > kTaskMost) {
    throw std::runtime_error(fmt::format("{} tasks; allowed: at most {}", names.size(), kTaskMost));
  }
  TaskShelf shelf;
  std::vector<std::string> errors;
  std::optional<SiteSection> site;
  bool has_design = false;
  for (const std::string& name : names) {
    try {
      TaskProgram& program = shelf.book.program[static_cast<unsigned>(shelf.book.count++)];
      TaskFile task = load_task(find_task(name, folders), profile);
      program = task.result.program;
      join_site(task, !has_design, site, shelf.book);
      has_design = has_design || graben::has_design(program.fences);
      shelf.surfaces.push_back(std::move(task.surface));
    } catch (const std::exception& error) {
      errors.emplace_back(error.what());
    }
  }
  if (!errors.empty()) {
    throw std::runtime_error(fmt::format("{}", fmt::join(errors, "\n")));
  }
  return shelf;
}

}  // namespace graben::machines
