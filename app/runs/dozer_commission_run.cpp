// SPDX-License-Identifier: Apache-2.0
#include "app/runs/dozer_commission_run.hpp"

#include "app/commission/dozer_ear.hpp"
#include "app/runs/dozer_rig.hpp"

namespace graben::runs {
namespace {

plant::DozerHands confirmed(const commission::DozerOptions& options) {
  plant::DozerHands hands;
  for (std::size_t drive = 0; drive < 2; ++drive) {
    const commission::Window& window = options.blade.window[drive];
    if (options.blade.drives[drive]) {
      hands.window[drive] = StrokeWindow{window.least_m, window.most_m, window.most_mps};
    }
  }
  if (options.tracks) {
    hands.window[2] = StrokeWindow{options.way.least_m, options.way.most_m, options.way.most_mps};
  }
  return hands;
}

}  // namespace

CommissionResult run_dozer_commission(const machines::SimulatedDozer& machine,
                                      const commission::DozerOptions& options,
                                      const std::filesystem::path& log_file, const TakeFrame& take,
                                      const Progress& progress) {
  DozerRig rig(machine, machine.profile, {}, Task::kCommission, 1.0);
  LoopbackPort& port = rig.bus.attach();
  static_cast<void>(port.open());
  commission::DozerEar ear;
  commission::DozerSequence sequence(options);
  plant::DozerHands hands = confirmed(options);
  const auto try_next = [&](TimeUs now_us) {
    plant::receive_frames(port, [&](const CanFrame& frame) { ear.hear(frame, now_us); });
    sequence.step(seconds(now_us), ear.seen());
    hands.tried = sequence.tried();
    rig.driver.set_tries(hands);
  };
  return lead_commission(
      rig, sequence, log_file, take, try_next, sequence.texts().size(),
      [&sequence](std::size_t at) { return sequence.texts()[at]; }, progress);
}

}  // namespace graben::runs
