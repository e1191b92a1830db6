// SPDX-License-Identifier: Apache-2.0
#include "tests/timing/counts/scene.hpp"

#include <algorithm>
#include <cstring>

#include "hal/link/e2e.hpp"

namespace graben::timing {
namespace {

constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
constexpr int kEnableCycle = 20;
constexpr int kTaskCycle = 30;

template <class Kind>
const dbc::MessageInfo& info_of(const std::string& name) {
  const auto& all = Kind::Dbc::kMessages;
  const auto* const found = std::find_if(
      all.begin(), all.end(), [&](const dbc::MessageInfo& info) { return name == info.name; });
  if (found == all.end()) {
    throw std::runtime_error("no message is called " + name);
  }
  return *found;
}

template <class Message>
void look_for(const std::string& message, const std::string& name, const dbc::Field*& found) {
  if (message != Message::kName) {
    return;
  }
  Message any;
  Message::visit(
      any, [&](const dbc::Field& field, auto&) { found = name == field.name ? &field : found; });
}

template <class... Messages>
const dbc::Field& field_of(dbc::MessageList<Messages...>, const std::string& message,
                           const std::string& name) {
  const dbc::Field* found = nullptr;
  (look_for<Messages>(message, name, found), ...);
  if (found == nullptr) {
    throw std::runtime_error("no field is called " + message + "." + name);
  }
  return *found;
}

void protect_again(CanFrame& frame, const dbc::MessageInfo& info) {
  if (info.is_protected) {
    constexpr unsigned kCounterMask = 0x0F;
    e2e_protect(frame.data, info.data_id, static_cast<std::uint8_t>(frame.data[1] & kCounterMask));
  }
}

}  // namespace

template <class Kind>
bool Scene<Kind>::alter(const Edit& edit, CanFrame& frame) {
  const dbc::MessageInfo& info = info_of<Kind>(edit.message);
  if (frame.id != info.id) {
    return true;
  }
  if (edit.what == "mute") {
    return false;
  }
  if (edit.what == "raw") {
    const dbc::Field& field = field_of(typename Kind::Dbc::AllMessages{}, edit.message, edit.other);
    dbc::insert(frame.data, field.start_bit, field.width, static_cast<std::uint32_t>(edit.number));
    protect_again(frame, info);
  } else if (edit.what == "wrong") {
    frame.data[0] = static_cast<std::uint8_t>(frame.data[0] ^ 1U);
  } else if (edit.what == "as") {
    protect_again(frame, info_of<Kind>(edit.other));
  } else if (edit.what == "length") {
    frame.length = static_cast<std::uint8_t>(edit.number);
  } else if (edit.what == "odd") {
    frame.remote = (edit.number & 1U) != 0U;
    frame.fd = (edit.number & 2U) != 0U;
    frame.extended = (edit.number & 4U) == 0U;
  }
  return true;
}

template <class Kind>
bool Scene<Kind>::alter(CanFrame& frame) {
  bool stays = true;
  for (const Edit& edit : script_.edits) {
    const bool sends = edit.what == "good" || edit.what == "flood";
    if (edit.holds(cycle_) && !edit.message.empty() && !sends) {
      stays = alter(edit, frame) && stays;
    }
  }
  return stays;
}

template <class Kind>
void Scene<Kind>::send_more(const Edit& edit) {
  CanFrame frame;
  frame.length = 8;
  frame.id = 0x1FFFFF00;
  frame.error = edit.message == "error";
  std::memcpy(frame.data.data(), &edit.bytes, sizeof edit.bytes);
  const bool ours = edit.message != "foreign" && edit.message != "error";
  const dbc::MessageInfo* const info = ours ? &info_of<Kind>(edit.message) : nullptr;
  if (info != nullptr) {
    frame.id = info->id;
    frame.length = info->length;
  }
  std::uint8_t counter = 0;
  for (std::uint64_t n = 0; n < edit.number; ++n) {
    if (edit.what == "good" && info != nullptr && info->is_protected) {
      e2e_protect(frame.data, info->data_id, counter);
      counter = e2e_next_counter(counter);
    }
    bus_.inject(frame);
  }
}

template <class Kind>
void Scene<Kind>::disturb(const Edit& edit) {
  if (edit.what == "late") {
    now_us_ += static_cast<TimeUs>(edit.number) * kMillisecondUs;
  } else if (edit.what == "port") {
    ecu_port_.set_state(static_cast<CanPortState>(edit.number));
  } else if (edit.what == "refuse") {
    ecu_port_.set_send_fails(true);
  } else if (edit.what == "hold") {
    hold_ = static_cast<int>(edit.number);
  } else if (edit.what == "speed") {
    speed_ratio_ = static_cast<double>(edit.number) / 100.0;
  } else if (edit.what == "good" || edit.what == "flood") {
    send_more(edit);
  }
}

template <class Kind>
void Scene<Kind>::give_task() {
  plant::OperatorRequest request;
  request.enable = hold_ > 0;
  request.mode = OperatorMode::kAutomatic;
  request.task = hold_ > 1 ? task_ : Task::kNone;
  request.speed_override_ratio = speed_ratio_;
  request.task_number = script_.task_number;
  driver_.set_schedule({{0, request}});
}

template <class Kind>
TraceCycle Scene<Kind>::step() {
  hold_ = cycle_ < kEnableCycle ? 0 : cycle_ < kTaskCycle ? 1 : 2;
  speed_ratio_ = script_.speed_ratio;
  ecu_port_.set_send_fails(false);
  bus_.set_time(now_us_);
  // What is queued first is what a full queue keeps.
  for (const Edit& edit : script_.edits) {
    if (edit.holds(cycle_)) {
      disturb(edit);
    }
  }
  give_task();
  plant_.step(now_us_);
  driver_.step(now_us_);
  ecu_.step(now_us_, 0);
  TraceCycle seen = recorder_.take();
  seen.now_us = now_us_;
  seen.mode = static_cast<std::uint8_t>(ecu_.outputs().status.mode);
  now_us_ += kPeriod_us;
  ++cycle_;
  return seen;
}

template class Scene<runs::ExcavatorSim>;
template class Scene<runs::DozerSim>;

}  // namespace graben::timing
