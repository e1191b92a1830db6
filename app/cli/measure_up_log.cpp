// SPDX-License-Identifier: Apache-2.0
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include "app/cli/measure_up.hpp"
#include "app/cli/output_file.hpp"
#include "app/identify/imus/mounting_file.hpp"
#include "app/identify/imus/mounting_fit.hpp"
#include "app/identify/imus/rest_log.hpp"
#include "app/machines/excavator_file.hpp"
#include "app/machines/profile_document.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kShortHash = 12;
constexpr double kDegrees = 57.29577951308232;

/// "2-5,7" as numbers; empty of an empty text. Throws with what is wrong.
std::vector<std::size_t> numbers_of(const std::string& option, const std::string& text,
                                    std::size_t count) {
  std::vector<std::size_t> all;
  std::size_t at = 0;
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error(fmt::format("{} {}: {}; allowed: numbers of rests, 1 .. {}, as 2-5,7",
                                         option, text, what, count));
  };
  const auto number = [&] {
    std::size_t value = 0;
    const std::size_t begin = at;
    while (at < text.size() && text[at] >= '0' && text[at] <= '9' && at < begin + 6) {
      value = 10 * value + static_cast<std::size_t>(text[at++] - '0');
    }
    if (begin == at || value < 1 || value > count) {
      fail(begin == at ? "a number is missing" : fmt::format("there is no rest {}", value));
    }
    return value;
  };
  while (at < text.size()) {
    const std::size_t from = number();
    std::size_t until = from;
    if (at < text.size() && text[at] == '-') {
      ++at;
      until = number();
    }
    for (std::size_t each = from; each <= until; ++each) {
      all.push_back(each);
    }
    if (at < text.size() && (text[at] != ',' || at + 1 == text.size())) {
      fail("what is this?");
    }
    ++at;
  }
  return all;
}

identify::MountingAsk ask_of(const MeasureUpCommand& options, const identify::RestLog& log) {
  identify::MountingAsk ask;
  const std::vector<std::size_t> second = numbers_of("--second", options.second, log.rests.size());
  std::vector<std::size_t> first = numbers_of("--touches", options.touches, log.rests.size());
  const auto is_second = [&](std::size_t number) {
    return std::find(second.begin(), second.end(), number) != second.end();
  };
  for (std::size_t number = 1; options.touches.empty() && number <= log.rests.size(); ++number) {
    if (!is_second(number)) {
      first.push_back(number);
    }
  }
  for (const std::vector<std::size_t>* numbers : {&std::as_const(first), &second}) {
    identify::Peg peg;
    for (const std::size_t number : *numbers) {
      if (numbers == &first && is_second(number)) {
        throw std::runtime_error(
            fmt::format("rest {} is of --touches and of --second: it is on one peg", number));
      }
      peg.touches.push_back(log.rests[number - 1]);
    }
    if (numbers == &first || !peg.touches.empty()) {
      ask.pegs.push_back(peg);
    }
  }
  ask.pegs.front().height_m = options.height_m;
  ask.rise_m = options.rise_m;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (options.keep == kImuNames[static_cast<std::size_t>(axis)]) {
      ask.kept = axis;
    }
  }
  ask.touch_m = options.touch_m;
  return ask;
}

void print_rests(const identify::RestLog& log) {
  fmt::print("{}: {:.1f} s, {} rests of {:.0f} s and more\n", log.name, log.length_s,
             log.rests.size(), identify::kShortestRest_s);
  fmt::print("rest   at, s  for, s   links against the horizontal, deg (noise)\n");
  for (std::size_t n = 0; n < log.rests.size(); ++n) {
    const identify::Rest& rest = log.rests[n];
    fmt::print("{:>4} {:>7.1f} {:>7.1f}  ", n + 1, rest.begin_s, rest.length_s);
    for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
      fmt::print(" {} {:.2f} ({:.2f})", kImuNames[axis], kDegrees * rest.angle_rad[axis],
                 kDegrees * rest.deviation_rad[axis]);
    }
    fmt::print("\n");
  }
}

void print_fit(const ExcavatorProfile& profile, const identify::MountingFit& fit) {
  fmt::print("touch  at, s   off the peg, mm: before   now\n");
  for (std::size_t n = 0; n < fit.touches.size(); ++n) {
    const identify::TouchResult& touch = fit.touches[n];
    fmt::print("{:>5} {:>6.1f} {:>25.1f} {:>5.1f}{}\n", n + 1, touch.rest.begin_s,
               1e3 * touch.before_m, 1e3 * touch.after_m, touch.peg == 0 ? "" : "  second peg");
  }
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const double was_rad = profile.imu.mount[axis].turn_rad;
    fmt::print(
        "{:<7} turn {:.5f} -> {:.5f} rad: by {:.2f} deg, standard deviation {:.2f} deg, {:.1f} mm "
        "at its end\n",
        kImuNames[axis], was_rad, fit.turn_rad[axis], kDegrees * (fit.turn_rad[axis] - was_rad),
        kDegrees * fit.deviation_rad[axis], 1e3 * fit.end_m[axis]);
  }
  for (const Eigen::Vector2d& peg_m : fit.peg_m) {
    fmt::print("peg     {:.3f} m ahead of the boom foot's pin, {:.3f} m over it\n", peg_m.x(),
               peg_m.y());
  }
  fmt::print("left    {:.1f} mm RMS, {:.1f} mm at most\n", 1e3 * fit.rms_m(), 1e3 * fit.most_m());
}

std::string profile_text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string touches_from(const identify::RestLog& log) {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{} sha256 {}, {:%Y-%m-%d}", log.name, log.sha256.substr(0, kShortHash),
                     fmt::gmtime(now));
}

/// The text, which is not in its file yet, is a profile that says the new turns. `old`: the file
/// that it is made from, and maybe like another.
void assert_turns_read_back(const std::string& text, const fs::path& old,
                            const identify::MountingFit& fit) {
  constexpr double kDigits_rad = 1e-5;
  machines::ProfileDocument document = machines::read_document(old);
  machines::lay_over(document.root, toml::parse(text));
  const ExcavatorProfile found = machines::load_excavator(document).profile;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    if (std::abs(found.imu.mount[axis].turn_rad - fit.turn_rad[axis]) > kDigits_rad) {
      throw std::runtime_error(
          fmt::format("imu.{}.turn: has no place in this profile's text", kImuNames[axis]));
    }
  }
}

}  // namespace

void assert_new(const std::string& file, bool force) {
  if (fs::exists(file) && !force) {
    throw std::runtime_error(fmt::format("{}: is there already; --force overwrites it", file));
  }
}

void measure_up(const MeasureUpCommand& options) {
  const fs::path file = machines::find_profile(options.profile);
  const machines::ExcavatorMachine machine = machines::load_excavator(file);
  if (!machine.profile.imu.known()) {
    throw std::runtime_error(fmt::format(
        "{}: has no [imu]: without IMUs there is nothing to measure up", file.string()));
  }
  if (!options.out.empty()) {
    if (!toml::parse(profile_text_of(file)).contains("imu")) {
      throw std::runtime_error(
          fmt::format("{}: its [imu] is that of the profile that it is like; allowed: a profile "
                      "with an [imu] in its own text",
                      file.string()));
    }
    assert_apart({options.log, file.string()}, {options.out});
    assert_new(options.out, options.force);
    assert_writable(options.out);
  }
  const identify::RestLog log = identify::read_rests(options.log, machine.profile.imu);
  for (const std::string& note : log.notes) {
    fmt::print("note: {}\n", note);
  }
  if (!options.any_machine && log.profile_hash != 0 && log.profile_hash != machine.hash) {
    throw std::runtime_error(fmt::format(
        "{}: is of a machine with profile {:08x}, and this is {:08x}; with --any-machine that may "
        "be",
        log.name, log.profile_hash, machine.hash));
  }
  print_rests(log);
  const identify::MountingFit fit = identify::fit_mounting(machine.profile, ask_of(options, log));
  print_fit(machine.profile, fit);
  if (!options.out.empty()) {
    const std::string text = identify::mounting_text(profile_text_of(file), fit, touches_from(log));
    assert_turns_read_back(text, file, fit);
    write_whole(options.out, text);
    fmt::print("profile {}\n", options.out);
  }
}

}  // namespace graben::cli
