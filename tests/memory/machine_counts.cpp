// SPDX-License-Identifier: Apache-2.0
#include "tests/memory/machine_counts.hpp"

#include <algorithm>
#include <cstdio>

#include "firmware/mcv/optimiser.hpp"
#include "firmware/mcv/tuning.hpp"

namespace graben::memory {
namespace {

struct ExcavatorCounts {
  int drives = 0;
  int pumps = 0;
  int regulated_pumps = 0;
  int fences = 0;
  int keep_outs = 0;
  int link_imus = 0;
  SolveSteps steps = {kSearchSteps, kHalvingSteps, kLeastSteps};
};

void write(const char* name, const ExcavatorCounts& counts) {
  std::printf("\n[%s]\ndrives = %d\npumps = %d\nregulated_pumps = %d\n", name, counts.drives,
              counts.pumps, counts.regulated_pumps);
  std::printf("fences = %d\nkeep_outs = %d\nlink_imus = %d\n", counts.fences, counts.keep_outs,
              counts.link_imus);
  std::printf("solve_steps = %d\ncycle_steps = %d\n", counts.steps.all(),
              counts.steps.all() + counts.steps.least);
  // A bus that is not ours is a process's (app/ecu): no image has a table.
  std::printf("tables = 0\n");
}

void write_dozer(const char* name, int drives, int wheels) {
  std::printf("\n[%s]\ndrives = %d\nwheels = %d\n", name, drives, wheels);
}

int kept_out_of(const FenceSet& fences) {
  return static_cast<int>(std::count_if(fences.fence.begin(), fences.fence.begin() + fences.count,
                                        [](const Fence& fence) { return !fence.is_plane(); }));
}

int regulated_of(const McvMachine& valve) {
  return static_cast<int>(
      std::count_if(valve.pump.begin(), valve.pump.begin() + valve.pump_count,
                    [](const McvPump& one) { return one.regulator.sets_swash(); }));
}

}  // namespace

void write_most(const ExcavatorSetup& setup) {
  write("any", {static_cast<int>(setup.bank.row.size()), kPumpCount, kPumpCount, kFenceMost,
                kFenceMost, static_cast<int>(setup.profile.imu.mount.size())});
}

void write_most(const DozerSetup& setup) {
  write_dozer("any", static_cast<int>(setup.bank.row.size()), kMostWheels);
}

void write_counts(const char* name, const ExcavatorSetup& setup) {
  ExcavatorCounts counts{setup.bank.count,
                         setup.valve.pump_count,
                         regulated_of(setup.valve),
                         0,
                         0,
                         0,
                         solve_steps(setup.valve, setup.profile.control.lambda_policy)};
  for (int i = 0; i < setup.book.count; ++i) {
    const FenceSet& fences = setup.book.program[static_cast<unsigned>(i)].fences;
    counts.fences = std::max(counts.fences, fences.count);
    counts.keep_outs = std::max(counts.keep_outs, kept_out_of(fences));
  }
  const auto& mounts = setup.profile.imu.mount;
  counts.link_imus = static_cast<int>(std::count_if(
      mounts.begin(), mounts.end(), [](const auto& mount) { return mount.address != 0; }));
  write(name, counts);
}

void write_counts(const char* name, const DozerSetup& setup) {
  write_dozer(name, setup.bank.count, setup.profile.body.wheels);
}

}  // namespace graben::memory
