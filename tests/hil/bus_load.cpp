// SPDX-License-Identifier: Apache-2.0
// Fills a bus: bus_load INTERFACE PERCENT [ID] until SIGTERM. 100 % is a frame of 160 bits, the
// longest of 29-bit id and 8 bytes, in every slot of 320 us, as a 500 kbit/s bus carries them. It
// counts what others send and adds what is missing, frames of an id that nobody listens to; or,
// with ID in hexadecimal, copies of the last frame heard with this id, for which there is a
// listener. One line out: slots gone by, frames of others, frames of its own.

#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace {

// 0.1 % short of it: no two nodes' clocks are alike, and so the load meets every moment of a cycle.
constexpr std::int64_t kSlotNs = 319'680;
constexpr std::int64_t kNsPerS = 1'000'000'000;
// PGN FF7F of source 7F: none of any DBC here.
constexpr canid_t kForeignId = 0x18FF7F7FU | CAN_EFF_FLAG;
// As an interface's interrupt thread has it: what a bus brings waits for the controller, not the
// other way round.
constexpr int kPriority = 50;
constexpr int kMostAtOnce = 8;
constexpr int kReceiveBytes = 1 << 20;

volatile sig_atomic_t told_to_end = 0;
void end(int) { told_to_end = 1; }

[[noreturn]] void give_up(const char* what) {
  std::perror(what);
  std::exit(1);
}

int open_bus(const char* interface) {
  const int fd = socket(AF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  ifreq request{};
  std::strncpy(request.ifr_name, interface, sizeof request.ifr_name - 1);
  if (fd < 0 || ioctl(fd, SIOCGIFINDEX, &request) != 0) {
    give_up(interface);
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = request.ifr_ifindex;
  setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &kReceiveBytes, sizeof kReceiveBytes);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    give_up(interface);
  }
  return fd;
}

void become_punctual() {
  sched_param priority{};
  priority.sched_priority = kPriority;
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0 ||
      sched_setscheduler(0, SCHED_FIFO, &priority) != 0) {
    give_up("bus_load: real-time priority");
  }
}

void sleep_to(std::int64_t at_ns) {
  const timespec at{at_ns / kNsPerS, at_ns % kNsPerS};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t percent = argc > 2 ? std::atoll(argv[2]) : 0;
  if (percent < 1 || percent > 100) {
    std::fputs("bus_load INTERFACE PERCENT [ID], 1 to 100 %\n", stderr);
    return 2;
  }
  const canid_t copied =
      argc > 3 ? static_cast<canid_t>(std::strtoul(argv[3], nullptr, 16)) | CAN_EFF_FLAG : 0;
  const int fd = open_bus(argv[1]);
  become_punctual();
  struct sigaction action {};
  action.sa_handler = end;
  sigaction(SIGTERM, &action, nullptr);

  can_frame filling{};
  filling.can_id = kForeignId;
  filling.can_dlc = CAN_MAX_DLEN;
  std::int64_t slots = 0;
  std::int64_t heard = 0;
  std::int64_t sent = 0;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t begin_ns = now.tv_sec * kNsPerS + now.tv_nsec;
  while (told_to_end == 0) {
    sleep_to(begin_ns + ++slots * kSlotNs);
    can_frame frame{};
    while (read(fd, &frame, sizeof frame) == sizeof frame) {
      ++heard;
      filling = frame.can_id == copied ? frame : filling;
    }
    const std::int64_t missing = slots * percent / 100 - heard - sent;
    for (int i = 0; i < static_cast<int>(std::min<std::int64_t>(missing, kMostAtOnce)); ++i) {
      sent += write(fd, &filling, sizeof filling) == sizeof filling ? 1 : 0;
    }
  }
  std::printf("slots %lld heard %lld sent %lld\n", static_cast<long long>(slots),
              static_cast<long long>(heard), static_cast<long long>(sent));
  return 0;
}
