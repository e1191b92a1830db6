// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The load that boom and arm are opened for where their pump's line gives way to it.
///
/// Under negative flow control an opening stands for a pressure more than for a flow: a drive that
/// meets more force than its spool is opened for gets slower by the yield g. M v' = F - f and
/// v = v_opened - g (F - F_opened) make a lag of M g, some 70 ms of a 22 t machine's boom. A spool
/// that is opened for the measured force, low-passed by T, follows the part of it that only
/// accelerates the boom: s^2 M g T + s T + 1 = 0, a mode of 1.6 Hz there, and the lag of spool and
/// oil makes it ring. So it is opened for what is left at rest, the observer's load, and for the
/// push that the path asks for.

#include "firmware/excavator/estimation/oil/oil_law.hpp"
#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/mcv/evaluation.hpp"

namespace graben {

/// State of boom and arm from cycle to cycle; as constructed nothing is led.
struct HeldLoad {
  bool gives_way = false;  ///< A line has, since the oil's law took over.
  bool leads = false;      ///< Spools are opened for `force_n` instead of the filtered pressures.
  Eigen::Vector2d due_mps = Eigen::Vector2d::Zero();  ///< What the path asked for last.
  Eigen::Vector2d push_mps2 = Eigen::Vector2d::Zero();
  Eigen::Vector2d load_n = Eigen::Vector2d::Zero();  ///< Low-passed; extension is pushed against.
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();
  /// Of the last cycle's openings, m/s over N; 0 of a line that does not give way.
  Eigen::Vector2d yield_mpsn = Eigen::Vector2d::Zero();
};

/// `cycles` on (cycles_in): `oil` after them, `due_mps` as the path has asked for it, `inertia_kg`
/// of stroke_inertia_kg(). It leads where the oil's law does, once an opening has given way.
void next_held_load(const OilState& oil, const Eigen::Vector2d& due_mps,
                    const Eigen::Matrix2d& inertia_kg, int cycles, HeldLoad& held);

/// The input with the pressures of boom and arm changed until their force is the held one.
[[nodiscard]] McvInput opened_for(const HeldLoad& held, DriveRows drives, const McvInput& input);

/// Filtered force of the measured pressures of boom and arm. By reference: a span that is split
/// between registers and stack makes a frame on Arm that is not the compiler's own figure.
[[nodiscard]] Eigen::Vector2d filtered_force_n(const DriveRows& drives,
                                               const Span<const LoadState>& load);

}  // namespace graben
