// SPDX-License-Identifier: Apache-2.0
/// The terminal is given back as it was, however the process ends.

#include "app/operate/terminal.hpp"

#include <pty.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "tests/unit/cmocka_cpp.hpp"

using operate::RawTerminal;

/// A process with a terminal of its own, whose other end stays here.
struct Child {
  pid_t pid = -1;
  int terminal = -1;

  [[nodiscard]] tcflag_t modes() const {
    termios now{};
    assert_int_equal(tcgetattr(terminal, &now), 0);
    return now.c_lflag & (ICANON | ECHO);
  }
  void wait_for(tcflag_t wanted) const {
    for (int look = 0; look < 500 && modes() != wanted; ++look) {
      usleep(10'000);
    }
    assert_int_equal(modes(), wanted);
  }
  int status() const {
    int status = 0;
    assert_int_equal(waitpid(pid, &status, 0), pid);
    return status;
  }
};

/// It reads until `q` comes.
Child start(bool ignores_hangup = false) {
  Child child;
  int slave = -1;
  // Both ends are kept: a terminal that nobody has open forgets how it was.
  assert_int_equal(openpty(&child.terminal, &slave, nullptr, nullptr, nullptr), 0);
  child.pid = fork();
  if (child.pid == 0) {
    // CMocka's own handlers would go on with the tests there.
    for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS}) {
      std::signal(signal, SIG_DFL);
    }
    alarm(20);
    dup2(slave, STDIN_FILENO);
    if (ignores_hangup) {
      std::signal(SIGHUP, SIG_IGN);
    }
    {
      RawTerminal terminal;
      std::string bytes;
      while (bytes != "q" && terminal.read(bytes)) {
        usleep(1000);
      }
    }
    _exit(7);
  }
  child.wait_for(0);
  return child;
}

TEST(it_is_raw_and_then_as_before) {
  const Child child = start();
  assert_int_equal(write(child.terminal, "q", 1), 1);
  const int status = child.status();
  assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 7);
  assert_int_equal(child.modes(), ICANON | ECHO);
}

TEST(a_signal_that_ends_gives_it_back) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGSEGV, SIGABRT}) {
    const Child child = start();
    assert_int_equal(kill(child.pid, signal), 0);
    const int status = child.status();
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == signal);
    assert_int_equal(child.modes(), ICANON | ECHO);
  }
}

TEST(a_signal_that_is_ignored_does_not_end_it) {
  const Child child = start(true);
  assert_int_equal(kill(child.pid, SIGHUP), 0);
  usleep(50'000);
  assert_int_equal(write(child.terminal, "q", 1), 1);
  assert_true(WIFEXITED(child.status()));
}

TEST(without_a_terminal_it_is_refused) {
  int ends[2] = {-1, -1};
  assert_int_equal(pipe(ends), 0);
  const pid_t pid = fork();
  if (pid == 0) {
    dup2(ends[0], STDIN_FILENO);
    try {
      const RawTerminal terminal;
      _exit(0);
    } catch (const std::runtime_error&) {
      _exit(3);
    }
  }
  const Child child = {pid, -1};
  const int status = child.status();
  assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 3);
}
