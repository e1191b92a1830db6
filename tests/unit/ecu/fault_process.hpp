// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A controller's process as its store sees it, on a disk in memory.

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "app/ecu/store/fault_keeper.hpp"
#include "app/ecu/store/fault_recorder.hpp"
#include "app/ecu/store/stored_faults.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/ecu/memory_disk.hpp"

namespace graben::test::stored {

using namespace graben::ecu;
using graben::test::MemoryDisk;

inline constexpr TimeUs kCycleUs = 10 * kMillisecondUs;
inline constexpr TimeUs kWorkUs = 100 * kMillisecondUs;
inline constexpr std::uint32_t kProfile = 0xABCDEF01;
inline constexpr std::uint32_t kNoon_s = 1'800'000'000;
inline constexpr Fault kOne = Fault::kStrokeMissing;
inline constexpr Fault kOther = Fault::kSwashMissing;

inline std::string& said() {
  static std::string lines;
  return lines;
}

/// A controller's process on a disk: cycles, and the store's thread beside it, every 100 ms.
class Process {
 public:
  explicit Process(MemoryDisk& disk, std::uint32_t boot = 1, std::uint32_t profile = kProfile)
      : store_(disk, profile),
        keeper_(store_, *rings_, SampleKind::kExcavator, [](const char* line) { said() += line; }) {
    begin_text = keeper_.begin(now_us, boot);
  }

  void cycle() {
    sample.now_us = now_us;
    sample.stroke[0] = static_cast<float>(now_us) / 1e6F;
    sample.known = 1;
    recorder_.look(sample, faults);
    if (now_us % kWorkUs == 0) {
      keeper_.work(now_us, wall());
    }
    now_us += kCycleUs;
  }
  void run(double seconds) {
    repeat(std::lround(seconds * 100.0), [&] { cycle(); });
  }
  /// The store's thread alone; nothing comes.
  void idle(double seconds) {
    repeat(std::lround(seconds * 10.0), [&] {
      now_us += kWorkUs;
      keeper_.work(now_us, wall());
    });
  }
  void pulse(Fault fault, double seconds) {
    faults.add(fault);
    run(seconds);
    faults.remove(fault);
    run(seconds);
  }
  void end() { keeper_.finish(now_us, wall()); }
  [[nodiscard]] const FaultKeeper& keeper() const { return keeper_; }
  [[nodiscard]] FaultRings& rings() { return *rings_; }
  [[nodiscard]] FaultRecorder& recorder() { return recorder_; }

  CycleSample sample;
  FaultSet faults;
  TimeUs now_us = 0;
  bool clock_is_known = true;
  std::string begin_text;

 private:
  [[nodiscard]] std::uint32_t wall() const {
    return clock_is_known ? kNoon_s + static_cast<std::uint32_t>(now_us / kSecondUs) : 0;
  }

  Store store_;
  std::unique_ptr<FaultRings> rings_ = std::make_unique<FaultRings>();
  FaultKeeper keeper_;
  FaultRecorder recorder_{rings_.get()};
};

/// One that has been ready, as after power-on.
inline void make_ready(Process& process) {
  process.sample.mode = EcuMode::kReady;
  process.run(2.0);
}

inline StoredFaults stored(MemoryDisk& disk) { return read_stored_faults(disk); }

inline bool holds(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace graben::test::stored
