// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a simulated excavator's file may say of each drive and direction by itself.

namespace graben::machines {

class TomlReader;
struct SimulatedExcavator;

/// Reads and checks the optional keys that go before those of all drives. To be called with the
/// plant as these say.
void read_each_drive(TomlReader& reader, SimulatedExcavator& machine);

}  // namespace graben::machines
