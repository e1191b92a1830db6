// SPDX-License-Identifier: Apache-2.0
// toml++'s and {fmt}'s own code, compiled once and linked in: what is deployed needs no library
// beyond the standard ones, and no source compiles it again.
#define TOML_IMPLEMENTATION
#include <fmt/format-inl.h>
#include <toml++/toml.h>

FMT_BEGIN_NAMESPACE
namespace detail {
template auto thousands_sep_impl<char>(locale_ref) -> thousands_sep_result<char>;
template auto decimal_point_impl(locale_ref) -> char;
}  // namespace detail
FMT_END_NAMESPACE
