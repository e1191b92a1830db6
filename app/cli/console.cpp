// SPDX-License-Identifier: Apache-2.0
#include "app/cli/console.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "platform/linux/process.hpp"

namespace graben::cli {
namespace {
constexpr int kWidth = 32;
constexpr std::chrono::milliseconds kRedraw(100);
}  // namespace

int failed_status() {
  constexpr int kInterrupted = 128 + SIGINT;
  return stop_signal() == SIGINT ? kInterrupted : 1;
}

void assert_not_stopped() {
  if (stop_requested()) {
    throw std::runtime_error("interrupted; nothing was written");
  }
}

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)),
      terminal_(isatty(STDERR_FILENO) == 1),
      started_(std::chrono::steady_clock::now()),
      drawn_(started_ - kRedraw) {}

ProgressBar::~ProgressBar() {
  if (terminal_) {
    fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
  }
}

void ProgressBar::show(double share, const std::string& where) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || now - drawn_ < kRedraw) {
    return;
  }
  drawn_ = now;
  const double done = std::clamp(share, 0.0, 1.0);
  const auto filled = static_cast<int>(done * kWidth);
  const double elapsed_s = std::chrono::duration<double>(now - started_).count();
  const std::string left =
      done > 0.02 ? fmt::format("{:.0f} s left", elapsed_s * (1.0 - done) / done) : "";
  fmt::print(stderr, "\r\x1b[K{} [{:#<{}}{:.<{}}] {:3.0f} % {} {}", label_, "", filled, "",
             kWidth - filled, done * 100.0, where, left);
  std::fflush(stderr);
}

runs::Progress ProgressBar::progress() {
  return [this](double share, const std::string& where) { show(share, where); };
}

runs::Progress ProgressBar::progress_until_stopped() {
  if (const ErrorText error = catch_stop_signals(); !error.empty()) {
    throw std::runtime_error(error.c_str());
  }
  return [this](double share, const std::string& where) {
    assert_not_stopped();
    show(share, where);
  };
}

}  // namespace graben::cli
