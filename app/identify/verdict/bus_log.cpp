// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "app/identify/lines.hpp"
#include "app/identify/machine/candump_reader.hpp"
#include "app/identify/machine/other_logs.hpp"
#include "app/identify/verdict/bus_layout.hpp"
#include "app/identify/verdict/signal_log.hpp"
#include "app/machines/plain_text.hpp"
#include "hal/link/e2e.hpp"

namespace graben::identify {
namespace {

constexpr double kSome = 0.05;  // Of a message's frames: no slip of a line or of a bit.
constexpr std::uint32_t kPlainId = 0x80000000U;
constexpr std::uint32_t kSourceBits = 0xFFU;
constexpr double kMostOutside = 0.5;  // Of a DBC's values.
constexpr std::uint8_t kPdu2 = 240;   // From this PDU format on an id has no destination.

std::uint32_t key_of(std::uint32_t id, bool extended) {
  return extended ? id & 0x03FFFFFFU : id | kPlainId;
}

/// Frames of one message from one sender.
struct Heard {
  const MessageLayout* layout = nullptr;
  int source = -1;  ///< Address; below 0: an id of 11 bits.
  std::vector<Signal> signal;
  std::size_t frames = 0;
  std::size_t refused = 0;  ///< Of a wrong length or checksum.
};

/// What comes off the bus as one layout reads it.
class Collector {
 public:
  explicit Collector(BusLayout layout) : layout_(std::move(layout)) {
    for (const MessageLayout& message : layout_.message) {
      exact_.emplace(key_of(message.id, message.extended), &message);
      const bool has_source = message.extended && ((message.id >> 16U) & 0xFFU) >= kPdu2;
      if (has_source) {
        any_source_.emplace(key_of(message.id, true) & ~kSourceBits, &message);
      }
    }
  }

  void take(const LoggedFrame& frame, double time_s) {
    const std::uint32_t key = key_of(frame.id, frame.extended);
    auto found = heard_.find(key);
    if (found == heard_.end()) {
      found = heard_.emplace(key, begin(key, frame.extended)).first;
    }
    Heard& heard = found->second;
    if (heard.layout == nullptr) {
      return;
    }
    ++heard.frames;
    if (frame.length < heard.layout->length ||
        (heard.layout->is_protected && !e2e_crc_fits(frame.data, heard.layout->data_id))) {
      ++heard.refused;
      return;
    }
    heard.layout->decode(frame.data, values_);
    for (std::size_t at = 0; at < values_.size(); ++at) {
      Signal& signal = heard.signal[at];
      if (std::isfinite(values_[at])) {
        signal.time_s.push_back(time_s);
        signal.value.push_back(values_[at]);
      } else {
        ++signal.invalid;
      }
    }
  }

  [[nodiscard]] std::vector<Heard*> heard() {
    std::vector<Heard*> all;
    for (auto& [key, heard] : heard_) {
      if (heard.layout != nullptr) {
        all.push_back(&heard);
      }
    }
    return all;
  }
  [[nodiscard]] std::size_t ids() const { return heard_.size(); }
  [[nodiscard]] const BusLayout& layout() const { return layout_; }
  [[nodiscard]] const Heard* message(const std::string& name) const {
    for (const auto& [key, heard] : heard_) {
      if (heard.layout != nullptr && heard.layout->name == name) {
        return &heard;
      }
    }
    return nullptr;
  }

 private:
  Heard begin(std::uint32_t key, bool extended) {
    Heard heard;
    const auto exact = exact_.find(key);
    if (exact != exact_.end()) {
      heard.layout = exact->second;
    } else if (extended) {
      const auto any = any_source_.find(key & ~kSourceBits);
      heard.layout = any == any_source_.end() ? nullptr : any->second;
    }
    if (heard.layout != nullptr) {
      heard.source = extended ? static_cast<int>(key & kSourceBits) : -1;
      for (const LayoutSignal& signal : heard.layout->signal) {
        heard.signal.push_back({signal.name, signal.meaning, {}, {}, 0});
      }
    }
    return heard;
  }

  BusLayout layout_;
  std::unordered_map<std::uint32_t, const MessageLayout*> exact_;
  std::unordered_map<std::uint32_t, const MessageLayout*> any_source_;
  std::map<std::uint32_t, Heard> heard_;
  std::vector<double> values_;
};

bool is_of_drive(const Heard& heard) {
  return std::any_of(heard.signal.begin(), heard.signal.end(), [](const Signal& signal) {
    return signal.meaning.drive >= 0 && signal.meaning.what != What::kOther;
  });
}

std::size_t good_frames(Collector& collector) {
  std::size_t frames = 0;
  for (const Heard* heard : collector.heard()) {
    frames += is_of_drive(*heard) ? heard->frames - heard->refused : 0;
  }
  return frames;
}

std::size_t refused_frames(Collector& collector) {
  std::size_t frames = 0;
  for (const Heard* heard : collector.heard()) {
    frames += is_of_drive(*heard) ? heard->refused : 0;
  }
  return frames;
}

class BusReader {
 public:
  BusReader(const std::filesystem::path& file, const BusAsk& ask) : file_(file), ask_(ask) {
    if (ask.dbc.empty()) {
      collectors_.emplace_back(own_excavator_layout());
      collectors_.emplace_back(own_dozer_layout());
    } else {
      collectors_.emplace_back(layout_of(ask.dbc));
    }
  }

  SignalLog read() {
    log_.name = file_.filename().string();
    try {
      const LogRead read = read_candump(file_, [this](const LoggedFrame& frame) { take(frame); });
      log_.notes = read.notes();
      format_ = read.format;
    } catch (const std::runtime_error& error) {
      if (frames_ == 0) {
        throw;
      }
      log_.notes.push_back(fmt::format("{}; {} frames before that count", error.what(), frames_));
    }
    if (frames_ == 0) {
      refuse("is empty: there is no frame in it");
    }
    Collector& of = chosen();
    assert_source(of);
    assert_one_machine(of);
    take_signals(of);
    if (!of.layout().left_out.empty()) {
      log_.notes.push_back(fmt::format("{}: left out, as they can't be read: {}", of.layout().name,
                                       fmt::join(of.layout().left_out, ", ")));
    }
    log_.kind =
        fmt::format("{} of {}, {} frames of {} ids", format_, of.layout().name, frames_, of.ids());
    return std::move(log_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", file_.string(), what));
  }

  void take(const LoggedFrame& frame) {
    ++frames_;
    const double time_s = frame.time_s + kCut_s * static_cast<double>(frame.piece);
    begin_s_ = frames_ == 1 ? time_s : begin_s_;
    for (Collector& collector : collectors_) {
      collector.take(frame, time_s - begin_s_);
    }
  }

  Collector& chosen() {
    if (collectors_.size() == 1) {
      assert_dbc_fits(collectors_.front());
      return collectors_.front();
    }
    const bool excavator = strokes(collectors_[0], "BoomStroke");
    const bool dozer = strokes(collectors_[1], "BladeStroke");
    if (excavator && dozer) {
      refuse("two machines in one log: frames of an excavator and of a dozer");
    }
    const std::size_t wrong = refused_frames(collectors_[0]) + refused_frames(collectors_[1]);
    if (good_frames(collectors_[0]) + good_frames(collectors_[1]) == 0 && wrong > 0) {
      refuse(
          fmt::format("{} frames have ids of our bus, and every one of them a wrong checksum or "
                      "length: another bus, which --dbc FILE says how to read, or damaged",
                      wrong));
    }
    if (good_frames(collectors_[0]) + good_frames(collectors_[1]) == 0) {
      throw UnknownBus(
          fmt::format("{}: none of its {} ids is of our bus: --dbc FILE says how to "
                      "read it, a DBC or a bus profile",
                      file_.string(), collectors_[0].ids()));
    }
    return collectors_[dozer && !excavator ? 1 : 0];
  }

  static bool strokes(Collector& collector, const std::string& name) {
    const Heard* heard = collector.message(name);
    return heard != nullptr && heard->frames > heard->refused;
  }

  void assert_dbc_fits(Collector& of) const {
    std::size_t known = 0;
    std::size_t refused = 0;
    double outside = 0.0;
    double values = 0.0;
    for (const Heard* heard : of.heard()) {
      known += heard->frames;
      refused += heard->refused;
      for (const Signal& signal : heard->signal) {
        if (signal.meaning.drive >= 0) {
          outside += static_cast<double>(signal.invalid);
          values += static_cast<double>(signal.invalid + signal.value.size());
        }
      }
    }
    if (known == 0) {
      refuse(fmt::format("none of its {} ids is in {}: the DBC of another machine?", of.ids(),
                         of.layout().name));
    }
    if (refused > known / 2) {
      refuse(fmt::format("{} of {} frames are shorter than {} says: the DBC of another machine?",
                         refused, known, of.layout().name));
    }
    if (outside > kMostOutside * values && values > 0.0) {
      refuse(
          fmt::format("{:.0f} % of its values are outside of what {} allows: the DBC of another "
                      "machine?",
                      100.0 * outside / values, of.layout().name));
    }
    if (good_frames(of) == 0) {
      refuse(
          fmt::format("{} names no drive in the {} frames that it has: no command, angle or "
                      "stroke of boom, arm, bucket, swing, blade, tilt or track",
                      of.layout().name, known));
    }
  }

  void assert_source(Collector& of) const {
    std::set<int> sources;
    for (const Heard* heard : of.heard()) {
      if (is_of_drive(*heard) && heard->source >= 0) {
        sources.insert(heard->source);
      }
    }
    if (ask_.source >= 0 && sources.count(ask_.source) == 0) {
      refuse(fmt::format("nothing of a drive comes from --source 0x{:02X}; allowed: {}",
                         ask_.source,
                         sources.empty() ? std::string("none, as its ids have no address")
                                         : fmt::format("0x{:02X}", fmt::join(sources, ", 0x"))));
    }
  }

  /// What says where a drive is comes from one sender; and one machine has one identity.
  void assert_one_machine(Collector& of) {
    std::map<const MessageLayout*, std::vector<const Heard*>> senders;
    for (const Heard* heard : of.heard()) {
      if (is_of_drive(*heard) && heard->source >= 0) {
        senders[heard->layout].push_back(heard);
      }
    }
    for (const auto& [layout, heard] : senders) {
      std::size_t most = 0;
      for (const Heard* one : heard) {
        most = std::max(most, one->frames);
      }
      std::vector<std::string> sources;
      for (const Heard* one : heard) {
        if (static_cast<double>(one->frames) > kSome * static_cast<double>(most)) {
          sources.push_back(fmt::format("0x{:02X}", one->source));
        }
      }
      if (sources.size() > 1 && ask_.source < 0) {
        refuse(
            fmt::format("two machines in one log: {} comes from {}; --source ADDRESS chooses one",
                        layout->name, fmt::join(sources, " and ")));
      }
      several_ = several_ || sources.size() > 1;
    }
    if (const Heard* identity = of.message("MachineIdentity"); identity != nullptr) {
      for (const Signal& signal : identity->signal) {
        const std::set<double> said(signal.value.begin(), signal.value.end());
        if (signal.name == "MachineIdentity.ProfileHash" && said.size() > 1) {
          refuse(fmt::format("two machines in one log: profiles {:08x} and {:08x}",
                             static_cast<std::uint32_t>(*said.begin()),
                             static_cast<std::uint32_t>(*said.rbegin())));
        }
      }
    }
  }

  void take_signals(Collector& of) {
    std::size_t refused = 0;
    std::set<std::string> names;
    for (Heard* heard : of.heard()) {
      // Of messages that several send, the one that was asked for.
      const bool other = several_ && ask_.source >= 0 && heard->source != ask_.source &&
                         sent_by(of, heard->layout, ask_.source);
      if (other) {
        continue;
      }
      refused += heard->refused;
      names.insert(heard->layout->name);
      for (Signal& signal : heard->signal) {
        log_.signals.push_back(std::move(signal));
      }
    }
    if (refused > 0) {
      log_.notes.push_back(
          fmt::format("{} frames have a wrong checksum or length and are left out", refused));
    }
    log_.has_full_bus = names.count("BoomPressure") + names.count("ArmPressure") +
                            names.count("BucketPressure") + names.count("PumpState") +
                            names.count("EEC1") + names.count("SpoolCommand") ==
                        6;
  }

  static bool sent_by(Collector& of, const MessageLayout* layout, int source) {
    const std::vector<Heard*> all = of.heard();
    return std::any_of(all.begin(), all.end(), [&](const Heard* heard) {
      return heard->layout == layout && heard->source == source;
    });
  }

  std::filesystem::path file_;
  BusAsk ask_;
  std::vector<Collector> collectors_;
  SignalLog log_;
  std::string format_ = "log";
  std::size_t frames_ = 0;
  double begin_s_ = 0.0;
  bool several_ = false;
};

}  // namespace

SignalLog read_bus_log(const std::filesystem::path& file, const BusAsk& ask) {
  return BusReader(file, ask).read();
}

bool is_bus_log(const std::filesystem::path& file) {
  const std::string end = file.extension().string();
  const bool is_table = end == ".csv" || file.stem().extension() == ".csv";
  if (end == ".blf" || end == ".asc" || end == ".trc" || end == ".log" || end == ".candump") {
    return true;
  }
  if (!is_table && is_other_log(file)) {
    return true;
  }
  Lines lines(file.string(), "a recording, CSV, or a log of frames");
  std::string line;
  while (lines.next(line)) {
    if (!line.empty()) {
      return parse_candump(line).kind != LineKind::kBroken;
    }
  }
  return false;
}

}  // namespace graben::identify
