// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Keys of an excavator's [control] that say what its controller learns at work.

#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

/// What a file does not say stays as constructed: all is learnt, at the usual pace.
inline void read_learning(TomlReader& reader, ControlProfile& control) {
  if (reader.lists() || reader.has("control.learns")) {
    control.learns = reader.boolean_or(true, "control.learns",
                                       "valves, the oil's stiffness and lasting lags of drives are "
                                       "learnt at work; false: all of it is as told");
  }
  if (reader.lists() || reader.has("control.learn_share")) {
    control.learn_share = reader.number_or(
        1.0, "control.learn_share", {0.01, 1.0, ""},
        "share of its usual pace at which valves are learnt at work; graben identify writes 0.1");
  }
}

}  // namespace graben::machines
