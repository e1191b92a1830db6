#pragma once
/// TipLoad by itself. It is a value of the controller's status and stands with those: what stands
/// in for a machine sees no other header of the excavator.

#include "firmware/excavator/excavator_signals.hpp"  // IWYU pragma: export
