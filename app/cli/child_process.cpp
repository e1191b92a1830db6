// SPDX-License-Identifier: Apache-2.0
#include "app/cli/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX has no header for it.

namespace graben::cli {
namespace {

/// Above what a child may have for itself, so that no duplicate overwrites another.
constexpr int kHigh = 20;
constexpr int kRounds = 50;  // Of 100 ms, until a child that was asked to end is made to.

int lifted(int descriptor) {
  const int high = fcntl(descriptor, F_DUPFD_CLOEXEC, kHigh);
  close(descriptor);
  return high;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& words, const std::map<int, Way>& pipes,
                           const std::string& log)
    : name_(words.front()) {
  // A child that has ended is told by what a call returns.
  std::signal(SIGPIPE, SIG_IGN);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::vector<int> theirs;
  for (const auto& [descriptor, way] : pipes) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw std::runtime_error(fmt::format("{}: no pipe: {}", name_, std::strerror(errno)));
    }
    const bool child_reads = way == Way::kChildReads;
    own_[descriptor] = lifted(ends[child_reads ? 1 : 0]);
    theirs.push_back(lifted(ends[child_reads ? 0 : 1]));
    posix_spawn_file_actions_adddup2(&actions, theirs.back(), descriptor);
  }
  std::vector<std::string> held = words;
  std::vector<char*> argv;
  for (std::string& word : held) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  const int failure = posix_spawnp(&process_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  for (const int end : theirs) {
    close(end);
  }
  if (failure != 0) {
    for (const auto& [descriptor, end] : own_) {
      close(end);
    }
    throw std::runtime_error(fmt::format("{}: {}", name_, std::strerror(failure)));
  }
}

ChildProcess::~ChildProcess() {
  while (!own_.empty()) {
    close_pipe(own_.begin()->first);
  }
  if (process_ < 0) {
    return;
  }
  kill(process_, SIGTERM);
  for (int round = 0; round < kRounds; ++round) {
    if (waitpid(process_, nullptr, WNOHANG) != 0) {
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  kill(process_, SIGKILL);
  wait();
}

void ChildProcess::write(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t size = ::write(own_.at(descriptor), bytes.data(), bytes.size());
    if (size < 0 && errno != EINTR) {
      throw std::runtime_error(fmt::format("{}: has ended", name_));
    }
    bytes.remove_prefix(size < 0 ? 0 : static_cast<std::size_t>(size));
  }
}

std::string ChildProcess::read_until(int descriptor, char end, double most_s) {
  std::string& rest = rest_[descriptor];
  std::size_t looked = 0;
  for (;;) {
    const std::size_t at = rest.find(end, looked);
    if (at != std::string::npos) {
      std::string text = rest.substr(0, at);
      rest.erase(0, at + 1);
      return text;
    }
    looked = rest.size();
    pollfd ready{own_.at(descriptor), POLLIN, 0};
    const int count = poll(&ready, 1, static_cast<int>(most_s * 1e3));
    if (count == 0) {
      throw std::runtime_error(fmt::format("{}: says nothing for {:.0f} s", name_, most_s));
    }
    std::array<char, 65536> part{};
    const ssize_t size = count < 0 ? -1 : ::read(ready.fd, part.data(), part.size());
    if (size == 0 || (size < 0 && errno != EINTR)) {
      throw std::runtime_error(fmt::format("{}: has ended", name_));
    }
    rest.append(part.data(), size < 0 ? 0 : static_cast<std::size_t>(size));
  }
}

int ChildProcess::finish(int descriptor) {
  close_pipe(descriptor);
  const int status = wait();
  process_ = -1;
  return status;
}

void ChildProcess::close_pipe(int descriptor) {
  close(own_.at(descriptor));
  own_.erase(descriptor);
}

int ChildProcess::wait() {
  int ended = 0;
  while (waitpid(process_, &ended, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended);
}

}  // namespace graben::cli
