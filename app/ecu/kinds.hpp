// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The machine kinds that are built in: a new one is a line here.

#include <type_traits>
#include <variant>

#include "app/ecu/dozer_kind.hpp"
#include "app/ecu/excavator_kind.hpp"

namespace graben::ecu {

template <class... Kind>
struct KindList {
  /// What a profile is read as, whatever its kind.
  using AnyMachine = std::variant<typename Kind::Machine...>;
};

using Kinds = KindList<ExcavatorKind, DozerKind>;

namespace detail {

/// The first kind of the list whose profile is read as a `Machine`.
template <class Machine, class List>
struct KindOf;
template <class Machine, class First, class... Rest>
struct KindOf<Machine, KindList<First, Rest...>>
    : std::conditional_t<std::is_same_v<Machine, typename First::Machine>,
                         std::enable_if<true, First>, KindOf<Machine, KindList<Rest...>>> {};
template <class Machine>
struct KindOf<Machine, KindList<>> {};

}  // namespace detail

/// The kind whose controller a machine takes.
template <class Machine>
using KindOf = typename detail::KindOf<Machine, Kinds>::type;

}  // namespace graben::ecu
