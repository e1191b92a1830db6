#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: the core's archives need nothing of an operating system and keep no global state.

Archives are given from the inside out: each may use itself, those before it and ALLOWED.
"""

import argparse
import collections
import pathlib
import re
import subprocess
import sys

Symbol = collections.namedtuple("Symbol", "object name kind section")

# Pure functions of the C library, and what the compiler itself asks for: on 32-bit Arm also for
# arithmetic with 64 bits. All libm, double only.
ALLOWED = set("""
    memcpy memset memmove memcmp
    sqrt cbrt hypot pow exp exp2 expm1 log log2 log10 log1p
    sin cos tan sincos asin acos atan atan2 sinh cosh tanh
    fabs floor ceil trunc round lround llround rint lrint nearbyint fmod remainder fmin fmax
    copysign ldexp frexp
    _GLOBAL_OFFSET_TABLE_ __stack_chk_fail __cxa_pure_virtual
    __aeabi_d2lz __aeabi_d2ulz __aeabi_l2d __aeabi_ul2d __aeabi_ldivmod __aeabi_uldivmod
    __aeabi_idiv __aeabi_uidiv __aeabi_idivmod __aeabi_uidivmod
    __aeabi_memcpy __aeabi_memcpy4 __aeabi_memcpy8 __aeabi_memset __aeabi_memset4 __aeabi_memclr
""".split())

# Why a symbol is refused; the first match counts. Names as nm shows them, mangled.
CLASSES = [
    ("heap", r"(m|c|re)alloc$|free$|aligned_alloc$|posix_memalign$|_Zn[wa]|_Zd[la]"),
    ("exceptions", r"__cxa_(throw|allocate_exc|begin_catch|end_catch|rethrow|bad_)|_Unwind_"
                   r"|__gxx_personality|_ZSt9terminate|_ZSt\d+__throw_|__cxa_call_unexpected"),
    ("globals", r"__cxa_(guard|atexit|thread_atexit)|atexit$|__dso_handle"),
    ("threads", r"pthread_|sem_|__tls_get_addr|_ZNSt(6thread|5mutex)|__libc_single_threaded"),
    ("clock", r"clock|time$|gettimeofday$|nanosleep$|usleep$|sleep$|_ZNSt6chrono"),
    ("stdio", r"v?(f|s|sn|d)?printf$|__\w*printf_chk$|puts$|fputs$|putchar$|f?put?c$|f(open|write|"
              r"read|close|flush)$|std(in|out|err)$|_ZSt4c(out|err|in)$|_ZNSo|_ZSt16__ostream"),
    ("abort", r"abort$|__assert_fail$|exit$|_exit$"),
    ("run-time types", r"_ZTVN10__cxxabiv1|__dynamic_cast|_ZTI"),
]
HINTS = {
    "_Zd": "a virtual destructor asks for delete: make it protected and not virtual",
    "_ZTVN10__cxxabiv1": "compile with -fno-rtti",
}
# .data.rel.ro is constant once the program is loaded.
WRITABLE = re.compile(r"\.(data(?!\.rel\.ro)|bss|tdata|tbss)|\*COM\*")


def symbols_of(nm: str, archive: pathlib.Path) -> list[Symbol]:
    output = subprocess.run([nm, "-A", "-f", "sysv", str(archive)],
                            stdout=subprocess.PIPE, text=True, check=True).stdout
    symbols = []
    for line in output.splitlines():
        # archive:object:name |value|class|type|size|line|section
        fields = [field.strip() for field in line.split("|")]
        if len(fields) == 7:
            _, member, name = fields[0].rsplit(":", 2)
            symbols.append(Symbol(member, name, fields[2], fields[6]))
    return symbols


def readable(name: str) -> str:
    done = subprocess.run(["c++filt", name], stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout.strip()


def refusal(symbol: Symbol) -> str:
    why = next((c for c, pattern in CLASSES if re.match(pattern, symbol.name)), "not on the list")
    hint = next((f" ({h})" for start, h in HINTS.items() if symbol.name.startswith(start)), "")
    return f"{symbol.object} needs {readable(symbol.name)}: {why}{hint}"


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("archives", nargs="+", type=pathlib.Path)
parser.add_argument("--nm", default="nm", help="the target's own")
arguments = parser.parse_args()
problems = []
provided = set(ALLOWED)
for archive in arguments.archives:
    if not archive.is_file():
        sys.exit(f"purity: {archive} does not exist: the gate is dead")
    symbols = symbols_of(arguments.nm, archive)
    defined = [s for s in symbols if s.kind not in ("U", "w", "v")]
    if not any(s.kind in ("T", "t", "W") for s in defined):
        sys.exit(f"purity: {archive} has no code: the gate is dead")
    provided |= {s.name for s in defined}
    problems += [f"{archive.name}: {refusal(s)}"
                 for s in symbols if s.kind in ("U", "w", "v") and s.name not in provided]
    problems += [f"{archive.name}: {s.object} keeps {readable(s.name)} in {s.section}: "
                 "writable global" for s in defined if WRITABLE.match(s.section)]
    problems += [f"{archive.name}: {s.object} runs code before main: globals"
                 for s in defined if s.name.startswith("_GLOBAL__sub_I_")]
    print(f"purity: {archive.name}: {len(symbols)} symbols")
for problem in sorted(set(problems)):
    print(problem)
sys.exit(1 if problems else 0)
