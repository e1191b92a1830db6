// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <list>

#include "tests/faults/row.hpp"
#include "tests/timing/counts/play.hpp"
#include "tests/timing/counts/recording_port.hpp"

namespace graben::timing {
namespace {

/// A trace for each controller that a row starts.
// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): final, and nobody deletes through it.
class Witness final : public faults::EcuWitness {
 public:
  [[nodiscard]] CanPort& port_of(LoopbackPort& port) override {
    seen_.emplace_back(port);
    return seen_.back().recorder;
  }
  void note_cycle(const LoopbackPort& port, TimeUs now_us, EcuMode mode) override {
    const auto last = std::find_if(seen_.rbegin(), seen_.rend(),
                                   [&](const Seen& seen) { return seen.port == &port; });
    last->cycles.push_back(last->recorder.take());
    last->cycles.back().now_us = now_us;
    last->cycles.back().mode = static_cast<std::uint8_t>(mode);
  }

  /// Of the controller that ran longest, `most` at most; none if the row runs none.
  [[nodiscard]] std::vector<TraceCycle> cycles(int most) const {
    const auto longest = std::max_element(
        seen_.begin(), seen_.end(),
        [](const Seen& a, const Seen& b) { return a.cycles.size() < b.cycles.size(); });
    if (longest == seen_.end()) {
      return {};
    }
    const auto count = std::min(longest->cycles.size(), static_cast<std::size_t>(most));
    return {longest->cycles.begin(), longest->cycles.begin() + static_cast<long>(count)};
  }

 private:
  struct Seen {
    explicit Seen(LoopbackPort& of) : port(&of), recorder(of) {}
    const LoopbackPort* port;
    RecordingPort recorder;
    std::vector<TraceCycle> cycles;
  };
  std::list<Seen> seen_;
};

template <class Kind>
Played play_kind(const Script& script) {
  Witness witness;
  faults::Trial<Kind>::witness = &witness;
  std::uint32_t hash = 0;
  for (const faults::Row<Kind>& row : faults::all_rows<Kind>()) {
    if (row.number == *script.row && row.run != nullptr) {
      faults::Trial<Kind> trial(script.seed, row.number);
      hash = trial.rig->machine.hash;
      // What the row finds wrong is for fault_cases to say.
      row.run(trial);
    }
  }
  faults::Trial<Kind>::witness = nullptr;
  Played played;
  played.cycles = witness.cycles(script.cycles);
  played.start = {script.setup, hash, static_cast<std::uint32_t>(played.cycles.size())};
  return played;
}

}  // namespace

Played play_row(const Script& script) {
  return script.setup == Setup::kDozer ? play_kind<faults::Dozer>(script)
                                       : play_kind<faults::Excavator>(script);
}

}  // namespace graben::timing
