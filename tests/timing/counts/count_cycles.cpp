// SPDX-License-Identifier: Apache-2.0
/// count_cycles TRACES [BURN]: replays every cycle of the traces through the controllers that they
/// are of, each a counted section: frames in, step, frames out. With BURN each section executes
/// about so many instructions more. Prints a line for each trace: how many cycles, and how many of
/// them ended in another mode than that in which they were recorded.
///
/// The same source on every target; what it counts is firmware, hal and the node between them.

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "app/ecu/dozer_kind.hpp"
#include "app/ecu/excavator_kind.hpp"
#include "tests/timing/counts/section.hpp"
#include "tests/timing/counts/setups.hpp"
#include "tests/timing/counts/trace.hpp"
#include "tests/timing/counts/trace_port.hpp"

namespace {

using namespace graben;
using namespace graben::timing;

/// Not on the stack: they are large, and bare metal has little.
TraceCycle cycle;
TracePort port;
std::optional<ecu::ExcavatorKind::Ecu> excavator;
std::optional<ecu::DozerKind::Ecu> dozer;

template <class Ecu, class Machine>
bool replay(std::FILE* file, std::optional<Ecu>& ecu, const Machine& machine,
            const TraceStart& start, std::uint32_t wasted) {
  unsigned other_mode = 0;
  ecu.emplace(machine, start.profile_hash, port);
  for (std::uint32_t n = 0; n < start.cycles; ++n) {
    if (!read(file, cycle)) {
      return false;
    }
    port.begin(cycle);
    graben_count_begin();
    ecu->step(cycle.now_us, 0);
    burn(wasted);
    graben_count_end();
    const auto mode = static_cast<std::uint8_t>(ecu->outputs().status.mode);
    other_mode += mode == cycle.mode ? 0U : 1U;
  }
  std::printf("%u %u\n", static_cast<unsigned>(start.cycles), other_mode);
  return true;
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) {
    std::fputs("count_cycles TRACES [BURN]\n", stderr);
    return 2;
  }
  std::FILE* const file = std::fopen(words[1], "rb");
  if (file == nullptr) {
    std::fprintf(stderr, "count_cycles: can't read %s\n", words[1]);
    return 1;
  }
  const auto wasted =
      count > 2 ? static_cast<std::uint32_t>(std::strtoul(words[2], nullptr, 10)) : 0U;
  TraceStart start;
  bool whole = true;
  while (whole && read(file, start)) {
    whole = is_dozer(start.setup)
                ? replay(file, dozer, dozer_setup(start.setup), start, wasted)
                : replay(file, excavator, excavator_setup(start.setup), start, wasted);
  }
  whole = whole && std::feof(file) != 0;
  std::fclose(file);
  return whole ? 0 : 1;
}
