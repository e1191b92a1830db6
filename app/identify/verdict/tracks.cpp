// SPDX-License-Identifier: Apache-2.0
#include "app/identify/verdict/tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/identify/command_integral.hpp"
#include "app/identify/machine/median.hpp"
#include "app/identify/verdict/track_figures.hpp"
#include "app/identify/verdict/track_parts.hpp"
#include "app/identify/verdict/units.hpp"

namespace graben::identify {
namespace {

constexpr double kFinest_s = 0.02;  // Rows of a grid; finer says nothing more of a valve.
constexpr double kCoarsest_s = 0.1;
constexpr double kMostRows = 60000.0;  // Of the grid: seconds of work.
constexpr double kShortest_s = 5.0;    // A piece.
constexpr double kPiece_s = 60.0;      // A longer one is several.
constexpr double kJumps = 0.02;        // Of all values, where two machines speak.

[[noreturn]] void refuse(const SignalLog& log, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", log.name, what));
}

/// Value at a time, straight between two; the nearest beyond its ends.
class Between {
 public:
  Between(const Signal& signal, const UnitGuess& unit) : signal_(signal), unit_(unit) {}

  double at(double time_s) {
    const std::vector<double>& times = signal_.time_s;
    while (next_ > 0 && times[next_ - 1] > time_s) {
      --next_;
    }
    while (next_ < times.size() && times[next_] <= time_s) {
      ++next_;
    }
    double value = 0.0;
    if (next_ == 0) {
      value = signal_.value.front();
    } else if (next_ == times.size()) {
      value = signal_.value.back();
    } else {
      const double part = (time_s - times[next_ - 1]) / (times[next_] - times[next_ - 1]);
      value = signal_.value[next_ - 1] + part * (signal_.value[next_] - signal_.value[next_ - 1]);
    }
    return value * unit_.scale + unit_.offset;
  }

 private:
  const Signal& signal_;
  UnitGuess unit_;
  std::size_t next_ = 0;
};

class Maker {
 public:
  explicit Maker(const SignalLog& log) : log_(log) {
    for (std::size_t drive = 0; drive < kDriveNames.size(); ++drive) {
      const Parts parts = parts_of(log, static_cast<int>(drive));
      if (!parts.command.empty() || parts.position != nullptr || parts.velocity != nullptr) {
        parts_.push_back(parts);
        DriveTrack track;
        track.drive = static_cast<int>(drive);
        tracks_.drive.push_back(track);
      }
    }
  }

  Tracks make() {
    choose_clock();
    cut();
    for (std::size_t at = 0; at < parts_.size(); ++at) {
      describe(at);
    }
    say_unused(log_, parts_, tracks_.notes);
    for (Tracks::Piece& piece : tracks_.pieces) {
      fill(piece);
    }
    for (std::size_t at = 0; at < parts_.size(); ++at) {
      const Parts& parts = parts_[at];
      const Signal* motion = parts.position != nullptr ? parts.position : parts.velocity;
      tracks_.drive[at].figures = figures_of(tracks_, at);
      if (motion != nullptr) {
        tracks_.drive[at].figures.step_s = usual_step(motion->time_s);
        tracks_.drive[at].figures.rate_hz =
            new_rate_hz(*motion, 1e-3 * tracks_.drive[at].figures.travel /
                                     std::max(1e-12, units_[at].position.scale));
      }
    }
    return std::move(tracks_);
  }

 private:
  /// Of all motions the one with the most values.
  void choose_clock() {
    if (parts_.empty()) {
      refuse(log_,
             "no drive is in it: no command, angle or stroke of boom, arm, bucket, swing, "
             "blade, tilt or track, by the names of its columns");
    }
    for (const Parts& parts : parts_) {
      for (const Signal* signal : {parts.position, parts.velocity}) {
        if (signal != nullptr &&
            (clock_ == nullptr || signal->value.size() > clock_->value.size())) {
          clock_ = signal;
        }
      }
    }
    if (clock_ == nullptr) {
      refuse(log_,
             "commands are in it, but nothing says where a drive is or how fast: no angle, "
             "stroke or speed");
    }
    std::size_t positions = 0;
    std::size_t jumping = 0;
    for (const Parts& parts : parts_) {
      if (parts.position != nullptr) {
        ++positions;
        jumping += jump_share(*parts.position) > kJumps ? 1 : 0;
      }
    }
    if (jumping > 0 && 2 * jumping >= positions) {
      refuse(log_, fmt::format("positions of {} of {} drives jump to and fro: two machines in one "
                               "log, or read by the DBC of another",
                               jumping, positions));
    }
  }

  void cut() {
    const std::vector<double>& time_s = clock_->time_s;
    tracks_.recorded_s = usual_step(time_s);
    const double gap_s = longest_step(tracks_.recorded_s);
    std::vector<std::pair<double, double>> whole;
    double begin_s = time_s.front();
    for (std::size_t at = 1; at <= time_s.size(); ++at) {
      const bool ends = at == time_s.size() || time_s[at] - time_s[at - 1] > gap_s;
      if (ends) {
        whole.emplace_back(begin_s, time_s[at - 1]);
        tracks_.length_s += time_s[at - 1] - begin_s;
        if (at < time_s.size()) {
          const double apart_s = time_s[at] - time_s[at - 1];
          ++tracks_.gaps;
          tracks_.longest_gap_s = std::max(tracks_.longest_gap_s, apart_s);
          begin_s = time_s[at];
        }
      }
    }
    tracks_.step_s = std::clamp(std::max(tracks_.recorded_s, tracks_.length_s / kMostRows),
                                kFinest_s, kCoarsest_s);
    const double shortest_s = std::min(kShortest_s, 0.9 * tracks_.length_s);
    if (tracks_.length_s < 2.0) {
      refuse(log_,
             fmt::format("{:.1f} s of motion are in it: too short for anything", tracks_.length_s));
    }
    for (const auto& [from_s, until_s] : whole) {
      for (double at_s = from_s; until_s - at_s >= shortest_s;) {
        double end_s = std::min(until_s, at_s + kPiece_s);
        end_s = until_s - end_s < shortest_s ? until_s : end_s;
        Tracks::Piece piece;
        const auto rows = static_cast<std::size_t>((end_s - at_s) / tracks_.step_s);
        for (std::size_t row = 0; row < rows; ++row) {
          piece.time_s.push_back(at_s + tracks_.step_s * static_cast<double>(row));
        }
        tracks_.pieces.push_back(std::move(piece));
        at_s = end_s;
      }
    }
    thin();
    for (const Tracks::Piece& piece : tracks_.pieces) {
      tracks_.looked_s += piece.time_s.back() - piece.time_s.front();
    }
    if (tracks_.pieces.empty()) {
      refuse(log_, fmt::format("no {} s in one piece are in it ({:.1f} s in {} pieces)",
                               kShortest_s, tracks_.length_s, whole.size()));
    }
  }

  /// Evenly, so many pieces as can be worked on.
  void thin() {
    double rows = 0.0;
    for (const Tracks::Piece& piece : tracks_.pieces) {
      rows += static_cast<double>(piece.time_s.size());
    }
    const auto every = static_cast<std::size_t>(std::ceil(rows / (1.05 * kMostRows)));
    if (every > 1) {
      std::vector<Tracks::Piece> some;
      for (std::size_t at = 0; at < tracks_.pieces.size(); at += every) {
        some.push_back(std::move(tracks_.pieces[at]));
      }
      tracks_.pieces = std::move(some);
    }
  }

  void describe(std::size_t at) {
    const Parts& parts = parts_[at];
    DriveTrack& track = tracks_.drive[at];
    const bool turns = track.drive == 3;
    track.has_command = !parts.command.empty();
    track.from_spool = parts.from_spool && track.has_command;
    units_.emplace_back();
    for (const Signal* command : parts.command) {
      const bool one_sided = command->meaning.side != 0;
      const UnitGuess unit = command_unit(command->value, command->meaning.unit, one_sided);
      units_.back().command.push_back(unit);
      track.sources.push_back(fmt::format(
          "{}: {}{}, {}", command->name, what_text(command->meaning.what),
          one_sided ? (command->meaning.side > 0 ? " of one direction" : " of the other") : "",
          unit.said));
    }
    track.has_motion = parts.position != nullptr || parts.velocity != nullptr;
    track.only_velocity = parts.position == nullptr && parts.velocity != nullptr;
    if (parts.position != nullptr) {
      track.length = parts.position->meaning.length;
      units_.back().position =
          position_unit(parts.position->value, parts.position->meaning.unit, track.length, turns);
      track.sources.push_back(
          fmt::format("{}: position, {}", parts.position->name, units_.back().position.said));
    }
    if (parts.velocity != nullptr) {
      describe_velocity(parts, track);
    }
  }

  /// By where it leads, where a position says that too.
  void describe_velocity(const Parts& parts, DriveTrack& track) {
    const Signal& velocity = *parts.velocity;
    UnitGuess& unit = units_.back().velocity;
    if (parts.position == nullptr) {
      track.length = velocity.meaning.length;
      const auto [least, most] = std::minmax_element(velocity.value.begin(), velocity.value.end());
      const double largest = std::max(-*least, *most);
      const Unit named = velocity.meaning.unit;
      const bool fast = largest > (track.length ? 8.0 : 4.0);
      unit.scale =
          track.length
              ? (named == Unit::kMillimetre || (named != Unit::kMetre && fast) ? 1e-3 : 1.0)
              : (named == Unit::kDegree || (named != Unit::kRad && fast) ? 0.017453292519943295
                                                                         : 1.0);
      track.sources.push_back(fmt::format("{}: speed, {}", velocity.name,
                                          unit.scale == 1.0
                                              ? (track.length ? "m/s" : "rad/s")
                                              : (track.length ? "mm/s" : "degrees/s")));
      return;
    }
    Between position(*parts.position, units_.back().position);
    Between speed(velocity, {});
    double both = 0.0;
    double own = 0.0;
    double other = 0.0;
    for (double at_s = velocity.time_s.front() + 0.5; at_s < velocity.time_s.back() - 0.5;
         at_s += 0.25) {
      const double rate = (position.at(at_s + 0.1) - position.at(at_s - 0.1)) / 0.2;
      const double said = (speed.at(at_s - 0.1) + speed.at(at_s) + speed.at(at_s + 0.1)) / 3.0;
      both += rate * said;
      own += said * said;
      other += rate * rate;
    }
    const double agrees = own * other > 0.0 ? both / std::sqrt(own * other) : 0.0;
    const double factor = own > 0.0 ? both / own : 0.0;
    constexpr double kAgrees = 0.7;
    std::string text;
    if (std::abs(agrees) < kAgrees) {
      text = "does not go where the position goes: not used";
    } else if (factor < 0.0) {
      text = "of the other sign than the position: the position counts";
    } else if (factor > 0.9 && factor < 1.1) {
      text = "agrees with the position";
    } else if (std::abs(factor * 57.29577951308232 - 1.0) < 0.1) {
      text = "degrees/s beside a position in rad";
    } else {
      text = fmt::format("times {:.3g} it is the position's: the position counts", factor);
    }
    track.sources.push_back(fmt::format("{}: speed, {}", velocity.name, text));
  }

  void fill(Tracks::Piece& piece) {
    const std::size_t rows = piece.time_s.size();
    const auto back =
        std::max<std::size_t>(1, static_cast<std::size_t>(kWindow_s / tracks_.step_s + 0.5));
    for (std::size_t row = 0; row < rows; ++row) {
      piece.since.push_back(row < back ? 0 : row - back);
    }
    for (std::size_t at = 0; at < parts_.size(); ++at) {
      const Parts& parts = parts_[at];
      std::vector<double> command(rows, 0.0);
      for (std::size_t n = 0; n < parts.command.size(); ++n) {
        const Signal& signal = *parts.command[n];
        const UnitGuess& unit = units_[at].command[n];
        const double side = signal.meaning.side < 0 ? -1.0 : 1.0;
        const CommandIntegral integral(signal.time_s, signal.value, true);
        CommandIntegral::Place place;
        const auto begin = std::lower_bound(signal.time_s.begin(), signal.time_s.end(),
                                            piece.time_s.front() - 1.0);
        place.row = std::min(static_cast<std::size_t>(begin - signal.time_s.begin()),
                             signal.time_s.size() - 1);
        for (std::size_t row = 0; row < rows; ++row) {
          double mean = 0.0;
          integral.pieces(piece.time_s[row], piece.time_s[row] + tracks_.step_s, place,
                          [&](double value, double share) { mean += share * value; });
          command[row] += side * (mean * unit.scale + unit.offset);
        }
      }
      for (double& value : command) {
        value = std::clamp(value, -1.0, 1.0);
      }
      piece.blind.push_back(
          blind_rows(parts.position != nullptr ? parts.position : parts.velocity, piece.time_s));
      std::vector<double> position(rows, 0.0);
      std::vector<double> velocity(rows, 0.0);
      if (parts.position != nullptr) {
        Between value(*parts.position, units_[at].position);
        for (std::size_t row = 0; row < rows; ++row) {
          position[row] = value.at(piece.time_s[row]);
        }
        for (std::size_t row = 1; row < rows; ++row) {
          const std::size_t since = piece.since[row];
          velocity[row] =
              (position[row] - position[since]) / (piece.time_s[row] - piece.time_s[since]);
        }
        velocity[0] = rows > 1 ? velocity[1] : 0.0;
      } else if (parts.velocity != nullptr) {
        Between value(*parts.velocity, units_[at].velocity);
        for (std::size_t row = 0; row < rows; ++row) {
          velocity[row] = value.at(piece.time_s[row]);
          position[row] = row == 0 ? 0.0 : position[row - 1] + velocity[row] * tracks_.step_s;
        }
      }
      piece.command.push_back(std::move(command));
      piece.position.push_back(std::move(position));
      piece.velocity.push_back(std::move(velocity));
    }
  }

  struct Units {
    std::vector<UnitGuess> command;
    UnitGuess position;
    UnitGuess velocity;
  };

  const SignalLog& log_;
  std::vector<Parts> parts_;
  std::vector<Units> units_;
  const Signal* clock_ = nullptr;
  Tracks tracks_;
};

}  // namespace

const char* DriveTrack::name() const { return kDriveNames[static_cast<std::size_t>(drive)]; }

Tracks tracks_of(const SignalLog& log) { return Maker(log).make(); }

}  // namespace graben::identify
