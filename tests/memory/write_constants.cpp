// SPDX-License-Identifier: Apache-2.0
/// write_constants setup|replay|counts excavator|dozer: of a shipped machine what its controller is
/// made of, or what a controller hears and says in a run of its simulation, as a C++ source of
/// constant data; or how many it has of what a loop of the controller goes over, and how many any
/// machine of its kind may have, as TOML (tests/bound/machine.py).

#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <utility>

#include "app/machines/task_file.hpp"
#include "app/runs/dozer_rig.hpp"
#include "app/runs/excavator_rig.hpp"
#include "tests/memory/machine_counts.hpp"
#include "tests/memory/setup.hpp"

namespace {

using namespace graben;

/// The longest that is told: it arms, begins, and is in full motion.
constexpr int kCycles = 400;

/// What lies between members is another at every run: GCC 12's __builtin_clear_padding also clears
/// bytes that do not.
template <class Setup>
void write_setup(const char* type, const Setup& setup, std::uint32_t profile_hash) {
  std::printf("#include \"tests/memory/setup.hpp\"\n\nnamespace graben::memory {\nnamespace {\n\n");
  std::printf("static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);\n");
  std::printf("static_assert(same(kLayout<%s>, {", type);
  for (const std::size_t size : memory::kLayout<Setup>) {
    std::printf("%zu, ", size);
  }
  std::printf("}),\n    \"not laid out as where it was written\");\n\n");
  std::printf("constexpr SetupBytes<%s> kBytes = {{", type);
  static_assert(sizeof(Setup) % sizeof(std::uint64_t) == 0);
  for (std::size_t at = 0; at < sizeof(Setup); at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, reinterpret_cast<const char*>(&setup) + at, sizeof word);
    std::printf("%s0x%llx,", at % 64 == 0 ? "\n    " : " ", static_cast<unsigned long long>(word));
  }
  std::printf("\n}};\n\n}  // namespace\n\ntemplate <>\n");
  std::printf("HeldSetup<%s> held_setup<%s>() {\n", type, type);
  std::printf("  return {kBytes.setup, 0x%xU};\n}\n\n}\n", static_cast<unsigned>(profile_hash));
}

template <class Bench>
void write_replay(Bench& bench) {
  std::printf("#include \"tests/memory/setup.hpp\"\n\nnamespace graben::memory {\nnamespace {\n\n");
  std::printf("constexpr ReplayFrame kFrames[] = {\n");
  int cycle = 0;
  bench.bus.set_fault_hook([&](CanFrame& frame, const LoopbackPort* from) {
    std::printf("    {%d, %s, %d, 0x%x, {", cycle, from == &bench.ecu_port ? "true" : "false",
                frame.length, static_cast<unsigned>(frame.id));
    for (const std::uint8_t byte : frame.data) {
      std::printf("%d, ", byte);
    }
    std::printf("}},\n");
    return true;
  });
  for (; cycle < kCycles; ++cycle) {
    bench.step(cycle * Bench::kPeriod_us);
  }
  std::printf("};\n\n}  // namespace\n\nReplay replay() {\n");
  std::printf("  return {kFrames, sizeof kFrames / sizeof kFrames[0], %d};\n}\n\n}\n", cycle);
}

machines::SimulatedExcavator of_12t() {
  return machines::load_simulated_excavator(machines::find_profile("excavator_12t"));
}

TaskBook tasks_of_12t(const ExcavatorProfile& profile) {
  return machines::load_tasks({machines::find_task("truck_by_steps").string(),
                               machines::find_task("flatten").string()},
                              {}, profile)
      .book;
}

void write_excavator(const std::string& what) {
  const auto machine = of_12t();
  const TaskBook book = tasks_of_12t(machine.profile);
  if (what == "replay") {
    runs::AutodigRig bench(machine, book, book.program[0].start, 1.0);
    write_replay(bench);
  } else if (what == "setup") {
    write_setup("ExcavatorSetup", ExcavatorSetup(machine.profile, book), machine.hash);
  } else {
    const auto other = machines::load_excavator(machines::find_profile("excavator_22t"));
    memory::write_most(ExcavatorSetup(machine.profile));
    memory::write_counts("12t", ExcavatorSetup(machine.profile, book));
    memory::write_counts("22t", ExcavatorSetup(other.profile));
  }
}

void write_dozer(const std::string& what) {
  const auto machine = machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  if (what == "replay") {
    runs::GradeRig bench(machine, 1.0);
    write_replay(bench);
  } else if (what == "setup") {
    write_setup("DozerSetup", DozerSetup(machine.profile), machine.hash);
  } else {
    memory::write_most(DozerSetup(machine.profile));
    memory::write_counts("dozer", DozerSetup(machine.profile));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string what = argc == 3 ? argv[1] : "";
  const std::string kind = argc == 3 ? argv[2] : "";
  if ((what != "setup" && what != "replay" && what != "counts") ||
      (kind != "excavator" && kind != "dozer")) {
    std::fprintf(stderr, "usage: write_constants setup|replay|counts excavator|dozer\n");
    return 2;
  }
  std::printf("%s Written by write_constants.\n", what == "counts" ? "#" : "//");
  (kind == "excavator" ? write_excavator : write_dozer)(what);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "write_constants: %s\n", error.what());
  return 1;
}
