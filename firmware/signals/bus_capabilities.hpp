// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a machine's bus can say to its controller. A bus that lacks something has a stand-in, which
/// the profile has to name; EcuHealth.StandIn shows that one is in use.

namespace graben {

/// Capabilities of a bus; by default those of our own DBCs, which lack nothing.
///
///   lacks           stand-in   what it costs
///   identity        profile    another machine's frames are not told from this one's: no
///                              kIdentityMismatch
///   valve_echo      motion     a valve side that ignores enable shows only by its spools and
///                              cylinders: no kValveNotFollowing
///   spool_feedback  command    a spool counts as where it was sent: no kSpoolMissing, no
///                              kSpoolStuck, no arm condition of centred spools; the motion watch
///                              waits for dead time and lag after each command
///                  pilot      pilot pressures count as spools, which come later: a spool that
///                              sticks under a right pressure shows only by its cylinder
///   swash_feedback  command    a pump counts as where it was sent, or on its way there: no
///                              kSwashMissing, no kSwashDisagrees
///   pressures       worst_load the loads of boom, arm, bucket and swing count as what their links
///                              weigh, lambda as if each pushed against worst_load of its pump's
///                              relief: no kPressureMissing, no kPressureImplausible, no
///                              kWrongDirection, no blocked drive, no flow watch; the servo leads
///   swash_command   profile    the pumps are where the machine has them, which the profile tells:
///                              no less flow where less is needed
///   protection      range      a frame without counter and CRC counts if it is fresh and in range:
///                              no kMessageCorrupt, kMessageSequence, kMessageMasquerade
struct BusCapabilities {
  bool identity = true;        ///< The machine's end says which profile and DBC it has.
  bool valve_echo = true;      ///< The valve side says which enable it acts on.
  bool spool_feedback = true;  ///< Measured positions of the spools.
  bool swash_feedback = true;  ///< Measured displacements of the pumps, where a kind has them.
  bool pressures = true;       ///< Of the drives' chambers.
  /// Where they are not: the load that a drive counts as pushing against, of its pump's relief.
  double worst_load_ratio = 0.4;
  bool protection = true;       ///< Counter and CRC in what moves metal and in what is measured.
  double latency_s = 0.0;       ///< Of the bus, either way; part of the profile's dead time.
  bool swash_command = true;    ///< The pumps' displacements can be commanded.
  bool spool_by_pilot = false;  ///< The spools' positions are told by pilot pressures.
  bool joint_angles = false;    ///< Angles of the joints, in the place of strokes.
  /// Age of what these show when it comes; they are foretold by it.
  double joint_latency_s = 0.0;
  int echo_cycles = 12;  ///< The valve side has so many to say which enable it acts on.

  [[nodiscard]] constexpr bool lacks_any() const {
    return !(identity && valve_echo && spool_feedback && swash_feedback && swash_command &&
             pressures && protection) ||
           spool_by_pilot;
  }
};

}  // namespace graben
