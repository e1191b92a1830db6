// SPDX-License-Identifier: Apache-2.0
// restart [SEEDS]: machines as found dig one loop, then again after a restart, with what was learnt
// and without. With it the loop may not be worse, and of all machines it has to be better; else
// status 1.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "tests/faults/excavator_kind.hpp"
#include "tests/faults/rig.hpp"

namespace graben::endurance {
namespace {

using faults::Excavator;
using faults::Rig;

constexpr int kSeeds = 6;
constexpr TimeUs kLoopUs = 25 * kSecondUs;
constexpr TimeUs kOnItsWayUs = 2 * kSecondUs;

struct Loop {
  double error_m = 0.0;  ///< The largest by the sensors, once it is on the path.
  LearntDrives learnt{};
  bool ended_well = false;
};

Loop dig(const Excavator::Scenery& scenery, const LearntDrives* learnt) {
  Rig<Excavator> rig(scenery, LoopbackBus::kQueueCapacity);
  Loop loop;
  if (learnt != nullptr && !rig.ecu->begin(*learnt)) {
    return loop;
  }
  rig.run(200 * kMillisecondUs);
  rig.ask(true, Task::kNone);
  rig.run(100 * kMillisecondUs);
  rig.ask(true, Task::kDig);
  rig.run(kOnItsWayUs);
  static_cast<void>(rig.run_until(kLoopUs, [&] {
    loop.error_m = std::max(loop.error_m, rig.outputs().status.path_error_m);
    return false;
  }));
  loop.ended_well = rig.mode() != EcuMode::kFault;
  loop.learnt = rig.ecu->learnt();
  return loop;
}

double mean(const std::vector<double>& all) {
  double sum = 0.0;
  for (const double one : all) {
    sum += one;
  }
  return sum / static_cast<double>(all.size());
}

int run(int seeds) {
  constexpr double kNoWorse_m = 0.003;
  std::vector<double> without_m;
  std::vector<double> with_m;
  int wrong = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Excavator::Scenery scenery =
        Excavator::found_scenery_of(static_cast<std::uint64_t>(seed), "");
    const Loop first = dig(scenery, nullptr);
    const Loop again = dig(scenery, &first.learnt);
    fmt::print("seed {}: {:.1f} mm, begun with what was learnt {:.1f} mm\n", seed,
               1e3 * first.error_m, 1e3 * again.error_m);
    without_m.push_back(first.error_m);
    with_m.push_back(again.error_m);
    const bool is_right = first.ended_well && again.ended_well &&
                          again.error_m <= first.error_m + kNoWorse_m && is_sound(first.learnt);
    wrong += is_right ? 0 : 1;
  }
  fmt::print("mean {:.1f} mm, with what was learnt {:.1f} mm; wrong: {}\n", 1e3 * mean(without_m),
             1e3 * mean(with_m), wrong);
  return wrong == 0 && mean(with_m) < mean(without_m) ? 0 : 1;
}

}  // namespace
}  // namespace graben::endurance

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : graben::endurance::kSeeds;
  if (argc > 2 || seeds < 1 || seeds > 1000) {
    fmt::print(stderr, "restart [SEEDS]: 1 to 1000 of them\n");
    return 2;
  }
  return graben::endurance::run(seeds);
}
