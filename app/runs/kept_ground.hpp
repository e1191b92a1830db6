// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The as-built record of a simulated run's controller, kept as the deployed process keeps it.

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "app/ecu/ground/ground_keeper.hpp"
#include "app/ecu/store/folder_files.hpp"

namespace graben::runs {

class KeptGround {
 public:
  /// `setup` outlives it. Throws std::runtime_error where the folder can't be had, or where the
  /// profile does not say how wide the edge is.
  KeptGround(const std::string& folder, const ExcavatorSetup& setup, std::uint32_t profile_hash)
      : files_(folder),
        store_(files_, profile_hash),
        keeper_(store_, ring_, true, [](const char*) {}),
        feed_(ground::finder_of(setup), &ring_) {
    if (ground::edge_width_m(setup) <= 0.0) {
      throw std::runtime_error(
          "--store: the profile does not say how wide the edge is (bucket.width)");
    }
    if (!files_.open()) {
      throw std::runtime_error(fmt::format("--store: {}", files_.error()));
    }
    keeper_.begin(0);
  }

  /// After each cycle. No clock says a date: times count as the log's do.
  template <class Ecu>
  void look(const Ecu& ecu, TimeUs now_us) {
    feed_.look(ecu.inputs(), ecu.outputs(), now_us);
    now_us_ = now_us;
    if (now_us % (100 * kMillisecondUs) == 0) {
      keeper_.work(now_us, 0);
    }
  }
  /// After the last one. Throws where the disk did not take all of it.
  void finish() {
    keeper_.finish(now_us_, 0);
    if (keeper_.counters().failures > 0) {
      throw std::runtime_error(fmt::format("--store: {}", store_.error()));
    }
  }

 private:
  ecu::FolderFiles files_;
  ecu::Store store_;
  ground::EdgeRing ring_;
  ground::GroundKeeper keeper_;
  ground::EdgeFeed<ground::ExcavatorFinder> feed_;
  TimeUs now_us_ = 0;
};

}  // namespace graben::runs
