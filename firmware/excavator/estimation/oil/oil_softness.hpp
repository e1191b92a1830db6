// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Oil that is softer or stiffer than the profile tells, seen by how the boom rings. A law that is
/// made for another stiffness swings it: slower than its slower mode, where air in the oil makes it
/// soft, faster where it is stiff. The oil is then taken for softer or stiffer until mode and swing
/// agree, or nothing rings.

namespace graben {

/// State from cycle to cycle. As constructed the oil is as the profile tells.
struct OilSoftness {
  double share = 1.0;        ///< Of the told stiffness, kSoftOilLeast .. kStiffOilMost.
  double pushed_s = 0.0;     ///< For which it is not judged, since something has pushed or begun.
  double smooth_pa = 0.0;    ///< The boom's force over its cap's area, without what is faster.
  double smoother_pa = 0.0;  ///< The same once more: noise has no frequency of its own.
  double slow_pa = 0.0;      ///< That of the path and the pose.
  double swing_pa = 0.0;     ///< What is between them, in the last cycle.
  double power_pa2 = 0.0;    ///< Mean square of it,
  double rate_pa2ps2 = 0.0;  ///< and of its change in time.
};

/// A cycle on. `pressure_pa`: the boom's force over its cap's area; `omega_radps`: of the slower
/// mode as it is taken now. Not `judges`, since the machine stands, pressures are unknown or
/// something pushes the teeth: the share stays, and what has swung is forgotten.
void next_softness(double pressure_pa, double omega_radps, bool judges, double elapsed_s,
                   OilSoftness& state);

}  // namespace graben
