// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/built/edge_log.hpp"
#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/machines/any_machine.hpp"
#include "app/machines/plain_text.hpp"
#include "app/machines/profile_file.hpp"
#include "app/machines/site_frame.hpp"

namespace graben::cli {
namespace {

/// The edge is looked at for so long to either side of a moment, and stands if it stays within
/// that.
constexpr double kLook_s = 0.25;
constexpr double kStands_m = 0.01;

struct SiteCommand {
  std::vector<std::string> touched;
  std::string log;
  built::EdgeAsk ask;
  double bound_m = machines::kUsualBound_m;
};

/// A touched point, by the place of the teeth or by the moment of a log.
struct Touched {
  machines::TouchedPoint point;
  std::optional<double> at_s;
};

std::vector<double> numbers_of(const std::string& text, const std::string& word) {
  std::vector<double> numbers;
  std::size_t from = 0;
  while (from <= text.size()) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    const std::optional<double> value =
        machines::number_in(std::string_view(text).substr(from, to - from));
    if (!value) {
      throw std::runtime_error(
          fmt::format("--touched: '{}'; allowed: east,north,height=x,y,z of the site and of the "
                      "teeth, m, or east,north,height@seconds of a --log",
                      word));
    }
    numbers.push_back(*value);
    from = to + 1;
  }
  return numbers;
}

Touched touched_of(const std::string& word) {
  const std::size_t at = word.find_first_of("=@");
  const std::vector<double> site = numbers_of(word.substr(0, at), word);
  const std::vector<double> other =
      at == std::string::npos ? std::vector<double>{} : numbers_of(word.substr(at + 1), word);
  const bool by_log = at != std::string::npos && word[at] == '@';
  if (site.size() != 3 || other.size() != (by_log ? 1U : 3U)) {
    throw std::runtime_error(fmt::format(
        "--touched: '{}': {} and {} numbers; allowed: 3 of the site, and 3 of the teeth or "
        "@seconds",
        word, site.size(), other.size()));
  }
  Touched touched;
  touched.point.site_m = {site[0], site[1], site[2]};
  if (by_log) {
    touched.at_s = other[0];
  } else {
    touched.point.machine_m = {other[0], other[1], other[2]};
  }
  return touched;
}

/// Where the edge's middle stood about a moment.
class Stand {
 public:
  void add(const Eigen::Vector3d& place_m) {
    least_m_ = count_ == 0 ? place_m : Eigen::Vector3d(least_m_.cwiseMin(place_m));
    most_m_ = count_ == 0 ? place_m : Eigen::Vector3d(most_m_.cwiseMax(place_m));
    sum_m_ += place_m;
    ++count_;
  }
  [[nodiscard]] Eigen::Vector3d place_m(double at_s) const {
    if (count_ == 0) {
      throw std::runtime_error(
          fmt::format("--touched: at {} s of the log the place of the edge is not known", at_s));
    }
    const double moved_m = (most_m_ - least_m_).norm();
    if (moved_m > kStands_m) {
      throw std::runtime_error(fmt::format(
          "--touched: at {} s of the log the edge moves, {:.3f} m within {} s; allowed: {} m", at_s,
          moved_m, 2.0 * kLook_s, kStands_m));
    }
    return sum_m_ / count_;
  }

 private:
  Eigen::Vector3d least_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d most_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum_m_ = Eigen::Vector3d::Zero();
  int count_ = 0;
};

void read_stands(const SiteCommand& told, std::vector<Touched>& points) {
  if (told.log.empty() || told.ask.profile.empty()) {
    throw std::runtime_error("--touched with @seconds needs --log and --profile");
  }
  built::EdgeAsk ask = told.ask;
  ask.every = true;
  const machines::AnyMachine machine = machines::load_any(machines::find_profile(told.ask.profile));
  // Once for when it begins: its first frames need not say where the edge is.
  const double begin_s =
      built::read_edge(told.log, machine, ask, [](const built::EdgeStep&) {}).from_s;
  std::vector<Stand> stands(points.size());
  static_cast<void>(built::read_edge(told.log, machine, ask, [&](const built::EdgeStep& step) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].at_s && std::abs(step.time_s - begin_s - *points[i].at_s) <= kLook_s) {
        stands[i].add(0.5 * (step.to.left_m + step.to.right_m));
      }
    }
  }));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].at_s) {
      points[i].point.machine_m = stands[i].place_m(*points[i].at_s);
    }
  }
}

void tell_site(const SiteCommand& told) {
  std::vector<Touched> touched;
  for (const std::string& word : told.touched) {
    touched.push_back(touched_of(word));
  }
  if (std::any_of(touched.begin(), touched.end(),
                  [](const Touched& one) { return one.at_s.has_value(); })) {
    read_stands(told, touched);
  } else if (!told.log.empty()) {
    throw std::runtime_error("--log: no point is --touched at a moment of it, with @seconds");
  }
  std::vector<machines::TouchedPoint> points;
  for (const Touched& one : touched) {
    points.push_back(one.point);
  }
  const machines::SiteFit fit = machines::fit_site(points, told.bound_m);
  constexpr double kDegrees = 57.29577951308232;
  fmt::print(
      "# Of {} touched points, which fit within {:.3f} m; by {} m the heading may be off by {:.2f} "
      "deg.\n{}",
      points.size(), fit.most_off_m, told.bound_m, kDegrees * fit.heading_off_rad,
      machines::site_text(fit.frame));
}

}  // namespace

void add_site(CLI::App& app, int& status) {
  auto options = std::make_shared<SiteCommand>();
  CLI::App* command = add_command(app, "site");
  command
      ->add_option("--touched", options->touched,
                   "A point that the teeth have touched, the benchmark first: "
                   "east,north,height=x,y,z, of the site and of the teeth's middle, m, or "
                   "east,north,height@seconds from the begin of a --log")
      ->required()
      ->expected(1, 8);
  command->add_option("--log", options->log,
                      "candump log in which the teeth stood on the points for half a second");
  command->add_option("--profile", options->ask.profile,
                      "Profile of the log's machine: a file or a shipped name");
  command
      ->add_option("--bound", options->bound_m,
                   "So far the points may contradict each other, m, 0.002 .. 0.5")
      ->check(number_between(0.002, 0.5))
      ->capture_default_str();
  add_examples(*command,
               {"site --touched 100,200,54.3=5.2,0,0.1 106,200,54.4=5.2,-6,0.2",
                "site --log day.log --profile my.toml --touched 0,0,54.3@12 6,0,54.4@31"});
  command->callback([options, &status] { status = guarded("site", [&] { tell_site(*options); }); });
}

}  // namespace graben::cli
