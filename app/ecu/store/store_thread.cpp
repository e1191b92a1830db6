// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/store_thread.hpp"

#include <sched.h>

#include <csignal>
#include <ctime>

#include "platform/linux/cyclic_clock.hpp"

namespace graben::ecu {
namespace {

constexpr std::size_t kStackBytes = 32 * 1024;
constexpr long kNapNs = 100'000'000;
constexpr long kNsPerUs = 1000;
/// 1 January 2026.
constexpr std::time_t kEarliest_s = 1'767'225'600;

/// All but what tells that this very thread has failed.
sigset_t left_to_others() {
  sigset_t set;
  sigfillset(&set);
  for (const int own : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP}) {
    sigdelset(&set, own);
  }
  return set;
}

}  // namespace

std::uint32_t wall_clock_s() {
  timespec now{};
  const bool known = clock_gettime(CLOCK_REALTIME, &now) == 0 && now.tv_sec >= kEarliest_s &&
                     now.tv_sec <= std::time_t{UINT32_MAX};
  return known ? static_cast<std::uint32_t>(now.tv_sec) : 0;
}

void* StoreThread::run(void* self) {
  auto& of = *static_cast<StoreThread*>(self);
  while (!of.is_to_end_.load(std::memory_order_acquire)) {
    of.work_.work(monotonic_now_us(), wall_clock_s());
    const timespec nap{0, kNapNs};
    clock_nanosleep(CLOCK_MONOTONIC, 0, &nap, nullptr);
  }
  of.work_.finish(monotonic_now_us(), wall_clock_s());
  return nullptr;
}

ErrorText StoreThread::start() {
  ErrorText error;
  pthread_attr_t as{};
  pthread_attr_init(&as);
  const sched_param normal{};
  sigset_t before;
  const sigset_t blocked = left_to_others();
  int failed = pthread_attr_setstacksize(&as, kStackBytes);
  failed = failed != 0 ? failed : pthread_attr_setinheritsched(&as, PTHREAD_EXPLICIT_SCHED);
  failed = failed != 0 ? failed : pthread_attr_setschedpolicy(&as, SCHED_OTHER);
  failed = failed != 0 ? failed : pthread_attr_setschedparam(&as, &normal);
  // It is born with its maker's mask: no signal finds it without.
  pthread_sigmask(SIG_SETMASK, &blocked, &before);
  failed = failed != 0 ? failed : pthread_create(&thread_, &as, &StoreThread::run, this);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  pthread_attr_destroy(&as);
  has_started_ = failed == 0;
  if (failed != 0) {
    error.set("a thread for the store: %s", error_words(failed));
  }
  return error;
}

StoreThread::~StoreThread() {
  if (has_started_) {
    is_to_end_.store(true, std::memory_order_release);
    pthread_join(thread_, nullptr);
  }
}

bool StoreThread::end(TimeUs most_us) {
  if (!has_started_) {
    return true;
  }
  is_to_end_.store(true, std::memory_order_release);
  const TimeUs until_us = monotonic_now_us() + most_us;
  const timespec until{static_cast<std::time_t>(until_us / kSecondUs),
                       static_cast<long>(until_us % kSecondUs) * kNsPerUs};
  has_started_ = pthread_clockjoin_np(thread_, nullptr, CLOCK_MONOTONIC, &until) != 0;
  return !has_started_;
}

}  // namespace graben::ecu
