// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/operate/operate.hpp"

namespace graben::cli {

void add_operate(CLI::App& app, int& status) {
  struct OperateCommand {
    operate::OperateOptions run;
    double silent_after_s = 5.0;
  };
  auto options = std::make_shared<OperateCommand>();
  CLI::App* command = add_command(app, "operate");
  command->add_option("--can", options->run.interface, "CAN interface, such as can0")->required();
  auto* gamepad =
      command->add_option("--gamepad", options->run.gamepad,
                          "Input device, such as /dev/input/event5; the only gamepad there is "
                          "unless told. Use a cable: "
                          "a wireless one may fall silent and still look as if it were held");
  command
      ->add_flag("--keyboard", options->run.keyboard,
                 "The terminal's keyboard in place of a gamepad. FOR SIMULATION AND TESTS ONLY: a "
                 "terminal tells no release of a key. One that stops repeating counts for 0.15 s "
                 "more, one that was only tapped for 0.7 s")
      ->excludes(gamepad);
  command
      ->add_option("--speed", options->run.station.speed_override_ratio,
                   "SpeedOverride at the start, 0 .. 1; up and down by 0.1")
      ->check(number_between(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--silent-after", options->silent_after_s,
                   "A gamepad that has sent nothing for so long while its button is held has let "
                   "go, 0.5 .. 60 s")
      ->check(number_between(0.5, 60.0))
      ->capture_default_str();
  command
      ->add_option("--seconds", options->run.seconds, "Ends after so long, 0 .. 86400 s; 0: never")
      ->check(number_between(0.0, 86400.0))
      ->capture_default_str();
  add_examples(*command, {"operate --can can0 --gamepad /dev/input/event5"});
  command->callback([options, &status] {
    constexpr double kUsPerS = 1e6;
    options->run.station.silent_after_us = static_cast<TimeUs>(options->silent_after_s * kUsPerS);
    status = guarded("operate", [&] { operate::run_station(options->run); });
  });
}

}  // namespace graben::cli
