// SPDX-License-Identifier: Apache-2.0
#include "app/identify/imus/rest_log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "app/identify/machine/candump_reader.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "firmware/numeric/constants.hpp"
#include "hal/buses/link_imus.hpp"

namespace graben::identify {
namespace {

constexpr std::array<const char*, kAxisCount> kNames = {"boom", "arm", "bucket"};

/// So often, of its frames, an IMU may be in doubt, or early.
constexpr double kMostDoubts = 0.05;
/// A rest has no hole as long as this.
constexpr double kHole_s = 0.1;
/// Rates are averaged over so long: noise goes, motion stays.
constexpr double kAverage_s = 0.5;
/// A rate that differs so much from its middle in the rest is motion, rad/s.
constexpr double kMoves_radps = 0.0012;
/// Left out at the begin, where oil and boom still swing, and at the end.
constexpr double kSettle_s = 1.0;
constexpr double kBeforeEnd_s = 0.3;
/// Scatter is judged by the means of so long: noise of a running engine hangs together.
constexpr double kBlock_s = 0.5;

/// What an IMU showed, in the axes of its link as the profile has them.
struct Sample {
  double time_s = 0.0;
  std::size_t line = 0;
  double rate_radps = 0.0;
  Eigen::Vector2d force_mps2 = Eigen::Vector2d::Zero();
};

using Samples = std::vector<Sample>;
/// Since the log's first frame.
struct Stretch {
  double begin_s = 0.0;
  double end_s = 0.0;
};

/// Of a link that is level the force is upright.
double angle_of(const Eigen::Vector2d& force_mps2) {
  return std::atan2(force_mps2.x(), force_mps2.y());
}

class Reader {
 public:
  Reader(std::string name, const ImuProfile& imus)
      : name_(std::move(name)), imus_(imus), decoder_(addresses(imus)) {}

  void take(const LoggedFrame& frame);
  [[nodiscard]] const std::array<Samples, kAxisCount>& samples() const { return samples_; }
  [[nodiscard]] std::uint32_t profile_hash() const { return profile_hash_; }
  [[nodiscard]] double length_s() const { return last_s_ - first_s_; }
  /// Throws where one of them is missing.
  void assert_heard() const;

 private:
  static ImuAddresses addresses(const ImuProfile& imus) {
    ImuAddresses all{};
    for (std::size_t i = 0; i < kAxisCount; ++i) {
      all[i] = imus.mount[i].address;
    }
    return all;
  }
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", name_, line, what));
  }
  void identify(const LoggedFrame& frame);
  void note_sender(const LoggedFrame& frame);
  void keep(std::size_t axis, const LoggedFrame& frame, double now_s);

  std::string name_;
  const ImuProfile& imus_;
  LinkImus decoder_;
  std::array<ImuInputs, kImuCount> inputs_{};
  std::array<TimeUs, kAxisCount> taken_us_{};
  std::array<Samples, kAxisCount> samples_;
  std::array<std::size_t, kAxisCount> doubts_{};  ///< Frames after which its values are errors.
  std::array<std::size_t, kAxisCount> first_doubt_{};
  std::set<int> heard_;  ///< Addresses that send angular rates.
  std::uint32_t profile_hash_ = 0;
  bool any_ = false;
  double first_s_ = 0.0;
  double last_s_ = 0.0;
};

void Reader::identify(const LoggedFrame& frame) {
  const auto message = dbc::excavator::MachineIdentity::decode(frame.data);
  const std::uint32_t hash = message.profile_hash.value;
  if (profile_hash_ != 0 && hash != profile_hash_) {
    fail(frame.line, fmt::format("two machines in one log: profile {:08x}, before {:08x}", hash,
                                 profile_hash_));
  }
  profile_hash_ = hash;
}

void Reader::note_sender(const LoggedFrame& frame) {
  constexpr std::uint32_t kGroupBits = 0x03FFFF00U;
  if ((frame.id & kGroupBits) == (dbc::j1939::ARI::kId & kGroupBits)) {
    heard_.insert(static_cast<int>(frame.id & 0xFFU));
  }
}

void Reader::keep(std::size_t axis, const LoggedFrame& frame, double now_s) {
  const ImuInputs& imu = inputs_[axis];
  const ImuMount& mount = imus_.mount[axis];
  if (std::min(imu.rates.validity, imu.forces.validity) == Validity::kError) {
    first_doubt_[axis] = doubts_[axis]++ == 0 ? frame.line : first_doubt_[axis];
    return;
  }
  const TimeUs stamp_us = std::min(imu.rates.stamp_us, imu.forces.stamp_us);
  const bool both = imu.rates.validity == Validity::kValid &&
                    imu.forces.validity == Validity::kValid && stamp_us != taken_us_[axis];
  if (!both) {
    return;
  }
  taken_us_[axis] = stamp_us;
  const double front = mount.backwards ? -1.0 : 1.0;
  const Eigen::Vector2d shown(front * imu.forces.value.longitudinal_mps2,
                              imu.forces.value.vertical_mps2);
  samples_[axis].push_back({now_s, frame.line, front * imu.rates.value.pitch_radps,
                            Eigen::Rotation2Dd(mount.turn_rad) * shown});
}

void Reader::take(const LoggedFrame& frame) {
  if (!any_) {
    first_s_ = frame.time_s;
    last_s_ = frame.time_s;
    any_ = true;
  }
  last_s_ = frame.time_s;
  if (frame.extended && same_message(frame.id, dbc::excavator::MachineIdentity::kId)) {
    return identify(frame);
  }
  CanFrame can;
  can.id = frame.id;
  can.extended = frame.extended;
  can.length = frame.length;
  can.data = frame.data;
  const double now_s = last_s_ - first_s_;
  // The time 0 stands for 'never'.
  const auto now_us = static_cast<TimeUs>(std::llround(now_s * 1e6)) + kSecondUs;
  if (frame.extended) {
    note_sender(frame);
  }
  if (decoder_.take(can, now_us, inputs_)) {
    for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
      keep(axis, frame, now_s);
    }
  }
}

void Reader::assert_heard() const {
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    if (samples_[axis].empty()) {
      throw std::runtime_error(fmt::format(
          "{}: no angular rates and accelerations of the {}'s IMU (address {}) are in it; heard: "
          "{}",
          name_, kNames[axis], imus_.mount[axis].address,
          heard_.empty() ? std::string("no IMU at all") : fmt::format("{}", heard_)));
    }
    const auto doubts = static_cast<double>(doubts_[axis]);
    if (doubts > kMostDoubts * static_cast<double>(samples_[axis].size())) {
      fail(first_doubt_[axis],
           fmt::format("the {}'s IMU (address {}) says that it is in doubt, or two send as it, and "
                       "not only here",
                       kNames[axis], imus_.mount[axis].address));
    }
  }
}

/// Mean rate over kAverage_s about each sample.
std::vector<double> averaged(const Samples& samples) {
  std::vector<double> sums = {0.0};
  for (const Sample& sample : samples) {
    sums.push_back(sums.back() + sample.rate_radps);
  }
  std::vector<double> mean(samples.size());
  std::size_t from = 0;
  std::size_t until = 0;
  for (std::size_t at = 0; at < samples.size(); ++at) {
    while (samples[from].time_s < samples[at].time_s - 0.5 * kAverage_s) {
      ++from;
    }
    while (until < samples.size() &&
           samples[until].time_s <= samples[at].time_s + 0.5 * kAverage_s) {
      ++until;
    }
    mean[at] = (sums[until] - sums[from]) / static_cast<double>(until - from);
  }
  return mean;
}

/// Longest first is not asked for: in the order of time. Where `still` holds for each sample.
template <class Still>
std::vector<Stretch> stretches_of(const Samples& samples, const Stretch& within, Still still) {
  std::vector<Stretch> all;
  Stretch now;
  bool open = false;
  const auto close = [&] {
    if (open && now.end_s - now.begin_s >= kShortestRest_s) {
      all.push_back(now);
    }
    open = false;
  };
  for (std::size_t at = 0; at < samples.size(); ++at) {
    const double time_s = samples[at].time_s;
    if (time_s < within.begin_s || time_s > within.end_s) {
      continue;
    }
    if (!still(at) || (open && time_s - now.end_s > kHole_s)) {
      close();
    }
    if (still(at)) {
      now.begin_s = open ? now.begin_s : time_s;
      now.end_s = time_s;
      open = true;
    }
  }
  close();
  return all;
}

std::vector<Stretch> both_of(const std::vector<Stretch>& one, const std::vector<Stretch>& other) {
  std::vector<Stretch> all;
  for (const Stretch& a : one) {
    for (const Stretch& b : other) {
      const Stretch common{std::max(a.begin_s, b.begin_s), std::min(a.end_s, b.end_s)};
      if (common.end_s - common.begin_s >= kShortestRest_s) {
        all.push_back(common);
      }
    }
  }
  return all;
}

/// First by what a gyro's bias may be, then by the middle of its own rate in there.
std::vector<Stretch> rests_of(const Samples& samples, const ImuProfile& imus) {
  const std::vector<double> rate = averaged(samples);
  const double slow_radps = 3.0 * imus.rate_bias_radps + kMoves_radps;
  std::vector<Stretch> all;
  for (const Stretch& slow :
       stretches_of(samples, {0.0, samples.back().time_s},
                    [&](std::size_t at) { return std::abs(rate[at]) < slow_radps; })) {
    std::vector<double> inside;
    for (std::size_t at = 0; at < samples.size(); ++at) {
      if (samples[at].time_s >= slow.begin_s && samples[at].time_s <= slow.end_s) {
        inside.push_back(rate[at]);
      }
    }
    std::nth_element(inside.begin(), inside.begin() + static_cast<long>(inside.size() / 2),
                     inside.end());
    const double bias_radps = inside[inside.size() / 2];
    const std::vector<Stretch> still = stretches_of(samples, slow, [&](std::size_t at) {
      return std::abs(rate[at] - bias_radps) < kMoves_radps;
    });
    all.insert(all.end(), still.begin(), still.end());
  }
  return all;
}

/// Where gravity was between two times.
struct Mean {
  double angle_rad = 0.0;
  double deviation_rad = 0.0;
};

Mean mean_of(const Samples& samples, const Stretch& of) {
  std::vector<double> blocks;
  Eigen::Vector2d all = Eigen::Vector2d::Zero();
  Eigen::Vector2d block = Eigen::Vector2d::Zero();
  double block_end_s = of.begin_s + kBlock_s;
  for (const Sample& sample : samples) {
    if (sample.time_s < of.begin_s || sample.time_s > of.end_s) {
      continue;
    }
    if (sample.time_s > block_end_s) {
      blocks.push_back(angle_of(block));
      block.setZero();
      block_end_s += kBlock_s;
    }
    block += sample.force_mps2;
    all += sample.force_mps2;
  }
  Mean mean;
  mean.angle_rad = angle_of(all);
  double square = 0.0;
  for (const double angle_rad : blocks) {
    const double off_rad = std::remainder(angle_rad - mean.angle_rad, kTwoPi);
    square += off_rad * off_rad;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(2, blocks.size()));
  mean.deviation_rad = std::sqrt(square / (count - 1.0) / count);
  return mean;
}

Rest rest_of(const std::array<Samples, kAxisCount>& samples, const Stretch& of) {
  Rest rest;
  rest.begin_s = of.begin_s;
  rest.length_s = of.end_s - of.begin_s;
  const double middle_s = 0.5 * (of.begin_s + of.end_s);
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const Mean mean = mean_of(samples[axis], of);
    rest.angle_rad[axis] = mean.angle_rad;
    rest.deviation_rad[axis] = mean.deviation_rad;
    rest.turned_rad[axis] =
        std::remainder(mean_of(samples[axis], {middle_s, of.end_s}).angle_rad -
                           mean_of(samples[axis], {of.begin_s, middle_s}).angle_rad,
                       kTwoPi);
  }
  const auto first =
      std::find_if(samples[kBoom].begin(), samples[kBoom].end(),
                   [&](const Sample& sample) { return sample.time_s >= of.begin_s; });
  rest.line = first == samples[kBoom].end() ? 0 : first->line;
  return rest;
}

}  // namespace

RestLog read_rests(const std::filesystem::path& file, const ImuProfile& imus) {
  RestLog log;
  log.name = file.filename().string();
  Reader reader(log.name, imus);
  const LogRead read = read_candump(file, [&](const LoggedFrame& frame) { reader.take(frame); });
  log.sha256 = read.sha256;
  log.notes = read.notes();
  reader.assert_heard();
  log.profile_hash = reader.profile_hash();
  log.length_s = reader.length_s();
  std::vector<Stretch> common = rests_of(reader.samples()[kBoom], imus);
  for (const int axis : {kArm, kBucket}) {
    common = both_of(common, rests_of(reader.samples()[static_cast<std::size_t>(axis)], imus));
  }
  for (Stretch& each : common) {
    each.begin_s += kSettle_s;
    each.end_s -= kBeforeEnd_s;
    if (each.end_s - each.begin_s >= kShortestRest_s - kSettle_s - kBeforeEnd_s) {
      log.rests.push_back(rest_of(reader.samples(), each));
    }
  }
  if (log.rests.empty()) {
    throw std::runtime_error(
        fmt::format("{}: in {:.1f} s the links never rested for {} s; hold each touch for 10 s",
                    log.name, log.length_s, kShortestRest_s));
  }
  return log;
}

}  // namespace graben::identify
