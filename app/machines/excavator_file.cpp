// SPDX-License-Identifier: Apache-2.0
#include "app/machines/excavator_file.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/machines/bus_file.hpp"
#include "app/machines/excavator_sections.hpp"
#include "app/machines/profile_document.hpp"
#include "app/machines/unknown_drives.hpp"

namespace graben::machines {
namespace {

/// Of a pump that nobody commands: its own pilot takes it to full displacement as levers are moved
/// out, and what is not needed goes over the bypass.
constexpr double kSwashByItself = 1.0;

/// The bus profile that the machine's names, beside it, in `buses` there, or a shipped one. None
/// where it names ours or nothing.
std::optional<BusFile> other_bus(const ProfileDocument& document) {
  const std::string name = document.root["bus"].value<std::string>().value_or("");
  const bool is_ours = name.empty() || name == known_buses().front().name;
  const std::filesystem::path beside = document.file.parent_path();
  std::vector<std::filesystem::path> folders = {beside, beside / "buses"};
  for (const std::filesystem::path& shipped : shipped_folders()) {
    folders.push_back(shipped / "buses");
  }
  return is_ours ? std::nullopt : std::optional(load_bus(find_bus(name, folders)));
}

}  // namespace

ExcavatorMachine load_excavator(const ProfileDocument& document) {
  ExcavatorMachine machine;
  machine.name = document.file.stem().string();
  const std::optional<BusFile> bus = other_bus(document);
  std::vector<KnownBus> buses = known_buses();
  if (bus) {
    buses.push_back({document.root["bus"].value<std::string>().value_or(""), bus->capabilities,
                     bus->table.own_frames});
    machine.bus = bus->table;
    machine.bus_speaks = bus->speaks;
  }
  machine.hash = read_as(document, MachineKind::kExcavator, [&](TomlReader& reader) {
    machine.profile = read_excavator_sections(reader, buses);
    machine.driven = read_driven(reader, machine.profile.drive_count);
    machine.provenance = reader.provenance();
    check_excavator_across_keys(reader, machine.profile);
  });
  machine.hash ^= bus ? bus->hash : 0;
  refuse_unknown(machine);
  return machine;
}

ExcavatorMachine load_excavator(const std::filesystem::path& file) {
  const ProfileDocument document = read_document(file);
  refuse_other_sort(document, kMachineSort);
  return load_excavator(document);
}

void put_on_bus(const std::string& name, ExcavatorMachine& machine) {
  const BusFile bus = load_bus(find_bus(name));
  if (!bus.table.own_frames && (machine.profile.has_swing() || machine.profile.imu.known())) {
    throw std::runtime_error(fmt::format(
        "--bus {}: it carries no swing and no IMUs; allowed: a machine without them", name));
  }
  machine.bus = bus.table;
  machine.bus_speaks = bus.speaks;
  machine.profile.bus = bus.capabilities;
  machine.hash ^= bus.hash;
  if (!bus.capabilities.swash_command) {
    machine.profile.demand_swash = {};
    machine.profile.dig_swash_ratio.fill(kSwashByItself);
  }
}

}  // namespace graben::machines
