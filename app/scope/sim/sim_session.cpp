// SPDX-License-Identifier: Apache-2.0
#include "app/scope/sim/sim_session.hpp"

#include <fmt/format.h>

#include <tuple>
#include <type_traits>
#include <utility>

#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::scope {
namespace {

using nlohmann::json;
using Status = dbc::excavator::EcuStatus;
static_assert(std::is_same_v<Status, dbc::dozer::EcuStatus>, "all machines' buses have one status");

auto members(const SimState& state) {
  return std::tie(state.running, state.pace, state.speed, state.soil, state.obstacle, state.faults);
}

}  // namespace

SimSession::SimSession(const SimOptions& options, FrameTap tap)
    : task_(options.task),
      tap_(std::move(tap)),
      machine_(make_sim_machine(options, [this](const CanFrame& frame) { see(frame); })),
      operator_(machine_->task()) {
  operator_.work(now_us_);
}

void SimSession::see(const CanFrame& frame) {
  if (same_message(frame.id, Status::kId) && frame.extended && frame.length == Status::kLength) {
    operator_.hear(static_cast<EcuMode>(Status::decode(frame.data).mode.value), frame.stamp_us);
  }
  tap_(frame);
}

bool SimSession::step() {
  std::vector<SimWish> wishes;
  {
    const std::lock_guard lock(mutex_);
    wishes.swap(wishes_);
  }
  for (const SimWish& wish : wishes) {
    fulfil(wish);
  }
  look_at_end();
  machine_->step(now_us_, operator_.request(now_us_));
  now_us_ += kCycle_us;
  return publish();
}

void SimSession::fulfil(const SimWish& wish) {
  using Do = SimWish::Do;
  switch (wish.what) {
    case Do::kRun:
      running_ = true;
      if (!operator_.is_under_way() && !done_since_us_) {
        operator_.work(now_us_);
      }
      return;
    case Do::kStop:
      running_ = false;
      operator_.rest();
      return;
    case Do::kRestart:
      begin_anew();
      return;
    case Do::kClear:
      for (std::size_t fault = 0; fault < machine_->faults().size(); ++fault) {
        machine_->set_fault(fault, false);
      }
      if (running_ && !done_since_us_) {
        operator_.work(now_us_);
      }
      return;
    case Do::kPace:
      pace_ = wish.value;
      return;
    case Do::kSpeed:
      operator_.set_speed(wish.value);
      return;
    case Do::kSoil:
      machine_->ground()->want_soil(wish.on);
      return;
    case Do::kObstacle:
      machine_->ground()->want_obstacle(wish.on);
      return;
    case Do::kFault:
      machine_->set_fault(wish.fault, wish.on);
      return;
  }
}

void SimSession::begin_anew() {
  done_since_us_.reset();
  machine_->restart();
  if (running_) {
    operator_.work(now_us_);
  }
}

/// The operator lets go where the task ends.
void SimSession::look_at_end() {
  if (!done_since_us_ && machine_->is_done()) {
    done_since_us_ = now_us_;
    operator_.rest();
  }
  if (done_since_us_ && running_ && now_us_ - *done_since_us_ >= kShownDone_us) {
    begin_anew();
  }
}

SimState SimSession::state_now() const {
  SimState state;
  state.running = running_;
  state.pace = pace_;
  state.speed = operator_.speed();
  if (const SimGround* ground = machine_->ground()) {
    state.soil = ground->soil();
    state.obstacle = ground->obstacle();
  }
  for (std::size_t fault = 0; fault < machine_->faults().size(); ++fault) {
    if (machine_->is_on(fault)) {
      state.faults.push_back(machine_->faults()[fault].id);
    }
  }
  return state;
}

bool SimSession::publish() {
  SimState state = state_now();
  const std::lock_guard lock(mutex_);
  if (members(state) == members(published_)) {
    return false;
  }
  published_ = std::move(state);
  ++revision_;
  return true;
}

std::optional<std::string> SimSession::control(const json& message) {
  // What it asks of the machine does not change.
  auto wish = read_wish(message, machine_->faults(), machine_->ground() != nullptr);
  if (auto* why = std::get_if<std::string>(&wish)) {
    return std::move(*why);
  }
  const std::lock_guard lock(mutex_);
  if (wishes_.size() >= kWishesMost) {
    return fmt::format("more than {} wishes at once", kWishesMost);
  }
  wishes_.push_back(std::get<SimWish>(wish));
  return std::nullopt;
}

std::optional<json> SimSession::state(std::uint64_t& seen) const {
  const std::lock_guard lock(mutex_);
  if (seen == revision_) {
    return std::nullopt;
  }
  seen = revision_;
  return json{{"kind", "sim"},
              {"running", published_.running},
              {"pace", published_.pace},
              {"speed", published_.speed},
              {"soil", published_.soil},
              {"obstacle", published_.obstacle},
              {"faults", published_.faults}};
}

double SimSession::pace() const {
  const std::lock_guard lock(mutex_);
  return published_.pace;
}

json SimSession::setup() const {
  const bool has_ground = machine_->ground() != nullptr;
  json faults = json::array();
  for (const SimFault& fault : machine_->faults()) {
    faults.push_back({{"id", fault.id},
                      {"number", fault.number},
                      {"words", fault.words},
                      {"reaction", reaction_words(fault.reaction)},
                      {"once", fault.once}});
  }
  return {{"task", task_},
          {"can", {{"soil", has_ground}, {"obstacle", has_ground}}},
          {"faults", faults}};
}

}  // namespace graben::scope
