# SPDX-License-Identifier: Apache-2.0
"""What an instruction that calculates makes of two values: (value, range, how it was made), each None where it
is not known. `made` is what turns.py asks for: ("plus", value, low, high, stride), ("and", a, b),
("lsl" or "lsr", a, n)."""


def fits(bits, span):
    low, high = -(1 << bits - 1), (1 << bits - 1) - 1
    return span if span and low <= span[0] and span[1] <= high and span != (low, high) else None


def total(state, a, b, less, bits):
    """a + b, or a - b; and what the flags are of, where it sets them."""
    minus = (a, b) if less else (a, (None, -b[1])) if b[0] is None and b[1] != -(1 << bits - 1) else None
    if b[0] is None:
        return (a[0], a[1] - b[1] if less else a[1] + b[1]), None, None, minus
    if a[0] is None and not less:
        return (b[0], a[1] + b[1]), None, None, None
    if less and a[0] == b[0]:
        return (None, a[1] - b[1]), None, None, minus
    (a_low, a_high), (b_low, b_high) = state.range_of(a), state.range_of(b)
    span = (a_low - b_high, a_high - b_low) if less else (a_low + b_low, a_high + b_high)
    made = None
    if (b_low, b_high) != state.limits(b[0]):
        made = ("plus", a, -b_high, -b_low, stride(state, b)) if less else \
            ("plus", a, b_low, b_high, stride(state, b))
    elif not less and (a_low, a_high) != state.limits(a[0]):
        made = ("plus", b, a_low, a_high, stride(state, a))
    return None, fits(bits, span), made, minus


def spread(state, a, index, bits):
    """a + something of which (low, high, stride) is known."""
    if index is None or a is None:
        return None, None, None
    low, high = state.range_of(a)
    return None, fits(bits, (low + index[0], high + index[1])), ("plus", a, *index)


def stride(state, value):
    how = state.made.get(value[0])
    return 1 << how[2] if how and how[0] == "lsl" and value[1] % (1 << how[2]) == 0 else 1


def scaled(state, value, by, bits):
    """(low, high, stride) of value << by."""
    low, high = state.range_of(value)
    if value[0] is not None and (low, high) == state.limits(value[0]):
        return None
    return (low << by, high << by, 1 << by) if fits(bits, (low << by, high << by)) else None


def either_bit(state, a, b, both):
    """The range of a | b, or of a ^ b."""
    if a is None or b is None:
        return None
    (a_low, a_high), (b_low, b_high) = state.range_of(a), state.range_of(b)
    if a[0] is None and b[0] is None:
        made = a[1] | b[1] if both else a[1] ^ b[1]
        return made, made
    if a_low >= 0 and b_low >= 0:
        top = max(a_high, b_high).bit_length()
        return (max(a_low, b_low) if both else 0), (1 << top) - 1
    return None


def masked(state, base, a, b):
    """and, bic"""
    low, high = state.range_of(a)
    n = b[1] if b and b[0] is None else None
    if base == "and" and n is not None and n >= 0:
        if 0 <= low and n + 1 & n == 0 and high <= n:
            return a, None, None
        return None, (0, min(n, high) if low >= 0 else n), ("and", a, b)
    if n is not None and (n >= 0 if base == "bic" else n < 0):
        less = n if base == "bic" else ~n
        if less & (less + 1) == 0:
            # Down to a multiple.
            return None, (low & ~less, high & ~less), ("lsl", None, less.bit_length())
    if base == "and" and b is not None:
        tops = [top for bottom, top in ((low, high), state.range_of(b)) if bottom >= 0]
        return None, (0, min(tops)) if tops else None, ("and", a, b)
    return None, (0, high) if low >= 0 else None, None


def shifted(value, kind, by, bits=32):
    unsigned = value & (1 << bits) - 1
    by &= 255
    if kind == "lsl":
        return unsigned << by & (1 << bits) - 1
    if kind == "lsr":
        return unsigned >> by
    if kind == "asr":
        return (unsigned - (1 << bits) if unsigned >> bits - 1 else unsigned) >> by
    by %= bits
    return (unsigned >> by | unsigned << bits - by) & (1 << bits) - 1


def shifted_span(state, base, a, n, bits):
    low, high = state.range_of(a)
    if a[0] is None:
        return (None, shifted(a[1], base, n, bits)), None, None
    if base == "lsl":
        return None, fits(bits, (low << n, high << n)) if n < bits else None, ("lsl", a, n)
    if base == "lsr" and low < 0:
        return None, (0, (1 << bits - n) - 1) if 0 < n <= bits else None, ("lsr", a, n)
    return None, (low >> n, high >> n), (base, a, n)


def multiple(state, a, b, bits):
    (a_low, a_high), (b_low, b_high) = state.range_of(a), state.range_of(b)
    if a[0] is None and b[0] is None:
        return (None, a[1] * b[1]), None, None
    ends = [x * y for x in (a_low, a_high) for y in (b_low, b_high)]
    return None, fits(bits, (min(ends), max(ends))), None
