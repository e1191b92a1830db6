// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/ground/ground_keeper.hpp"

#include <algorithm>
#include <cstdio>

namespace graben::ground {
namespace {

constexpr TimeUs kTokenUs = 10 * kSecondUs;
constexpr TimeUs kRetryUs = 60 * kSecondUs;
/// What belongs together comes within it.
constexpr TimeUs kSettlesUs = 5 * kSecondUs;
constexpr int kMostTokens = 64;
constexpr int kForTheEnd = 16;

}  // namespace

void GroundKeeper::begin(TimeUs now_us) {
  filled_us_ = now_us;
  tokens_ = kForTheEnd;
  if (store_.look() != ecu::Place::kNone) {
    adopt();
  }
}

void GroundKeeper::adopt() {
  int tiles = 0;
  int others = 0;
  int damaged = 0;
  Tile tile;
  for (std::size_t n = 0; n < kMostTiles; ++n) {
    const ecu::Store::Read read = store_.read(tile_key(n));
    damaged += (read.is_damaged[0] ? 1 : 0) + (read.is_damaged[1] ? 1 : 0);
    const bool is_tile = read.payload != nullptr && read_tile(read.payload, read.length, tile);
    if (!is_tile || read.state != ecu::ReadState::kRead) {
      others += read.state == ecu::ReadState::kOtherProfile ||
                        read.state == ecu::ReadState::kOtherVersion ||
                        (read.payload != nullptr && !is_tile)
                    ? 1
                    : 0;
      continue;
    }
    ++tiles;
    for (std::size_t at = 0; at < kTileCells; ++at) {
      if (const Cell cell = tile.at(at); cell.passes > 0) {
        tiles_.join(tile.place_of(at), cell);
      }
    }
  }
  used_ = static_cast<std::uint32_t>(tiles_.used());
  if (tiles + others + damaged > 0) {
    std::array<char, 200> line{};
    static_cast<void>(std::snprintf(line.data(), line.size(),
                                    "store: as built: %d tiles of ground; of another profile or "
                                    "format and left alone: %d; damaged files: %d",
                                    tiles, others, damaged));
    say_(line.data());
  }
}

void GroundKeeper::go(const EdgeSample& sample) {
  EdgeStep step;
  step.from = before_.place;
  step.to = sample.place;
  step.time_s = 1e-6 * static_cast<double>(sample.now_us + clock_us_);
  const bool joined =
      has_before_ && sample.now_us - before_.now_us <= kGap_us && step.way_m() < kLeap_m;
  if (!joined) {
    sweeps_.end();
  } else if (by_force_) {
    sweeps_.add(step);
  } else {
    tiles_.add(step);
  }
  before_ = sample;
  has_before_ = true;
}

void GroundKeeper::drain(TimeUs now_us, std::uint32_t unix_s) {
  if (clock_us_ == 0 && unix_s != 0) {
    clock_us_ = TimeUs{unix_s} * kSecondUs - now_us;
  }
  while (const EdgeSample* const sample = ring_.front()) {
    go(*sample);
    ring_.take();
  }
  // A way that has ended for long ends its sweep.
  if (has_before_ && now_us - before_.now_us > kSecondUs) {
    sweeps_.end();
    has_before_ = false;
  }
}

void GroundKeeper::mark_changed(TimeUs now_us) {
  for (std::size_t n = 0; n < tiles_.used(); ++n) {
    if (tiles_.has_changed(n) && changed_us_[n] == 0) {
      changed_us_[n] = std::max<TimeUs>(now_us, 1);
    }
  }
  used_ = static_cast<std::uint32_t>(tiles_.used());
  lost_ = tiles_.lost();
}

bool GroundKeeper::write_oldest(TimeUs now_us) {
  std::size_t oldest = kMostTiles;
  for (std::size_t n = 0; n < tiles_.used(); ++n) {
    if (changed_us_[n] != 0 && (oldest == kMostTiles || changed_us_[n] < changed_us_[oldest])) {
      oldest = n;
    }
  }
  if (oldest == kMostTiles) {
    return false;
  }
  --tokens_;
  const std::size_t count = write_tile(tiles_.tile(oldest), payload_.data());
  if (!store_.write(tile_key(oldest), payload_.data(), count)) {
    ++failures_;
    retry_us_ = now_us + kRetryUs;
    if (!has_said_) {
      has_said_ = true;
      std::array<char, 320> line{};
      static_cast<void>(std::snprintf(line.data(), line.size(),
                                      "store: as built: %s; tried again each minute",
                                      store_.error()));
      say_(line.data());
    }
    return false;
  }
  ++writes_;
  changed_us_[oldest] = 0;
  tiles_.written(oldest);
  return true;
}

void GroundKeeper::work(TimeUs now_us, std::uint32_t unix_s) {
  drain(now_us, unix_s);
  mark_changed(now_us);
  const TimeUs periods = std::max<TimeUs>(now_us - filled_us_, 0) / kTokenUs;
  filled_us_ += periods * kTokenUs;
  tokens_ = static_cast<int>(std::min<TimeUs>(tokens_ + periods, kMostTokens));
  const bool is_due = std::any_of(changed_us_.begin(), changed_us_.end(), [&](TimeUs since_us) {
    return since_us != 0 && now_us - since_us >= kSettlesUs;
  });
  if (!is_due || tokens_ <= kForTheEnd || now_us < retry_us_) {
    return;
  }
  reach(now_us);
  static_cast<void>(write_oldest(now_us));
}

void GroundKeeper::reach(TimeUs now_us) {
  if (store_.look() == ecu::Place::kAnother) {
    // What is found there goes on; all of it is written there again.
    adopt();
    tiles_.change_all();
    mark_changed(now_us);
  }
}

void GroundKeeper::finish(TimeUs now_us, std::uint32_t unix_s) {
  drain(now_us, unix_s);
  sweeps_.end();
  mark_changed(now_us);
  reach(now_us);
  while (tokens_ > 0 && write_oldest(now_us)) {
  }
  const auto left = std::count_if(changed_us_.begin(), changed_us_.end(),
                                  [](TimeUs since_us) { return since_us != 0; });
  if (left > 0) {
    std::array<char, 120> line{};
    static_cast<void>(std::snprintf(line.data(), line.size(),
                                    "store: as built: tiles not written at the end: %d",
                                    static_cast<int>(left)));
    say_(line.data());
  }
}

}  // namespace graben::ground
