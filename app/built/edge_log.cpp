// SPDX-License-Identifier: Apache-2.0
#include "app/built/edge_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/identify/machine/log_version.hpp"
#include "app/runs/logged_machine.hpp"
#include "hal/buses/common_messages.hpp"

namespace graben::built {
namespace {

/// So many of a machine's frames may be damaged or out of sequence.
constexpr double kMostDoubtful = 0.05;
/// An edge that went no farther has not worked: sensors' noise, a machine that was warmed up.
constexpr double kLeastWay_m = 0.2;

class Reader {
 public:
  Reader(std::string name, const machines::AnyMachine& machine, const EdgeAsk& ask,
         const std::function<void(const EdgeStep&)>& take)
      : name_(std::move(name)),
        ask_(ask),
        own_hash_(std::visit([](const auto& any) { return any.hash; }, machine)),
        is_dozer_(std::holds_alternative<machines::DozerMachine>(machine)),
        edge_(machine_edge(machine, ask.width_m)),
        give_([this, &take](const EdgeStep& step) {
          log_.worked_m += step.to.at_work ? step.way_m() : 0.0;
          take(step);
        }),
        sweeps_(give_) {}

  void take(const identify::LoggedFrame& logged) {
    if (!any_) {
      any_ = true;
      log_.from_s = logged.time_s;
      next_us_ = since_us(logged.time_s) + ground::kPeriod_us;
    }
    log_.until_s = logged.time_s;
    look_until(since_us(logged.time_s));
    if (logged.extended && logged.length == dbc::common::EcuIdentity::kLength) {
      identify(logged);
    }
    CanFrame frame;
    frame.id = logged.id;
    frame.extended = logged.extended;
    frame.length = logged.length;
    frame.data = logged.data;
    edge_->take(frame, since_us(logged.time_s));
  }

  EdgeLog finish(identify::LogRead read) {
    look_until(since_us(log_.until_s) + ground::kPeriod_us);
    sweeps_.end();
    log_.read = std::move(read);
    judge();
    return std::move(log_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", name_, what));
  }

  /// The time 0 stands for 'never'.
  [[nodiscard]] TimeUs since_us(double time_s) const {
    return std::llround(1e6 * (time_s - log_.from_s)) + kSecondUs;
  }

  /// Each cycle sees the frames up to it. Nobody looks while nothing is on the bus.
  void look_until(TimeUs now_us) {
    if (now_us - next_us_ > kSecondUs) {
      look(next_us_);
      next_us_ = now_us;
      before_.reset();
    }
    for (; next_us_ < now_us; next_us_ += ground::kPeriod_us) {
      look(next_us_);
    }
  }

  void look(TimeUs now_us) {
    std::optional<EdgePlace> place = edge_->look(now_us);
    if (!place) {
      return;
    }
    place->at_work = place->at_work || ask_.every;
    if (before_ && now_us - before_us_ <= ground::kGap_us &&
        EdgeStep{*before_, *place, 0.0}.way_m() < ground::kLeap_m) {
      const EdgeStep step{*before_, *place,
                          log_.from_s + 1e-6 * static_cast<double>(now_us - kSecondUs)};
      log_.known_s += 1e-6 * static_cast<double>(now_us - before_us_);
      log_.way_m += step.way_m();
      // A dozer's, and where each place counts, it is known at once.
      is_dozer_ || ask_.every ? give_(step) : sweeps_.add(step);
    } else {
      sweeps_.end();
    }
    before_ = place;
    before_us_ = now_us;
  }

  void identify(const identify::LoggedFrame& frame) {
    std::uint32_t hash = 0;
    if (same_message(frame.id, dbc::common::EcuIdentity::kId)) {
      hash = dbc::common::EcuIdentity::decode(frame.data).profile_hash.value;
    } else if (same_message(frame.id, dbc::common::MachineIdentity::kId)) {
      hash = dbc::common::MachineIdentity::decode(frame.data).profile_hash.value;
    }
    if (hash == 0 || hash == hash_) {
      return;
    }
    if (hash_ != 0) {
      refuse(fmt::format("line {}: two machines in one log: profile {:08x}, before {:08x}",
                         frame.line, hash, hash_));
    }
    hash_ = hash;
    if (hash != own_hash_ && !ask_.any_machine) {
      refuse(other_machine(hash));
    }
  }

  [[nodiscard]] std::string other_machine(std::uint32_t hash) const {
    const auto its = runs::machine_of_hash(hash, ask_.profile, ask_.bus);
    if (its && its->profile == ask_.profile && !its->bus.empty()) {
      return fmt::format("its machine is on bus {0}; --bus {0} reads it", its->bus);
    }
    return fmt::format(
        "is of another machine than {} ({:08x}): of {}; with --any-machine it is posed by this "
        "profile all the same",
        ask_.profile, own_hash_, runs::machine_words(hash, ask_.profile, ask_.bus));
  }

  void judge() const {
    const LinkCounters counters = edge_->counters();
    const char* kind = is_dozer_ ? "a dozer" : "an excavator";
    if (log_.read.frames == 0) {
      refuse("is empty: no frame is in it");
    }
    // What is out of sequence: another sender of the same frames.
    const double doubtful = static_cast<double>(counters.wrong_crc) + counters.wrong_counter +
                            counters.masquerade + counters.wrong_length + counters.out_of_range;
    const double all = doubtful + counters.accepted;
    if (doubtful > kMostDoubtful * std::max(1.0, all)) {
      refuse(
          fmt::format("{:.0f} % of the machine's frames are damaged or out of sequence (at most "
                      "{:.0f} % may be): two machines on one bus, or a log with pieces that are "
                      "lost",
                      100.0 * doubtful / all, 100.0 * kMostDoubtful));
    }
    if (hash_ == 0 && !ask_.any_machine && counters.accepted > 0) {
      refuse(
          "no frame says which profile its machine has (EcuIdentity, MachineIdentity); with "
          "--any-machine it is taken for this one");
    }
    if (log_.known_s <= 0.0) {
      refuse(fmt::format(
          "nowhere is all known that says, by this profile, where the edge of {} is: {}", kind,
          is_dozer_ ? "its strokes and the body's pose"
                    : "its strokes or angles, and the swing where it has one"));
    }
    if (log_.way_m < kLeastWay_m) {
      refuse(fmt::format("is without motion: the edge went {:.0f} mm", 1e3 * log_.way_m));
    }
    if (!edge_->tells_work() && !ask_.every) {
      refuse(
          "nothing in it says when the edge was at the ground (EcuTipLoad has no force: its "
          "controller does not know pressures or masses); with --ground every each place where "
          "the edge was counts");
    }
  }

  std::string name_;
  const EdgeAsk& ask_;
  std::uint32_t own_hash_;
  bool is_dozer_;
  std::unique_ptr<MachineEdge> edge_;
  const std::function<void(const EdgeStep&)> give_;
  ground::WorkSweeps sweeps_;
  EdgeLog log_;
  bool any_ = false;
  std::uint32_t hash_ = 0;
  TimeUs next_us_ = 0;
  std::optional<EdgePlace> before_;
  TimeUs before_us_ = 0;
};

}  // namespace

EdgeLog read_edge(const std::filesystem::path& file, const machines::AnyMachine& machine,
                  const EdgeAsk& ask, const std::function<void(const EdgeStep&)>& take) {
  Reader reader(file.string(), machine, ask, take);
  identify::LogRead read = identify::read_versioned(
      file, [&reader](const identify::LoggedFrame& frame) { reader.take(frame); });
  return reader.finish(std::move(read));
}

}  // namespace graben::built
