// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers that were chosen for the oil's observer and law, each with why: the modes, their gains,
/// what the law may do, and the load that spools are opened for.

namespace graben {

// Modes of boom and arm on their oil, and the payload in them (oil_modes.cpp)

/// Pressure of a chamber below which its oil counts the less, the emptier it is. [Pa; measured:
/// `sweep.py`: soil's tip_jerk_rms_mps3 358; x0.7 333, x1.3 349]
inline constexpr double kOilEmpty_pa = 1.2e6;
/// Least share that the oil of an empty chamber counts. [-; measured: keeps the stiffness above 0;
/// `sweep.py`: dry's tip_jerk_rms_mps3 13.5; x0.7 14.1, x1.3 13.5]
inline constexpr double kOilEmptyShare = 0.2;
/// Reach from the boom's pin to the bucket below which no payload is weighed. [m; chosen: nearer,
/// the boom's cylinder says little of it; not tried]
inline constexpr double kWeighedReach_m = 2.0;
/// Greatest payload in the modes. [kg; chosen: not tried]
inline constexpr double kWeighedMost_kg = 2000.0;
/// Factor on the weighed payload. [-; measured: friction and transducers may hide a third of it,
/// and too slow a mode does less harm than too fast a one; `sweep.py`: soil's max_error_true_m
/// 65.8; x0.7 68.5, x1.3 70.2]
inline constexpr double kWeighedHeavier = 1.6;

// Gains of observer and feedback (oil_gains.cpp)

/// Variance that rounding and friction add to a travel in a cycle. [m2; measured: keeps the Riccati
/// equation regular; `sweep.py`: soil's tip_jerk_rms_mps3 358; x0.7 340, x1.3 345]
inline constexpr double kOilTravelDrift_m2 = 1e-12;
/// Variance that they add to a speed in a cycle; as a number also to a compression. [m2/s2;
/// measured: keeps the Riccati equation regular; `sweep.py`: dry's tip_jerk_rms_mps3 13.5; x0.7
/// 14.4, x1.3 14.1]
inline constexpr double kOilSpeedDrift_m2ps2 = 1e-10;
/// Root of the lowest frequency in the table of gains, 4 rad/s. [-; measured: `sweep.py`: soil's
/// tip_jerk_rms_mps3 358; x0.7 334, x1.3 335]
inline constexpr double kOilLeastRoot = 2.0;
/// Root of the highest frequency in the table of gains, 196 rad/s. [-; measured: `sweep.py`: dry's
/// max_error_true_m 30; x0.7 32.7, x1.3 30]
inline constexpr double kOilMostRoot = 14.0;

// Law (oil_law.cpp)

/// Greatest flow error of a valve, as a speed. [m/s; chosen: no valve is farther off; not tried]
inline constexpr double kOilFlowErrorMost_mps = 0.08;
/// Missed stroke that counts half: half a step of 0.1 mm. [m; measured: `campaign dig --errors all
/// --draws 200 --seed 3001`: 0.04 mm: duties of boom and arm 3.3 and 2.1 strokes a second, p95 37.6
/// mm; 0.07 mm 2.7, 1.8, 38.5, but an exact 12 t at half speed 5.1 instead of 3.4 mm;
/// none 5.6, 3.6, 37.0]
inline constexpr double kOilStrokeStep_m = 5e-5;
/// Rate at which the law takes over from the servo and gives back. [1/s; measured: half a second;
/// `sweep.py`: soil's max_error_true_m 65.8; x0.7 61.7, x1.3 64.7]
inline constexpr double kOilHandOver_ps = 2.0;

// Oil that is softer than told (oil_softness.cpp). What was tried was tried without a time after
// the start of a motion.

/// Time constant, twice, without what is faster than the mode. [s; measured: `campaign dig --errors
/// all --found oil=0.6 --draws 20`: 24 / 36 mm; 0.028 once, sensors' noise hides the frequency: 28
/// / 54]
inline constexpr double kSwingSmooth_s = 0.05;
/// Time constant without what is the path's, slower than both modes, 0.9 Hz. [s; chosen: not tried]
inline constexpr double kSwingSlow_s = 0.17;
/// Time over which power and frequency are taken. [s; measured: `cells.py --map`: 0 of 80 cells
/// ring over 3 mm; 0.7 s 2, 1 s 3]
inline constexpr double kSwingMean_s = 0.5;
/// Rms of the boom's force over its cap's area above which it rings. [Pa; measured: `cells.py
/// --map`: worst ringing 2.9 mm, never 23; one low-pass of 28 ms before it: 1.0 MPa 3.0, 1.2 MPa
/// 5.4, 1.6 MPa 7.7]
inline constexpr double kRings_pa = 0.8e6;
/// Square of a frequency, of the mode's, below which the oil is softer. [-; measured: `cells.py
/// --map`: 0.81 leaves 1 cell more over 3 mm. By power alone, whatever the frequency, `campaign dig
/// --draws 40` has 54 mm instead of 42]
inline constexpr double kRingsSlower = 0.9;
/// The same above which it is stiffer. [-; measured: `cells.py --map`: with 1.2 one cell more rings
/// over 3 mm]
inline constexpr double kRingsFaster = 1.5;
/// How fast the share changes. [1/s; chosen: a third in a second; not tried]
inline constexpr double kSoftens_ps = 0.3;
/// Least share of the told stiffness. [-; measured: `cells.py --map`: 0.7 is as good]
inline constexpr double kSoftOilLeast = 0.6;
/// Most of it: what rings faster than its mode is stiffer than told. [-; measured: `campaign dig
/// --errors all --speed 0.3 --draws 20`: 23 mm at most; with 1, 47, of one machine that rings]
inline constexpr double kStiffOilMost = 1.5;

// Load that spools are opened for (held_load.cpp)

/// Time constant of the observer's load. [s; chosen: not tried]
inline constexpr double kHeldLoad_s = 0.1;
/// Time constant of the path's push. [s; chosen: the path's corners are steps; not tried]
inline constexpr double kHeldPush_s = 0.03;
/// Weight of the oil's law over the servo above which it decides: held loads, parked spools. [-;
/// chosen: not tried]
inline constexpr double kOilLeads = 0.5;

}  // namespace graben
