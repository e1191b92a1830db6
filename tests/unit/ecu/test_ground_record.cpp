// SPDX-License-Identifier: Apache-2.0
#include <random>

#include "app/ecu/ground/ground_keeper.hpp"
#include "platform/linux/allocation_counter.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/ecu/memory_disk.hpp"

constexpr std::uint32_t kHash = 0x1234;
constexpr std::uint32_t kUnix_s = 1'780'000'000;
std::string said;
void say(const char* line) { said += std::string(line) + "\n"; }

/// Two metres wide across x, at work.
ground::EdgeSample edge(double x_m, double height_m, TimeUs now_us) {
  ground::EdgePlace place;
  place.left_m = {x_m, 1.0, height_m};
  place.right_m = {x_m, -1.0, height_m};
  place.at_work = true;
  return {now_us, place};
}

/// A controller's record on a disk, with 100 ms between two looks of the store's thread.
struct Record {
  explicit Record(test::MemoryDisk& disk, std::uint32_t hash = kHash)
      : store(disk, hash), keeper(store, ring, false, say) {
    keeper.begin(now_us);
  }
  /// The edge goes a metre along x within a second.
  void go(double from_x_m, double height_m) {
    for (int n = 0; n <= 100; ++n) {
      now_us += 10 * kMillisecondUs;
      assert_true(ring.put(edge(from_x_m + 0.01 * n, height_m, now_us)));
      if (n % 10 == 0) {
        keeper.work(now_us, kUnix_s);
      }
    }
  }
  void wait(double time_s) {
    for (int n = 0; n < static_cast<int>(10.0 * time_s); ++n) {
      now_us += 100 * kMillisecondUs;
      keeper.work(now_us, kUnix_s);
    }
  }

  TimeUs now_us = kSecondUs;
  ecu::Store store;
  ground::EdgeRing ring;
  ground::GroundKeeper keeper;
};

std::size_t cells_of(const ground::StoredGround& found) {
  std::size_t cells = 0;
  for (const ground::Tile& tile : found.tiles) {
    for (const ground::TileCell& cell : tile.cell) {
      cells += cell.passes > 0 ? 1 : 0;
    }
  }
  return cells;
}

/// The height of a place; not a number where there is none.
double height_at(const ground::StoredGround& found, std::int32_t i, std::int32_t j, bool lowest) {
  for (const ground::Tile& tile : found.tiles) {
    for (std::size_t n = 0; n < ground::kTileCells; ++n) {
      const ground::CellPlace place = tile.place_of(n);
      if (place.i == i && place.j == j && tile.cell[n].passes > 0) {
        return lowest ? tile.at(n).lowest_m : tile.at(n).newest_m;
      }
    }
  }
  return std::nan("");
}

TEST(a_cell_is_the_same_after_it_was_written) {
  ground::Tile tile;
  tile.i = -3;
  tile.j = 7;
  tile.base = -2468;
  const ground::Cell cell{-1.2345, 1.78e9, -1.1, 1.78e9 + 5.25, 3};
  assert_true(tile.put(200, cell));
  std::array<std::uint8_t, ground::kTileBytes> bytes{};
  assert_int_equal(ground::write_tile(tile, bytes.data()), bytes.size());
  ground::Tile read;
  assert_true(ground::read_tile(bytes.data(), bytes.size(), read));
  assert_false(ground::read_tile(bytes.data(), bytes.size() - 1, read));
  assert_int_equal(read.place_of(200).i, -48 + 8);
  assert_int_equal(read.place_of(200).j, 112 + 12);
  assert_near(read.at(200).lowest_m, cell.lowest_m, 0.00026);
  assert_near(read.at(200).newest_m, cell.newest_m, 0.00026);
  assert_near(read.at(200).lowest_s, cell.lowest_s, 1e-6);
  assert_near(read.at(200).newest_s, cell.newest_s, 0.011);
  assert_int_equal(read.at(200).passes, 3);
  assert_int_equal(read.at(199).passes, 0);
  assert_false(tile.put(0, {20.0, 0.0, 20.0, 0.0, 1}));
  bytes[0] ^= 1;
  assert_false(ground::read_tile(bytes.data(), bytes.size(), read));
}

/// Newest and lowest, over the end of the process, to either side of 0.
TEST(ground_outlives_the_process) {
  test::MemoryDisk disk;
  {
    Record record(disk);
    record.go(-0.5, -1.0);
    record.keeper.finish(record.now_us, kUnix_s);
  }
  said.clear();
  Record record(disk);
  assert_non_null(std::strstr(said.c_str(), "as built: 4 tiles"));
  record.wait(5.0);
  record.go(-0.5, -0.8);
  record.keeper.finish(record.now_us, kUnix_s);
  const ground::StoredGround found = ground::read_stored_ground(disk);
  assert_int_equal(found.profile_hash, kHash);
  assert_int_equal(cells_of(found), 200);
  assert_near(height_at(found, -5, -10, true), -1.0, 1e-9);
  assert_near(height_at(found, -5, -10, false), -0.8, 1e-9);
  assert_near(height_at(found, 4, 9, false), -0.8, 1e-9);
  assert_true(std::isnan(height_at(found, 5, 9, false)));
  assert_near(found.tiles.front().at(255).newest_s, kUnix_s, 30.0);
}

TEST(another_profiles_ground_is_none_of_this_one) {
  test::MemoryDisk disk;
  {
    Record record(disk);
    record.go(0.0, -1.0);
    record.keeper.finish(record.now_us, kUnix_s);
  }
  said.clear();
  const Record record(disk, kHash + 1);
  assert_int_equal(record.keeper.tiles().used(), 0);
  assert_non_null(std::strstr(said.c_str(),
                              "0 tiles of ground; of another profile or format and "
                              "left alone: 2"));
}

/// A power cut at any operation: each tile is one that was written, and no cell is lost that was
/// acknowledged.
TEST(no_power_cut_loses_what_was_written) {
  std::mt19937 random(7);
  for (int cut = 0; cut < 60; ++cut) {
    test::MemoryDisk disk;
    std::size_t acknowledged = 0;
    {
      Record record(disk);
      record.go(0.0, -1.0);
      record.wait(40.0);
      acknowledged = record.keeper.counters().writes;
      assert_int_equal(acknowledged, 2);
      disk.fail_after(cut % 8);
      record.go(0.0, -1.5);
      record.wait(40.0);
    }
    disk.power_on(random);
    const ground::StoredGround found = ground::read_stored_ground(disk);
    assert_int_equal(cells_of(found), 200);
    for (const ground::Tile& tile : found.tiles) {
      double first_m = std::nan("");
      for (std::size_t n = 0; n < ground::kTileCells; ++n) {
        if (tile.cell[n].passes > 0) {
          first_m = std::isnan(first_m) ? tile.at(n).lowest_m : first_m;
          assert_near(tile.at(n).lowest_m, first_m, 0.0);
        }
      }
    }
  }
}

/// An hour of work all over: one write each 10 s, and none while nothing changes.
TEST(a_disk_is_written_as_often_as_is_said) {
  test::MemoryDisk disk;
  Record record(disk);
  for (int n = 0; n < 300; ++n) {
    record.go(0.1 * n, -1.0);
    record.wait(11.0);
  }
  const std::uint32_t writes = record.keeper.counters().writes;
  assert_in_range(writes, 340, 361);
  record.wait(2000.0);
  const std::uint32_t at_rest = record.keeper.counters().writes;
  assert_in_range(at_rest - writes, 0, 64);
  record.wait(2000.0);
  assert_int_equal(record.keeper.counters().writes, at_rest);
}

/// So many tiles and no more; what has no room is counted, and the rest goes on.
TEST(memory_is_bounded_and_taken_once) {
  test::MemoryDisk disk;
  const auto record = std::make_unique<Record>(disk);
  const auto before = allocation_count();
  ground::GroundTiles tiles;
  const auto after_made = allocation_count();
  for (int n = 0; n < 20'000; ++n) {
    tiles.add({edge(0.05 * n, 0.0, 0).place, edge(0.05 * (n + 1), 0.0, 0).place, 1e9 + n});
  }
  if (allocations_are_counted()) {
    assert_true(after_made > before);
    assert_int_equal(allocation_count(), after_made);
  }
  const ground::WorkSweeps::Take take = [&](const ground::EdgeStep& step) { tiles.add(step); };
  ground::WorkSweeps sweeps(take);
  const auto after_sweeps = allocation_count();
  for (int n = 0; n < 10'000; ++n) {
    ground::EdgeStep step{edge(0.001 * n, 0.0, 0).place, edge(0.001 * (n + 1), 0.0, 0).place,
                          1e9 + 0.01 * n};
    step.from.outwards_m = 0.001 * n;
    step.to.outwards_m = 0.001 * (n + 1);
    sweeps.add(step);
  }
  sweeps.end();
  if (allocations_are_counted()) {
    assert_int_equal(allocation_count(), after_sweeps);
  }
  assert_int_equal(tiles.used(), ground::kMostTiles);
  assert_true(tiles.lost() > 0);
}

TEST(a_disk_that_is_full_is_said_once_and_tried_again) {
  test::MemoryDisk disk;
  Record record(disk);
  said.clear();
  disk.is_full = true;
  record.go(0.0, -1.0);
  record.wait(200.0);
  assert_in_range(record.keeper.counters().failures, 2, 5);
  assert_ptr_equal(std::strstr(said.c_str(), "tried again each minute"),
                   std::strrchr(said.c_str(), ';') + 2);
  disk.is_full = false;
  record.wait(100.0);
  assert_int_equal(record.keeper.counters().writes, 2);
}
