// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The as-built record of a running controller. On the control thread the places of the edge are
/// handed over; on the store's thread they become ground, as `graben as-built` makes it of a log,
/// and tiles that have changed are written.
///
/// A write is a tile, 4096 bytes at most; each 10 s of operation bring one, and none is made while
/// nothing changes: 8640 or 35.4 MB a day at most. 16 more are for the end of the process. The tile
/// that has waited longest is the next. So a power cut loses the last 10 s of as many tiles as are
/// worked in, each tile as a whole or not at all.

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "app/ecu/ground/edge_finder.hpp"
#include "app/ecu/ground/ground_record.hpp"
#include "app/ecu/ground/ground_tiles.hpp"
#include "app/ecu/ground/work_sweeps.hpp"
#include "app/ecu/store/spsc_ring.hpp"
#include "app/ecu/store/store.hpp"
#include "app/ecu/store/store_thread.hpp"

namespace graben::ground {

struct EdgeSample {
  TimeUs now_us = 0;
  EdgePlace place;
};
/// 10 s of cycles: so long a disk may keep the store's thread.
using EdgeRing = ecu::SpscRing<EdgeSample, 1024>;

/// The handing half, on the control thread.
template <class Finder>
class EdgeFeed {
 public:
  /// Both outlive it. Null: no ground is kept.
  EdgeFeed(const Finder& finder, EdgeRing* ring) : finder_(finder), ring_(ring) {}

  template <class Inputs, class Outputs>
  void look(const Inputs& inputs, const Outputs& outputs, TimeUs now_us) {
    if (ring_ == nullptr) {
      return;
    }
    if (std::optional<EdgePlace> place = finder_.look(inputs, now_us)) {
      tell_force(outputs, *place);
      static_cast<void>(ring_->put({now_us, *place}));
    }
  }

 private:
  static void tell_force(const ExcavatorOutputs& outputs, EdgePlace& place) {
    const TipLoad& load = outputs.status.tip_load;
    place.level_n = load.known ? load.force_n.x() : 0.0;
    place.deviation_n = load.known ? load.force_sd_n : 0.0;
  }
  static void tell_force(const DozerOutputs& /*outputs*/, EdgePlace& /*place*/) {}

  Finder finder_;
  EdgeRing* ring_;
};

/// For the statistics.
struct GroundCounters {
  std::uint32_t tiles = 0;
  std::uint32_t writes = 0;
  std::uint32_t failures = 0;
  std::uint32_t lost = 0;  ///< Passes over cells without room, and places of the edge.
};

class GroundKeeper : public ecu::StoreWork {
 public:
  /// Says a line to whoever runs the process; must not allocate.
  using Say = void (*)(const char* line);

  /// Both outlive it. `by_force`: the edge was at work where work_sweeps.hpp says so; else where
  /// its places say it.
  GroundKeeper(ecu::Store& store, EdgeRing& ring, bool by_force, Say say)
      : store_(store), ring_(ring), by_force_(by_force), say_(say) {}

  /// Reads what there is, before the thread begins, and says it where there is something.
  void begin(TimeUs now_us);
  void work(TimeUs now_us, std::uint32_t unix_s) override;
  void finish(TimeUs now_us, std::uint32_t unix_s) override;

  [[nodiscard]] const GroundTiles& tiles() const { return tiles_; }
  /// From any thread.
  [[nodiscard]] GroundCounters counters() const {
    return {used_, writes_, failures_, lost_ + ring_.dropped()};
  }

 private:
  void adopt();
  void reach(TimeUs now_us);
  void drain(TimeUs now_us, std::uint32_t unix_s);
  void go(const EdgeSample& sample);
  void mark_changed(TimeUs now_us);
  [[nodiscard]] bool write_oldest(TimeUs now_us);

  ecu::Store& store_;
  EdgeRing& ring_;
  bool by_force_;
  Say say_;
  GroundTiles tiles_;
  const WorkSweeps::Take take_ = [this](const EdgeStep& step) { tiles_.add(step); };
  WorkSweeps sweeps_{take_};
  EdgeSample before_;
  bool has_before_ = false;
  TimeUs clock_us_ = 0;  ///< From the cycles' clock to 1970; 0: nobody has said it.
  std::array<TimeUs, kMostTiles> changed_us_{};
  std::array<std::uint8_t, ecu::kMostPayloadBytes> payload_{};
  int tokens_ = 0;
  TimeUs filled_us_ = 0;
  TimeUs retry_us_ = 0;
  bool has_said_ = false;
  std::atomic<std::uint32_t> used_{0};
  std::atomic<std::uint32_t> writes_{0};
  std::atomic<std::uint32_t> failures_{0};
  std::atomic<std::uint32_t> lost_{0};
};

}  // namespace graben::ground
