// SPDX-License-Identifier: Apache-2.0
// A dozer is commissioned over the bus, by the station: to its end, after a break, and not by what
// another kind's station would send.

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "app/commission/commission_progress.hpp"
#include "app/machines/profile_file.hpp"
#include "app/operate/commission_station.hpp"
#include "app/runs/dozer_rig.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/operate/folder.hpp"

using commission::DozerOptions;
using operate::CommissionEnd;
using Kind = runs::DozerSim;
using Results = std::vector<commission::StepResult>;

const machines::SimulatedDozer& dozer() {
  static const machines::SimulatedDozer machine =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  return machine;
}

/// The blade's ramps, and the tracks.
DozerOptions short_options() {
  DozerOptions options = commission::whole_dozer(dozer().profile);
  options.blade.steps = false;
  options.blade.bursts = false;
  return options;
}

struct Bench {
  explicit Bench(const DozerOptions& options = short_options(), const Results& done = {})
      : plant(Kind::node(dozer(), {}, plant_port)) {
    setup.sequence = options;
    setup.profile_hash = dozer().hash;
    setup.done = done;
    assert_true(plant_port.open() && station_port.open() && ecu_port.open());
    ecu = std::make_unique<Kind::Ecu>(dozer().profile, dozer().hash, ecu_port);
    station = std::make_unique<operate::DozerStation>(setup);
    run(1.0);
    hands.deadman = true;
  }

  void cycle() {
    bus.set_time(now_us);
    plant.step(now_us);
    plant::receive_frames(station_port, [this](const CanFrame& frame) {
      heard.hear(frame, now_us);
      if (!same_message(frame.id, deaf_to)) {
        station->hear(frame, now_us);
      }
    });
    const auto trouble =
        heard.hears_ecu(now_us) ? operate::Trouble::kNone : operate::Trouble::kEcuSilent;
    station->step(hands, trouble, heard, now_us);
    if (cycles++ % 2 == 0) {
      for (const CanFrame& frame :
           frames.next(station->request(), station->tried(), heard.echo(), now_us)) {
        static_cast<void>(station_port.send(frame));
      }
    }
    ecu->step(now_us, 0);
    now_us += operate::DozerStation::kPeriod_us;
  }
  void run(double time_s) {
    for (double at_s = 0.0; at_s < time_s; at_s += 0.01) {
      cycle();
    }
  }
  template <class Holds>
  bool run_until(const Holds& holds, double most_s) {
    for (double at_s = 0.0; at_s < most_s && !holds(); at_s += 0.01) {
      cycle();
    }
    return holds();
  }
  bool run_to_end() {
    return run_until([this] { return station->end() != CommissionEnd::kNone; }, 200.0);
  }
  [[nodiscard]] Results results() const { return station->sequence().results(); }
  /// What it is asked for is there and moves.
  [[nodiscard]] bool tries_tracks() const {
    return station->tried().tried.drive == TriedDrive::kTracks &&
           std::abs(plant.plant().velocity_mps()) > 0.1;
  }

  LoopbackBus bus;
  LoopbackPort& plant_port = bus.attach();
  LoopbackPort& station_port = bus.attach();
  LoopbackPort& ecu_port = bus.attach();
  Kind::Node plant;
  std::unique_ptr<Kind::Ecu> ecu;
  operate::CommissionSetupOf<operate::DozerLead> setup;
  std::unique_ptr<operate::DozerStation> station;
  operate::DozerFrames frames;
  operate::EcuListener heard{dbc::dozer::kDbcVersion};
  operate::Hands hands;
  std::uint32_t deaf_to = 0;
  TimeUs now_us = 0;

 private:
  unsigned long cycles = 0;
};

const Results& sound_results() {
  static const Results results = [] {
    Bench bench;
    assert_true(bench.run_to_end());
    assert_int_equal(bench.station->end(), CommissionEnd::kDone);
    assert_true(bench.station->end_words().empty());
    return bench.results();
  }();
  return results;
}

void assert_same(const Results& results) {
  const Results& sound = sound_results();
  assert_int_equal(results.size(), sound.size());
  for (std::size_t at = 0; at < sound.size(); ++at) {
    // How fast a displacement is, is known as well as one step shows it, not as all before.
    // One that began again elsewhere may end at its window.
    assert_true(results[at].end != commission::StepEnd::kNoMotion);
    assert_near(results[at].duty, sound[at].duty, 0.15);
    assert_true(results[at].speed_mps < short_options().way.most_mps);
  }
}

TEST(blade_and_tracks_are_led_to_the_end) {
  const Results& sound = sound_results();
  const auto texts = commission::dozer_step_texts(short_options());
  assert_int_equal(sound.size(), texts.size());
  for (std::size_t at = 0; at < sound.size(); ++at) {
    const bool tracks = texts[at].rfind("tracks", 0) == 0;
    assert_int_equal(sound[at].end, commission::StepEnd::kDone);
    assert_true(sound[at].speed_mps > (tracks ? 0.05 : 0.005));
  }
}

TEST(let_go_it_stands_and_goes_on) {
  Bench bench;
  assert_true(bench.run_until([&] { return bench.tries_tracks(); }, 100.0));
  const std::size_t done = bench.results().size();
  bench.hands.deadman = false;
  bench.run(3.0);
  assert_false(bench.station->is_moving());
  assert_int_equal(bench.station->tried().tried.drive, TriedDrive::kNone);
  assert_near(bench.plant.plant().velocity_mps(), 0.0, 1e-3);
  assert_int_equal(bench.results().size(), done);
  bench.hands.deadman = true;
  assert_true(bench.run_to_end());
  assert_same(bench.results());
}

/// Without the body's position nobody knows how far it goes.
TEST(deaf_to_its_position_nothing_is_tried) {
  Bench bench;
  assert_true(bench.run_until([&] { return bench.tries_tracks(); }, 100.0));
  bench.deaf_to = dbc::dozer::BodyPosition::kId;
  bench.run(0.1);
  assert_false(bench.station->is_moving());
  assert_int_equal(bench.station->tried().tried.drive, TriedDrive::kNone);
}

TEST(another_run_goes_on_from_the_file) {
  const test::Folder folder;
  commission::DozerProgress progress{dozer().hash, short_options(), {}};
  const Results& sound = sound_results();
  const DozerOptions whole = commission::whole_dozer(dozer().profile);
  for (const std::size_t done : {1UL, 2UL, sound.size() - 3, sound.size()}) {
    progress.results.assign(sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(done));
    const auto file = commission::progress_file(folder.path / "drive.log");
    commission::write_progress(file, progress);
    const auto read = commission::read_progress(file, dozer().hash, whole);
    assert_int_equal(read.results.size(), done);
    Bench bench(read.options, read.results);
    assert_int_equal(bench.station->sequence().at(), done);
    assert_true(bench.run_to_end());
    assert_int_equal(bench.station->end(), CommissionEnd::kDone);
    assert_same(bench.results());
  }
}

/// Largest displacement of a step of the tracks that do not move.
double most_pump(commission::TravelLead lead) {
  lead.begin({1, commission::kTravelLevelCount - 1, false});
  double most = 0.0;
  for (int n = 0; n < 300 && !lead.step(0.0, 0.0); ++n) {
    most = std::max(most, std::abs(lead.pump_ratio()));
  }
  return most;
}

TEST(how_fast_the_tracks_were_bounds_the_next_step) {
  commission::TravelLead lead({-3.0, 3.0, 0.5});
  const double unknown = most_pump(lead);
  lead.remember({1, 0, true}, {commission::StepEnd::kDone, 0.1, 5.0, 1.0});  // The motors.
  assert_near(most_pump(lead), unknown, 0.0);
  lead.remember({1, 1, false}, {commission::StepEnd::kDone, 0.25, 0.5, 1.0});
  assert_true(most_pump(lead) < 0.25);
  assert_true(unknown > 0.25);
}

std::string refusal(const std::filesystem::path& file, std::uint32_t hash,
                    const DozerOptions& machine) {
  try {
    static_cast<void>(commission::read_progress(file, hash, machine));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(a_file_that_does_not_fit_is_refused) {
  const test::Folder folder;
  const auto file = folder.path / "p.json";
  commission::DozerProgress progress{dozer().hash, short_options(), {}};
  const DozerOptions whole = commission::whole_dozer(dozer().profile);
  const auto says = [&](const char* words, std::uint32_t hash) {
    commission::write_progress(file, progress);
    const std::string text = refusal(file, hash, whole);
    if (text.find(words) == std::string::npos) {
      fail_msg("'%s' not in '%s'", words, text.c_str());
    }
  };
  says("begun with another profile", dozer().hash + 1);
  progress.options.way.least_m = -1.0;
  says("tracks: from -1 to 3 m at 1.2 m/s cannot be", dozer().hash);
  progress.options.way.least_m = -3.0;
  progress.options.blade.window[0].most_m = 9.0;
  says("blade: from 0 to 9 m", dozer().hash);
  progress.options = short_options();
  DozerOptions now = progress.options;
  commission::require_same_windows(progress.options, now);
  now.way.most_mps = 0.8;
  try {
    commission::require_same_windows(progress.options, now);
    fail_msg("another speed is taken");
  } catch (const std::runtime_error& error) {
    assert_true(std::string(error.what()).find("tracks: begun with another window") == 0);
  }
}

/// What would be sent in place of a station that dies asks for nothing.
TEST(last_words_let_go) {
  operate::DozerFrames frames;
  const auto last = frames.last_words(kSecondUs);
  const auto said = dbc::dozer::OperatorCommand::decode(last[0].data);
  assert_true(said.enable.value == dbc::dozer::OperatorCommand::Enable::kOff);
  const auto next = frames.next({}, {}, {0, dbc::RawState::kNotAvailable}, kSecondUs);
  assert_true(next.front().data == last[0].data);
  assert_int_equal(next.size(), 2);
}

TEST(the_version_of_its_own_frames_is_wanted) {
  Bench bench;
  assert_true(bench.heard.identity().said.has_value());
  assert_false(bench.heard.other_version().has_value());
  operate::EcuListener excavators;
  bench.bus.set_time(bench.now_us);
  bench.run(1.0);
  LoopbackPort& other = bench.bus.attach();
  assert_true(other.open());
  bench.run(1.5);
  plant::receive_frames(other,
                        [&](const CanFrame& frame) { excavators.hear(frame, bench.now_us); });
  assert_int_equal(excavators.other_version().value_or(0), dbc::dozer::kDbcVersion);
}
