// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers that were chosen for tip force and payload, each with why: the balances, their terms
/// before anything is seen, what is learnt, and when the bucket is free, carries or pours.

namespace graben {

// Bucket of unsaid shape (link_moments.cpp)

/// Floor of a bucket whose profile does not say it, as a share of its length pin to teeth. [-;
/// chosen: a bucket's usual shape; not tried]
inline constexpr double kUnsaidFloor = 0.45;
/// Angle of such a floor below the line teeth to pin. [rad; chosen: a bucket's usual shape; not
/// tried]
inline constexpr double kUnsaidFloor_rad = 0.65;

// Balance of forces and its low-pass (load_balance.cpp, paired_filter.hpp)

/// Cylinder speed below which only a part of the friction counts. [m/s; chosen: slower, its sign is
/// not known; not tried]
inline constexpr double kFrictionMoves_mps = 0.006;
/// Corner frequency of the balances' low-pass, with a lag of 47 ms. [rad/s; chosen: slower misses
/// how soil's force changes, faster leaves mostly transducers' noise; not tried]
inline constexpr double kPairedCorner_radps = 30.0;
/// Damping ratio of the balances' low-pass. [-; chosen: little overshoot; not tried]
inline constexpr double kPairedDamping = 0.7;

// Terms before anything is seen (load_terms.cpp)

/// Standard deviation of a transducer's offset, as a share of its range. [-; chosen: near that of a
/// uniform 3 %, the bias of Kim et al., Section 5; not tried]
inline constexpr double kTransducerOffset = 0.0175;
/// Coulomb friction of a cylinder's seals over its cap area. [Pa; chosen: hardly any machine's is
/// known, it is learnt; not tried]
inline constexpr double kSealCoulomb_pa = 0.2e6;
/// Viscous friction of a cylinder's seals over its cap area, per speed. [Pa s/m; chosen: hardly any
/// machine's is known, it is learnt; not tried]
inline constexpr double kSealViscous_paspm = 0.9e6;
/// Standard deviation of the Coulomb friction, as a share of it. [-; chosen: not tried]
inline constexpr double kSealCoulombOff = 0.35;
/// Standard deviation of the viscous friction of seals and hoses, as a share of it. [-; chosen: it
/// has the hoses' loss too; not tried]
inline constexpr double kViscousOff = 0.6;
/// Standard deviation of a link's mass, as a share of it. [-; chosen: masses are right within a
/// tenth; not tried]
inline constexpr double kLinkMassOff = 0.1;

// What a block of balances tells (load_observer.cpp)

/// Standard deviation of a transducer's noise, as a share of its range. [-; chosen: 2 %, that of
/// Kim et al., Section 5; not tried]
inline constexpr double kTransducerNoise = 0.02;
/// Error of a force by wrong levers and strokes, as a share of it. [-; chosen: not tried]
inline constexpr double kLeverOff = 0.01;
/// Factor on the variance of a block: blocks share errors that are not noise. [-; chosen: each
/// tells less than it seems; tried 4]
inline constexpr double kBlocksAlike = 1.5;
/// Factor on the squared friction in the variance of an axis that stands. [-; chosen: its friction
/// is the same all the time, so it tells less; not tried]
inline constexpr double kStandingFriction = 4.0;
/// Standard deviations off the expected force from which something touches the bucket. [-; chosen:
/// not tried]
inline constexpr double kTouchDeviations = 4.0;
/// Share of an axis' time with one sign of speed from which its block counts as steady. [-; chosen:
/// an axis that stands has friction of any sign; not tried]
inline constexpr double kSteadySide = 0.99;
/// Standard deviation of the ground's force before a balance is seen. [N; chosen: what the ground
/// may do to the teeth; not tried]
inline constexpr double kGroundForceSd_n = 60e3;
/// Standard deviation of the told tip force, as a share of it. [-; chosen: the ground also bears
/// the floor, and force changes within the lag; by runs in four soils, others not tried]
inline constexpr double kTipForceOff = 0.25;

// What a bucket carries (load_observer.cpp)

/// Payload of a full bucket over the cube of its length pin to teeth. [kg/m3; chosen: what a bucket
/// may carry; tried 120]
inline constexpr double kBucketFill_kgpm3 = 450.0;
/// Standard deviation of an empty bucket's payload; as many kg m for its moment. [kg; chosen: not
/// tried]
inline constexpr double kEmptyPayloadSd_kg = 3.0;
/// Standard deviation of the payload of a steep open bucket, as a share of a full one. [-; chosen:
/// little stays in; not tried]
inline constexpr double kHangingFill = 0.05;
/// Standard deviation of where a payload lies, outwards. [m; chosen: not tried]
inline constexpr double kLoadOutwardSd_m = 0.05;
/// Standard deviation of the payload while a bucket fills: share of a full bucket. [-; chosen: not
/// tried]
inline constexpr double kFillGuessOff = 0.25;
/// Standard deviation of the payload while a bucket fills: share of the expected fill so far. [-;
/// chosen: not tried]
inline constexpr double kFillSoFarOff = 0.3;
/// Standard deviation of where the fill lies while it digs, outwards. [m; chosen: not tried]
inline constexpr double kFillOutwardSd_m = 0.1;
/// Readings of an axis that moves until a payload is told. [-; chosen: not tried by itself; was 5
/// blocks before readings counted]
inline constexpr int kPayloadReadings = 10;
/// Standard deviation below which a payload is told, as a share of a full bucket. [-; chosen: not
/// tried]
inline constexpr double kPayloadToldSd = 0.12;
/// Time without a balance after which the payload is no longer told. [s; chosen: a bucket that
/// carries keeps what it has, a transducer that is away for long is a broken one; not tried]
inline constexpr double kPayloadUnseen_s = 1.0;
/// Blocks in a row that contradict a payload until it is forgotten. [-; chosen: it was learnt from
/// what was no payload; not tried]
inline constexpr int kPayloadRefusedMost = 4;

// Heaps of poured soil (load_observer.cpp, load_phase.cpp)

/// Density of poured soil. [kg/m3; chosen: loose soil; not tried]
inline constexpr double kLooseSoil_kgpm3 = 1300.0;
/// Greatest height of a heap that the bucket may go back through. [m; chosen: higher no bucket
/// pours on, the rest was carried away or lies elsewhere; not tried]
inline constexpr double kHeapMost_m = 1.6;
/// Radius around a heap's middle within which it has its full height. [m; chosen: not tried]
inline constexpr double kHeapTop_m = 0.5;
/// Slope of a heap's sides beyond kHeapTop_m. [-; chosen: the gentlest of them; not tried]
inline constexpr double kHeapFalls = 0.6;

// When the bucket is free, carries, pours (load_phase.cpp)

/// Rise of the teeth since a lift began from which they are out of the ground. [m; chosen: not
/// tried]
inline constexpr double kLiftFree_m = 0.5;
/// Height over the ground that the machine stands on from which the teeth are clear. [m; chosen:
/// slopes are lower; not tried]
inline constexpr double kGroundClear_m = 0.4;
/// Attitude beyond which the bucket's opening looks down. [rad; chosen: 100 deg; not tried]
inline constexpr double kOpeningDown_rad = 1.75;
/// Attitude below which soil may fall out of a bucket that carries. [rad; chosen: not tried]
inline constexpr double kSoilSpills_rad = 0.8;
/// Attitude beyond which little stays in a bucket. [rad; chosen: not tried]
inline constexpr double kLittleStays_rad = 1.2;
/// Time with the opening down until a bucket is empty, and free of the ground until it carries. [s;
/// chosen: what it cannot keep has fallen out; not tried]
inline constexpr double kPoured_s = 1.5;
/// Share of an approach or a return after which the bucket may touch the ground. [-; chosen: such a
/// move ends at the ground; not tried]
inline constexpr double kMoveNearGround = 0.85;
/// Height over the ground from which even the end of a move is clear of it. [m; chosen: not tried]
inline constexpr double kMoveEndClear_m = 0.8;

}  // namespace graben
