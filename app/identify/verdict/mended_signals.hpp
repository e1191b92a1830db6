// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What recordings do to their numbers, undone before anything is judged: angles that wrap at a
/// full turn, numbers that stand for "no value", a command called one-sided that goes both ways.

#include "app/identify/verdict/signal_log.hpp"

namespace graben::identify {

/// Mends the drives' signals in place; what was done is said in the log's notes.
void mend_signals(SignalLog& log);

}  // namespace graben::identify
