#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: a target's own compiler finds no header of a heap or an operating system in the core's sources.

Every such header of the target has a shadow before it, which is an error once all that the core may
take has been read: the allowed headers, and Eigen, which reads more. So what a source takes by a way
round is refused too. `layering` reads what the sources say; this is what the compiler makes of it.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

import tree
from freestanding import ALLOWED_HEADERS, FREESTANDING

# What is refused: all of C++17 and C, and what an operating system has beside them.
SHADOWED = """
    any atomic bit cassert ccomplex cctype cerrno cfenv charconv chrono cinttypes ciso646 clocale
    codecvt complex condition_variable csetjmp csignal cstdarg cstdio cstdlib ctime cuchar cwchar
    cwctype deque exception execution filesystem forward_list fstream functional future iomanip ios
    iosfwd iostream istream list locale map memory memory_resource mutex new ostream queue random
    ratio regex scoped_allocator set shared_mutex sstream stack stdexcept streambuf string strstream
    system_error thread typeindex typeinfo unordered_map unordered_set valarray vector
    assert.h ctype.h errno.h fenv.h locale.h setjmp.h signal.h stdio.h stdlib.h threads.h time.h
    uchar.h wchar.h wctype.h
    aio.h dirent.h dlfcn.h fcntl.h ifaddrs.h malloc.h mqueue.h netdb.h poll.h pthread.h pwd.h sched.h
    semaphore.h spawn.h syslog.h termios.h unistd.h
    linux/can.h linux/can/raw.h net/if.h netinet/in.h sys/epoll.h sys/ioctl.h sys/mman.h sys/prctl.h
    sys/random.h sys/resource.h sys/select.h sys/socket.h sys/stat.h sys/time.h sys/timerfd.h
    sys/times.h sys/types.h sys/un.h sys/wait.h
""".split()
# What of Eigen works without a heap. The rest reads more headers, and is refused by them.
EIGEN = {"Eigen/Core", "Eigen/Geometry", "Eigen/LU"}


def write_shadows(folder: pathlib.Path):
    for name in SHADOWED:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(f"#ifdef GRABEN_IN_THE_CORE\n#error <{name}> is not for the core\n"
                                   f"#else\n#include_next <{name}>\n#endif\n")


def one_source(names: list[str]) -> str:
    """All sources behind what they may take; only to be preprocessed, so none is in another's way."""
    allowed = [f"#include <{header}>" for header in sorted(ALLOWED_HEADERS | EIGEN)]
    return "\n".join([*allowed, "#define GRABEN_IN_THE_CORE", *(f'#include "{n}"' for n in names), ""])


parser = tree.arguments(__doc__)
parser.add_argument("command", nargs="+", help="the target's compiler with its options, after --")
arguments = parser.parse_args()
root = arguments.root.resolve()
sources = [n for n in tree.files(root) if n.startswith(FREESTANDING) and n.endswith(tree.CXX)]
with tempfile.TemporaryDirectory(prefix="graben-shadow-") as temporary:
    folder = pathlib.Path(temporary)
    write_shadows(folder)
    (folder / "all.cpp").write_text(one_source(sources))
    done = subprocess.run([*arguments.command, "-std=c++17", "-E", "-o", str(folder / "all.ii"),
                           "-isystem", str(folder), "-I", str(root), str(folder / "all.cpp")],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
print(done.stdout, end="")
refused = re.findall(r"error: (#error .*|.*: No such file.*)", done.stdout)
if done.returncode != 0 and not refused:
    sys.exit("shadow: the compiler failed for another reason")
tree.report("shadow", sorted(set(refused)), len(sources), "sources")
