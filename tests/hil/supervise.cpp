// SPDX-License-Identifier: Apache-2.0
// Plays the service manager for a scenario: supervise WATCHDOG_MS COMMAND...
// Starts the command with NOTIFY_SOCKET and WATCHDOG_USEC, kills it when it has been READY and then
// says nothing for so long, starts it again 0.5 s after any end but a clean one; ends with it then.
// One line for each start, READY and end on standard output.

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

constexpr useconds_t kRestart_us = 500'000;
constexpr int kStart_ms = 5000;

volatile sig_atomic_t told_to_end = 0;
void end(int) { told_to_end = 1; }

int listen_at(const std::string& abstract_name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path + 1, abstract_name.data(), abstract_name.size());
  const auto length =
      static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + abstract_name.size());
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0 || bind(fd, reinterpret_cast<const sockaddr*>(&address), length) != 0) {
    std::perror("supervise");
    std::exit(1);
  }
  return fd;
}

pid_t start(char** command, int watchdog_ms) {
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setenv("NOTIFY_SOCKET", "@graben-supervise", 1);
    setenv("WATCHDOG_USEC", std::to_string(watchdog_ms * 1000).c_str(), 1);
    setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
    execvp(command[0], command);
    std::perror(command[0]);
    _exit(127);
  }
  std::printf("started %d\n", static_cast<int>(child));
  return child;
}

bool has_ended(pid_t child) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == child;
}

/// Until the command has ended, by itself or by our hand.
int watch(pid_t child, int fd, int watchdog_ms) {
  bool ready = false;
  bool terminated = false;
  for (;;) {
    if (told_to_end != 0 && !terminated) {
      terminated = true;
      kill(child, SIGTERM);
    }
    int status = 0;
    if (waitpid(child, &status, WNOHANG) == child) {
      return status;
    }
    pollfd wanted{fd, POLLIN, 0};
    const int got = poll(&wanted, 1, ready ? watchdog_ms : kStart_ms);
    char message[256] = {};
    if (got > 0 && recv(fd, message, sizeof message - 1, 0) > 0) {
      if (!ready && std::strstr(message, "READY=1") != nullptr) {
        ready = true;
        std::printf("ready %d\n", static_cast<int>(child));
      }
    } else if (got == 0 && !terminated && !has_ended(child)) {
      std::printf("watchdog %d\n", static_cast<int>(child));
      kill(child, SIGKILL);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int watchdog_ms = argc > 2 ? std::atoi(argv[1]) : 0;
  if (watchdog_ms <= 0) {
    std::fprintf(stderr, "supervise WATCHDOG_MS COMMAND...\n");
    return 2;
  }
  setvbuf(stdout, nullptr, _IOLBF, 0);
  struct sigaction action {};
  action.sa_handler = end;
  sigaction(SIGTERM, &action, nullptr);
  const int fd = listen_at("graben-supervise");
  for (;;) {
    const int status = watch(start(argv + 2, watchdog_ms), fd, watchdog_ms);
    std::printf("ended %d\n", status);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
      return 0;
    }
    if (told_to_end != 0) {
      return 1;
    }
    usleep(kRestart_us);
  }
}
