# SPDX-License-Identifier: Apache-2.0
"""What a machine has of that which loops go over: counts_KIND.toml, which write_constants writes of the same setup that
it writes into the image, for any machine of the kind and for some shipped ones.

A row of loops.toml or facts.toml with `machine = "pumps"` holds with that count, times `each`, where it is less than
what the row says. So an image has several bounds: of any profile that its code could be given, and of shipped ones.
"""

import tomllib

from listing import Refusal

NAMES = {"drives", "pumps", "regulated_pumps", "fences", "keep_outs", "link_imus", "tables", "wheels",
         "solve_steps", "cycle_steps"}


def counts(file):
    """{machine: {name: count}}; "any", the first, has the most of any machine of the kind."""
    with open(file, "rb") as stream:
        found = tomllib.load(stream)
    if next(iter(found), None) != "any" or len(found) < 2:
        raise Refusal(f"{file}: no counts of any machine, or of none beside it")
    for whose, ones in found.items():
        if more := [name for name, count in ones.items() if count > found["any"].get(name, -1)]:
            raise Refusal(f"{file}: {whose} has more than any machine: {', '.join(more)}")
        if wrong := [name for name, count in ones.items() if name not in NAMES or type(count) is not int or count < 0]:
            raise Refusal(f"{file}: {whose}: no counts from 0 on, or nobody asks for them: {', '.join(wrong)}")
    return found


def holds(row, machine):
    """Whether a row is of this machine: not where it is of those without something that this one has."""
    if "only_with" not in row:
        return True
    if row["only_with"] not in NAMES:
        raise Refusal(f"{row['calls']}: nobody counts the {row['only_with']} of a machine")
    return machine is not None and machine.get(row["only_with"]) == 0


def of_machine(row, count, machine):
    """What a kind of machine does not have at all is not counted of it: its code has no such loop, or the row's count."""
    if "machine" not in row:
        return count
    if row["machine"] not in NAMES:
        raise Refusal(f"{row.get('line') or row.get('calls')}: nobody counts the {row['machine']} of a machine")
    if machine is None or row["machine"] not in machine:
        return count
    return min(count, machine[row["machine"]] * row.get("each", 1))
