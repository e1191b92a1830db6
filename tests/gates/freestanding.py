# SPDX-License-Identifier: Apache-2.0
"""The core and what it links are freestanding: which folders, and the headers that they may take. A
list of what is allowed, so that a header nobody has thought of is refused."""

FREESTANDING = ("firmware/", "hal/", "can_dbc/")
ALLOWED_HEADERS = set("""
    algorithm array bitset cfloat climits cmath cstddef cstdint cstring initializer_list iterator
    limits numeric optional string_view tuple type_traits utility variant
""".split())
