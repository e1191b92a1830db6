// SPDX-License-Identifier: Apache-2.0
#include "app/operate/terminal.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <stdexcept>

namespace graben::operate {
namespace {

constexpr std::array<int, 13> kEnds = {SIGTERM, SIGINT, SIGHUP,  SIGQUIT, SIGPIPE, SIGSEGV, SIGBUS,
                                       SIGFPE,  SIGILL, SIGABRT, SIGSYS,  SIGTRAP, SIGXCPU};

termios g_cooked{};
std::array<struct sigaction, kEnds.size()> g_before{};

/// Gives the terminal back, then does what was to be done. Only what POSIX allows in a handler.
void on_end(int signal) {
  const int kept = errno;
  static_cast<void>(tcsetattr(STDIN_FILENO, TCSANOW, &g_cooked));
  for (std::size_t i = 0; i < kEnds.size(); ++i) {
    if (kEnds[i] != signal) {
      continue;
    }
    const auto before = g_before[i].sa_handler;
    if (before == SIG_DFL) {
      static_cast<void>(sigaction(signal, &g_before[i], nullptr));
      static_cast<void>(raise(signal));
    } else {
      before(signal);
    }
  }
  errno = kept;
}

bool takes_output(int fd) {
  pollfd wanted = {fd, POLLOUT, 0};
  return ::poll(&wanted, 1, 0) > 0 && (wanted.revents & POLLOUT) != 0;
}

/// False if it was not taken.
bool write_out(const std::string& text) {
  return takes_output(STDOUT_FILENO) &&
         ::write(STDOUT_FILENO, text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

}  // namespace

RawTerminal::RawTerminal() {
  if (::isatty(STDIN_FILENO) == 0 || tcgetattr(STDIN_FILENO, &g_cooked) != 0) {
    throw std::runtime_error("--keyboard: standard input is no terminal");
  }
  for (std::size_t i = 0; i < kEnds.size(); ++i) {
    struct sigaction action {};
    action.sa_handler = &on_end;
    action.sa_flags = SA_ONSTACK;
    static_cast<void>(sigaction(kEnds[i], &action, &g_before[i]));
    if (g_before[i].sa_handler == SIG_IGN) {
      // Nothing ends by it.
      static_cast<void>(sigaction(kEnds[i], &g_before[i], nullptr));
    }
  }
  termios raw = g_cooked;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_iflag &= ~static_cast<tcflag_t>(IXON);
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  raw.c_cc[VSUSP] = _POSIX_VDISABLE;
  static_cast<void>(tcsetattr(STDIN_FILENO, TCSAFLUSH, &raw));
}

RawTerminal::~RawTerminal() {
  static_cast<void>(tcsetattr(STDIN_FILENO, TCSANOW, &g_cooked));
  for (std::size_t i = 0; i < kEnds.size(); ++i) {
    static_cast<void>(sigaction(kEnds[i], &g_before[i], nullptr));
  }
}

bool RawTerminal::read(std::string& bytes) {
  std::array<char, 256> buffer{};
  pollfd wanted = {STDIN_FILENO, POLLIN, 0};
  if (::poll(&wanted, 1, 0) <= 0) {
    return true;
  }
  const ssize_t count = ::read(STDIN_FILENO, buffer.data(), buffer.size());
  if (count > 0) {
    bytes.assign(buffer.data(), static_cast<std::size_t>(count));
  }
  return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

Hands Keyboard::read(TimeUs now) {
  std::string bytes;
  const bool is_there = terminal_.read(bytes);
  Hands hands = keys_.step(bytes, now);
  hands.is_there = is_there;
  hands.quits = hands.quits || !is_there;
  return hands;
}

Display::Display() : is_terminal_(::isatty(STDOUT_FILENO) != 0) {}

void Display::draw(const std::vector<std::string>& lines) {
  std::string text;
  if (drawn_lines_ > 0) {
    text = fmt::format("\x1b[{}A\r", drawn_lines_);
  }
  for (const std::string& line : lines) {
    text += line + "\x1b[K\n";
  }
  text += "\x1b[J";
  if (write_out(text)) {
    drawn_lines_ = lines.size();
  }
}

void Display::tell(double at_s, const std::string& line) {
  if (line != told_ && write_out(fmt::format("{:.2f} s: {}\n", at_s, line))) {
    told_ = line;
  }
}

}  // namespace graben::operate
