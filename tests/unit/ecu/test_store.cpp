// SPDX-License-Identifier: Apache-2.0
// A store's records: their format, what is left of them when the power fails, and the thread that
// a real one has.

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <mutex>
#include <random>
#include <thread>

#include "app/ecu/store/spsc_ring.hpp"
#include "app/ecu/store/store.hpp"
#include "app/ecu/store/store_thread.hpp"
#include "tests/unit/ecu/store_records.hpp"

using namespace graben::test::records;

TEST(a_checksum_is_that_of_the_standard) {
  const char* const text = "123456789";
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(text);
  assert_int_equal(crc32(bytes, 9), 0xCBF43926);
  assert_int_equal(crc32(bytes + 4, 5, crc32(bytes, 4)), 0xCBF43926);
}

TEST(a_record_is_read_as_it_was_written_and_the_newest_counts) {
  MemoryDisk disk;
  Store store(disk, kHash);
  assert_true(store.read(kFirst).state == ReadState::kNothing);
  for (unsigned number = 1; number <= 5; ++number) {
    assert_true(write(store, kFirst, number));
    assert_int_equal(read_number(store, kFirst), number);
    Store after(disk, kHash);
    assert_int_equal(read_number(after, kFirst), number);
  }
  assert_int_equal(disk.files(), 2);
}

TEST(another_profile_begins_anew_and_its_record_is_newer) {
  MemoryDisk disk;
  Store store(disk, kHash);
  assert_true(write(store, kFirst, 1) && write(store, kFirst, 2));
  Store other(disk, kHash + 1);
  const Store::Read read = other.read(kFirst);
  assert_true(read.state == ReadState::kOtherProfile);
  assert_int_equal(number_of(read, kFirst), 2);
  assert_true(write(other, kFirst, 1));
  assert_true(other.read(kFirst).state == ReadState::kRead);
  assert_int_equal(read_number(other, kFirst), 1);
}

TEST(a_damaged_copy_is_named_and_the_other_one_counts) {
  MemoryDisk disk;
  Store store(disk, kHash);
  assert_true(write(store, kFirst, 1) && write(store, kFirst, 2));
  // Each byte of a record is under its checksum, its head's too.
  const MemoryDisk::Bytes whole = disk.file("faults.b");
  for (std::size_t at = 0; at < whole.size(); at += at < kHeadBytes ? 1 : 37) {
    disk.file("faults.b") = whole;
    disk.file("faults.b")[at] ^= 0x10;
    Store after(disk, kHash);
    const Store::Read read = after.read(kFirst);
    assert_true(read.state == ReadState::kRead);
    // A version that is not known is no damage.
    assert_true(read.is_damaged[1] || at == 4 || at == 5);
    assert_false(read.is_damaged[0]);
    assert_int_equal(number_of(read, kFirst), 1);
  }
  for (const std::size_t length : {0U, 1U, 31U, 32U, 40U}) {
    disk.file("faults.b") = MemoryDisk::Bytes(whole.begin(), whole.begin() + length);
    Store after(disk, kHash);
    assert_int_equal(read_number(after, kFirst), 1);
  }
  disk.file("faults.a") = MemoryDisk::Bytes(5000, 0xFF);
  Store lost(disk, kHash);
  assert_true(lost.read(kFirst).state == ReadState::kDamaged);
  assert_true(write(lost, kFirst, 3));
  assert_int_equal(read_number(lost, kFirst), 3);
  disk.file("faults.a")[4] = 2;
  disk.file("faults.b").clear();
  Store older(disk, kHash);
  assert_true(older.read(kFirst).state == ReadState::kOtherVersion);
}

TEST(a_record_in_the_place_of_another_is_none) {
  MemoryDisk disk;
  Store store(disk, kHash);
  const RecordKey third{RecordKind::kFreezeFrame, 3};
  const RecordKey fourth{RecordKind::kFreezeFrame, 4};
  assert_true(write(store, third, 1));
  disk.file("frame-004.a") = disk.file("frame-003.a");
  Store after(disk, kHash);
  assert_int_equal(read_number(after, third), 1);
  assert_true(after.read(fourth).state == ReadState::kDamaged);
}

TEST(what_does_not_fit_is_refused) {
  MemoryDisk disk;
  Store store(disk, kHash);
  const MemoryDisk::Bytes much(kMostPayloadBytes + 1);
  assert_false(store.write(kFirst, much.data(), much.size()));
  assert_true(store.write(kFirst, much.data(), kMostPayloadBytes));
}

// Each replay is a life of a disk: processes that write, end or crash, until the power fails at
// some operation; then it comes back, and again.
TEST(no_power_cut_loses_what_was_acknowledged) {
  constexpr unsigned kReplays = 1200;
  constexpr std::array<RecordKey, 3> kKeys = {
      kFirst, {RecordKind::kFreezeFrame, 1}, {RecordKind::kFreezeFrame, 2}};
  unsigned cuts = 0;
  unsigned acknowledged_in_all = 0;
  unsigned newer = 0;
  for (unsigned replay = 0; replay < kReplays; ++replay) {
    std::mt19937 random(replay);
    const auto drawn = [&](unsigned below) { return static_cast<unsigned>(random() % below); };
    MemoryDisk disk;
    std::array<unsigned, kKeys.size()> acknowledged{};
    std::array<unsigned, kKeys.size()> tried{};
    for (int life = 0; life < 3; ++life) {
      disk.fail_after(static_cast<int>(1 + drawn(24)));
      for (int process = 0; process < 3; ++process) {
        Store store(disk, kHash);
        for (unsigned key = 0; key < kKeys.size(); ++key) {
          static_cast<void>(store.read(kKeys[key]));
        }
        const unsigned writes = 1 + drawn(4);
        for (unsigned i = 0; i < writes; ++i) {
          const unsigned key = drawn(kKeys.size());
          disk.is_full = drawn(16) == 0;
          // As where a process ends before it.
          disk.never_syncs = drawn(4) == 0;
          if (write(store, kKeys[key], ++tried[key])) {
            acknowledged[key] = tried[key];
            ++acknowledged_in_all;
          }
        }
      }
      disk.is_full = disk.never_syncs = false;
      disk.power_on(random);
      ++cuts;
      Store store(disk, kHash);
      for (unsigned key = 0; key < kKeys.size(); ++key) {
        const unsigned found = read_number(store, kKeys[key]);
        if (found < acknowledged[key] || found > tried[key]) {
          fail_msg("replay %u, life %d: record %u is %u; acknowledged: %u, tried: %u", replay, life,
                   key, found, acknowledged[key], tried[key]);
        }
        newer += found > acknowledged[key] ? 1 : 0;
        // It is what counts from here on, and is not to be lost either.
        acknowledged[key] = found;
      }
    }
  }
  // The disk does what it is to do: some cuts leave what was not acknowledged, most do not.
  assert_int_equal(cuts, 3 * kReplays);
  assert_true(acknowledged_in_all > 5 * kReplays);
  assert_true(newer > kReplays / 20);
}

TEST(a_full_queue_drops_and_counts) {
  SpscRing<int, 4> ring;
  assert_null(ring.front());
  for (int i = 0; i < 6; ++i) {
    assert_int_equal(ring.put(i), i < 4);
  }
  assert_int_equal(ring.dropped(), 2);
  for (int i = 0; i < 4; ++i) {
    assert_int_equal(*ring.front(), i);
    ring.take();
  }
  assert_null(ring.front());
  assert_true(ring.put(6));
  assert_int_equal(*ring.front(), 6);
}

TEST(two_threads_lose_nothing_and_keep_the_order) {
  constexpr unsigned kCount = 20'000;
  SpscRing<std::array<unsigned, 8>, 16> ring;
  std::thread from([&] {
    for (unsigned i = 0; i < kCount;) {
      std::array<unsigned, 8> all{};
      all.fill(i);
      if (ring.put(all)) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  bool whole = true;
  for (unsigned i = 0; i < kCount;) {
    if (const auto* const one = ring.front()) {
      whole = whole && std::count(one->begin(), one->end(), i) == 8;
      ring.take();
      ++i;
    } else {
      std::this_thread::yield();
    }
  }
  from.join();
  assert_true(whole);
  assert_null(ring.front());
}

namespace {

/// Says on which thread it works; holds that up while it is locked.
class WatchedWork : public StoreWork {
 public:
  void work(TimeUs, std::uint32_t) override {
    sched_param parameter{};
    int policy = -1;
    pthread_getschedparam(pthread_self(), &policy, &parameter);
    sigset_t mask;
    pthread_sigmask(SIG_SETMASK, nullptr, &mask);
    leaves_end = sigismember(&mask, SIGTERM) == 1 && sigismember(&mask, SIGSEGV) == 0;
    is_normal = policy == SCHED_OTHER;
    is_other = !pthread_equal(pthread_self(), maker);
    ++times;
    const std::lock_guard<std::mutex> wait(held);
  }
  void finish(TimeUs, std::uint32_t) override { finished = true; }

  pthread_t maker = pthread_self();
  std::mutex held;
  std::atomic<bool> is_normal{false};
  std::atomic<bool> is_other{false};
  std::atomic<bool> leaves_end{false};
  std::atomic<int> times{0};
  std::atomic<bool> finished{false};
};

}  // namespace

TEST(the_thread_is_another_of_normal_priority_and_finishes) {
  WatchedWork work;
  StoreThread thread(work);
  work.held.lock();
  assert_true(thread.start().empty());
  while (work.times == 0) {
    std::this_thread::yield();
  }
  assert_true(work.is_other && work.is_normal && work.leaves_end);
  // A disk that does not answer keeps nobody: not the end of the process either.
  assert_false(thread.end(1));
  assert_false(work.finished);
  work.held.unlock();
  assert_true(thread.end(60 * kSecondUs));
  assert_true(work.finished);
}
