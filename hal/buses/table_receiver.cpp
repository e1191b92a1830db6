// SPDX-License-Identifier: Apache-2.0
#include "hal/buses/table_receiver.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/core/whole.hpp"
#include "firmware/numeric/triangle.hpp"

namespace graben {
namespace {

constexpr double kSecond_us = 1e6;
/// A sender's clock differs.
constexpr TimeUs kPaceOf10 = 8;

void increment(std::uint32_t& counter) {
  if (counter < UINT32_MAX) {
    ++counter;
  }
}

MessageRules rules_of(const BusTable* table) {
  return table == nullptr ? MessageRules{}
                          : MessageRules{table->rule.data(), table->message_count, nullptr, 0};
}

/// Of a cylinder's or a joint's sensor; null: the place is none of these.
Signal<double>* place_of_axis(SourcePlace place, std::size_t axis, ExcavatorInputs& to) {
  if (place == SourcePlace::kStroke) {
    return &to.axis[axis].stroke_m;
  }
  if (place == SourcePlace::kJointAngle) {
    return &to.joint_rad[axis];
  }
  if (place == SourcePlace::kCapPressure) {
    return &to.axis[axis].cap_pressure_pa;
  }
  if (place == SourcePlace::kRodPressure) {
    return &to.axis[axis].rod_pressure_pa;
  }
  return place == SourcePlace::kSpool ? &to.axis[axis].spool_ratio : nullptr;
}

/// Of what goes to the controller as it is; null: nothing of that.
Signal<double>* place_of(const TableSource& source, ExcavatorInputs& to) {
  if (source.place == SourcePlace::kSwash) {
    return &to.swash_ratio[source.index];
  }
  if (source.place == SourcePlace::kEngineSpeed) {
    return &to.engine_speed_radps;
  }
  return place_of_axis(source.place, source.index, to);
}

Signal<double> shown_by(const TableSource& source, const dbc::Payload& data, TimeUs now) {
  const std::int64_t raw = raw_of(source.bits, data);
  const std::uint64_t mask = (std::uint64_t{1} << source.bits.width) - 1U;
  const auto bits = static_cast<std::uint32_t>(static_cast<std::uint64_t>(raw) & mask);
  if (dbc::says(source.error_raw, source.bits.width, bits)) {
    return {0.0, Validity::kError, now};
  }
  if (dbc::says(source.missing_raw, source.bits.width, bits)) {
    return {0.0, Validity::kNotAvailable, now};
  }
  return {as_double(raw) * source.scale + source.offset, Validity::kValid, now};
}

/// A value that its sender does not say counts as right.
bool is_within(const TableSource& source, const Signal<double>& shown) {
  return shown.validity == Validity::kNotAvailable ||
         (shown.validity == Validity::kValid && shown.value >= source.least &&
          shown.value <= source.most);
}

/// Of a slope the shorter way round: a sensor may count from -180 to 180 degrees.
double change_of(const TableSource& source, double from, double to) {
  const double change = to - from;
  return std::abs(source.place == SourcePlace::kSlope ? wrap_near(change, 0.0) : change);
}

/// Of a source that is judged where its message is: its range says what holds, not what may come.
bool says_state(const TableSource& source) {
  return source.place == SourcePlace::kCondition || source.place == SourcePlace::kMerit;
}

}  // namespace

TableReceiver::TableReceiver(const BusTable* table)
    : table_(table), links_(rules_of(table), BusParts{}), nodes_(table) {}

Signal<double>* TableReceiver::kept(const TableSource& source, ExcavatorInputs& to) {
  if (source.place == SourcePlace::kSpeedLimit) {
    return &limit_ratio_;
  }
  return source.place == SourcePlace::kSlope ? &slopes_.link[source.index] : place_of(source, to);
}

/// A message of just this sender before one of any.
int TableReceiver::received(const CanFrame& frame) const {
  int found = MessageLinks::kNoMessage;
  for (std::size_t i = 0; i < table_->message_count; ++i) {
    const std::uint8_t bus = table_->message[i].bus;
    const MessageRule& rule = table_->rule[i];
    const bool elsewhere = bus != kAnyBus && frame.bus != kAnyBus && bus != frame.bus;
    if (elsewhere || rule.extended != frame.extended) {
      continue;
    }
    if (same_message(rule.id, frame.id)) {
      return static_cast<int>(i);
    }
    if (rule.extended && is_named_by(frame.id, rule.id)) {
      found = static_cast<int>(i);
    }
  }
  return found;
}

bool TableReceiver::is_sent(const CanFrame& frame) const {
  for (std::size_t i = 0; i < table_->send_count; ++i) {
    const TableSend& send = table_->send[i];
    if (same_message(send.rule.id, frame.id) && send.extended == frame.extended && !frame.remote &&
        (send.bus == kAnyBus || frame.bus == kAnyBus || send.bus == frame.bus)) {
      return true;
    }
  }
  return false;
}

bool TableReceiver::take_known(const CanFrame& frame, TimeUs now, ExcavatorInputs& to) {
  const int index = received(frame);
  if (index == MessageLinks::kNoMessage) {
    if (!is_sent(frame)) {
      return nodes_.take(frame, now);
    }
    own_heard_ = true;
    own_us_ = now;
    return true;
  }
  const auto i = static_cast<std::size_t>(index);
  if (links_.admit_as(index, frame, now) == MessageLinks::kNoMessage) {
    return true;
  }
  const TableMessage& message = table_->message[i];
  if (!nodes_.is_operational(message.node)) {
    return true;
  }
  if (message.protection != TableProtection::kE2e &&
      is_early(now, quotient(message.period_us * kPaceOf10, 10), heard_[i].pace)) {
    increment(early_);
    mark(i, Validity::kError, to);
    return true;
  }
  if (message.protection == TableProtection::kCounter && !goes_on(i, frame)) {
    increment(wrong_counter_);
    return true;
  }
  decode(i, frame.data, now, to);
  return true;
}

/// The first frame of a sender only says where it counts from.
bool TableReceiver::goes_on(std::size_t message, const CanFrame& frame) {
  const TableMessage& rule = table_->message[message];
  Heard& heard = heard_[message];
  const std::int64_t counter = raw_of(rule.counter, frame.data);
  const std::int64_t mask = (std::int64_t{1} << rule.counter.width) - 1;
  const std::int64_t steps = (counter - heard.counter) & mask;
  const bool good = heard.counts && steps >= 1 && steps <= rule.most_steps;
  heard.counts = true;
  heard.counter = counter;
  return good;
}

bool TableReceiver::is_possible(const TableSource& source, const Signal<double>& shown,
                                const Shown& before, double passed_s) const {
  if (says_state(source) || shown.validity != Validity::kValid) {
    return true;
  }
  if (!(shown.value >= source.least && shown.value <= source.most)) {
    return false;
  }
  // A step of the bus is no motion.
  const double most = source.rate_ps * passed_s + std::abs(source.scale);
  return source.rate_ps <= 0.0 || !before.valid ||
         change_of(source, before.value, shown.value) <= most;
}

/// All that the sender says of its values itself.
bool TableReceiver::is_trusted(const TableMessage& message, const dbc::Payload& data) const {
  bool trusted = true;
  for (std::size_t n = message.first; n < std::size_t{message.first} + message.count; ++n) {
    const TableSource& source = table_->source[n];
    trusted = trusted &&
              (source.place != SourcePlace::kMerit || is_within(source, shown_by(source, data, 0)));
  }
  return trusted;
}

void TableReceiver::decode(std::size_t message, const dbc::Payload& data, TimeUs now,
                           ExcavatorInputs& to) {
  const TableMessage& rule = table_->message[message];
  Heard& heard = heard_[message];
  const double passed_s = as_double(now - heard.last_us) / kSecond_us;
  bool possible = true;
  for (std::size_t n = rule.first; n < std::size_t{rule.first} + rule.count; ++n) {
    const TableSource& source = table_->source[n];
    const Shown before = heard.any ? shown_[n] : Shown{};
    possible = possible && is_possible(source, shown_by(source, data, now), before, passed_s);
  }
  links_.note_decoded(static_cast<int>(message), possible);
  if (!possible) {
    return;
  }
  heard.any = true;
  heard.last_us = now;
  const bool trusted = is_trusted(rule, data);
  for (std::size_t n = rule.first; n < std::size_t{rule.first} + rule.count; ++n) {
    const TableSource& source = table_->source[n];
    const Signal<double> said = shown_by(source, data, now);
    const Signal<double> shown = trusted ? said : Signal<double>{0.0, Validity::kError, now};
    shown_[n] = {shown.value, shown.validity == Validity::kValid};
    Signal<double>* const place = kept(source, to);
    if (place != nullptr) {
      const double others = source.adds ? place->value : 0.0;
      const Validity worst =
          source.adds ? std::min(place->validity, shown.validity) : shown.validity;
      *place = {worst == Validity::kValid ? others + shown.value : 0.0, worst, now};
    }
  }
}

void TableReceiver::mark(std::size_t message, Validity validity, ExcavatorInputs& to) {
  const TableMessage& rule = table_->message[message];
  for (std::size_t n = rule.first; n < std::size_t{rule.first} + rule.count; ++n) {
    shown_[n].valid = false;
    if (Signal<double>* const place = kept(table_->source[n], to)) {
      place->validity = validity;
    }
  }
}

void TableReceiver::keep_fresh(std::size_t message, TimeUs now, ExcavatorInputs& to) {
  const TableMessage& rule = table_->message[message];
  for (std::size_t n = rule.first; n < std::size_t{rule.first} + rule.count; ++n) {
    if (Signal<double>* const place = kept(table_->source[n], to)) {
      place->stamp_us = now;
    }
  }
}

/// Heard, each of them, and each holds.
void TableReceiver::judge_conditions(ExcavatorInputs& to) const {
  bool any = false;
  bool heard = true;
  bool holds = true;
  TimeUs oldest_us = 0;
  for (std::size_t i = 0; i < table_->message_count; ++i) {
    const TableMessage& rule = table_->message[i];
    for (std::size_t n = rule.first; n < std::size_t{rule.first} + rule.count; ++n) {
      const TableSource& source = table_->source[n];
      if (source.place == SourcePlace::kCondition) {
        const Shown& shown = shown_[n];
        heard = heard && heard_[i].any && shown.valid;
        holds = holds && shown.value >= source.least && shown.value <= source.most;
        oldest_us = any ? std::min(oldest_us, heard_[i].last_us) : heard_[i].last_us;
        any = true;
      }
    }
  }
  if (any) {
    to.valve_enabled = {heard && holds, heard ? Validity::kValid : Validity::kNotAvailable,
                        oldest_us};
  }
}

/// Its own time-out is what the table has: here the word holds for as long as any may.
void TableReceiver::tell_limit(ExcavatorInputs& to) const {
  if (limit_ratio_.validity == Validity::kNotReceived) {
    return;
  }
  const double ratio = limit_ratio_.value;
  to.external = {{}, limit_ratio_.validity, limit_ratio_.stamp_us};
  to.external.value.level = ratio >= 1.0  ? ExternalLevel::kFree
                            : ratio > 0.0 ? ExternalLevel::kSlow
                                          : ExternalLevel::kStop;
  to.external.value.speed_ratio = ratio;
  to.external.value.deadline_s = 1.0;
}

void TableReceiver::finish_known(TimeUs now, ExcavatorInputs& to) {
  dbc::Payload payload{};
  for (int index = links_.take_newest(payload); index != MessageLinks::kNoMessage;
       index = links_.take_newest(payload)) {
    // More of a message at once than one sender can send: none of it is used.
    links_.note_decoded(index, false);
    mark(static_cast<std::size_t>(index), Validity::kError, to);
  }
  nodes_.finish(now);
  bool slow = false;
  for (std::size_t i = 0; i < table_->message_count; ++i) {
    const TableMessage& message = table_->message[i];
    const bool silent = now - heard_[i].last_us > message.timeout_us;
    if (heard_[i].any && (silent || !nodes_.is_operational(message.node))) {
      heard_[i].any = false;
      mark(i, nodes_.has_emergency(message.node) ? Validity::kError : Validity::kNotAvailable, to);
    }
    slow = slow || message.slow;
    if (heard_[i].any && message.slow) {
      keep_fresh(i, now, to);
    }
  }
  if (table_->has_slopes) {
    slopes_.to_joints(table_->has_body_slope, to);
  }
  judge_conditions(to);
  tell_limit(to);
  if (slow && to.valve_enabled.validity == Validity::kValid) {
    to.valve_enabled.stamp_us = now;
  }
}

LinkCounters TableReceiver::counters() const {
  LinkCounters counters = links_.total();
  counters.wrong_counter += wrong_counter_;
  counters.surplus += early_;
  return counters;
}

FaultSet TableReceiver::faults(TimeUs now) const {
  FaultSet faults = links_.message_faults(now);
  if (own_heard_ && now - own_us_ <= MessageLinks::kOwnHeard_us) {
    faults.add(Fault::kSecondController);
  }
  return faults;
}

}  // namespace graben
