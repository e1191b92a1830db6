// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about the lead through a spool's lag: each was chosen.

namespace graben {

/// Time after which a led spool is to be where it is wanted. [s; chosen: the modelled spool's time
/// constant, where it is no slower; not tried]
inline constexpr double kLeadAhead_s = 0.02;
/// Leading duty below which neutral is sent as neutral. [-; chosen: far within any dead band; not
/// tried]
inline constexpr double kLeadHome = 1e-3;

/// Square of what a model is off, of the way that it goes within its time constant: up to this it
/// is trusted. [-; measured: `campaign dig --draws 40`: p95 35.6 mm without doubt, 37.0 at 1, 39.4
/// at 0.5]
inline constexpr double kLeadDoubted = 1.5;
/// The same from which on nothing is led. [-; measured: `campaign dig --draws 40 --found
/// spool_lag=0.015,spool_closes=0.05`: 60 / 141 mm where its most is not bounded]
inline constexpr double kLeadGivenUp = 5.0;
/// Time over which it is judged. [s; chosen: a few motions of a spool; not tried]
inline constexpr double kLeadJudged_s = 2.0;
/// Most that it adds. [-; measured: less than a dead band, or it changes a duty's sign: `campaign
/// dig --draws 20`, boom 0.3 changes a second, unbounded 3.0, 0.13 0.6; spools that open in 15 ms
/// and close in 50: 41 / 75 mm, unbounded 56 / 120; of 80 ms 51 / 129, 46 / 82]
inline constexpr double kLeadMost = 0.1;
/// Square of a way below which the model stands, and says nothing. [-; chosen: 1 % of the travel;
/// not tried]
inline constexpr double kLeadStill = 1e-4;

}  // namespace graben
