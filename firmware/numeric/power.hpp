// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A power of a positive number. The C library's brings 5.7 kB of code and tables to a controller
/// that has 240 KiB of flash; this one needs its exp(), which is there anyway.

namespace graben {

/// base^exponent, within 2e-14 of itself for bases from 1e-9 to 1e9 and exponents from -4 to 4; 0
/// for a base of 0 and less, or one that is no number. An infinite base is taken for the largest
/// number.
[[nodiscard]] double power(double base, double exponent);

}  // namespace graben
