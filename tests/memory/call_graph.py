# SPDX-License-Identifier: Apache-2.0
"""The deepest chain of calls of an image, and what stands in the way of knowing it."""

import re
import subprocess
import tomllib

from disassembly import Refusal, functions_of


def demangled(names):
    done = subprocess.run(
        ["c++filt"], input="\n".join(names) + "\n", stdout=subprocess.PIPE, text=True, check=True
    )
    return dict(zip(names, done.stdout.splitlines()))


class CallGraph:
    def __init__(self, tools, image, calls_file):
        self.functions = functions_of(tools, image)
        self.words = demangled(sorted({at.name for at in self.functions.values()}))
        self.outside = set()  # of a shared library: their stack is not known here
        self.calls = {key: self.direct(at) for key, at in self.functions.items()}
        with open(calls_file, "rb") as stream:
            self.listed = tomllib.load(stream)["call"]

    def word(self, key):
        return self.words[self.functions[key].name]

    def direct(self, function):
        targets = set()
        for address, name in function.calls:
            if "@plt" in name:
                self.outside.add(name.split("@")[0])
            elif address in self.functions:
                targets.add(address)
            else:
                # Into the middle: a cold part jumps back to its function.
                targets |= {
                    key
                    for key, at in self.functions.items()
                    if at.name == name.split("+0x")[0] and at is not function
                }
        return targets

    def resolve(self, reached):
        """The listed targets of the calls through pointers of what is reached."""
        for key in reached:
            if not self.functions[key].indirect or key in self.resolved:
                continue
            word = self.word(key)
            rows = [row for row in self.listed if re.search(row["from"], word)]
            if not rows:
                raise Refusal(f"{word}: a call through a pointer that calls.toml does not list")
            for row in rows:
                targets = {k for k in self.functions if re.search(row["to"], self.word(k))}
                if not targets:
                    raise Refusal(f"calls.toml: {row['to']!r} is no function of the image")
                self.calls[key] |= targets
            self.resolved.add(key)

    def reached(self, start):
        reached = {start}
        front = [start]
        while front:
            for target in self.calls[front.pop()] - reached:
                reached.add(target)
                front.append(target)
        return reached

    def deepest(self, entry):
        """(bytes, [(function, bytes of its own)]) of the deepest chain from the one function that
        `entry` matches."""
        starts = [key for key in self.functions if re.search(entry, self.word(key))]
        if len(starts) != 1:
            raise Refusal(f"{len(starts)} functions are called {entry}")
        self.resolved = set()
        while True:
            reached = self.reached(starts[0])
            known = len(self.resolved)
            self.resolve(reached)
            if len(self.resolved) == known:
                break
        for key in reached:
            if self.functions[key].dynamic:
                raise Refusal(f"{self.word(key)}: takes as much stack as it wants")
        return self.walk(starts[0])

    def walk(self, start):
        depth = {}  # by function: (bytes, next of the deepest chain)
        on_way = {}  # in the order of the calls
        todo = [(start, None)]
        while todo:
            key, targets = todo.pop()
            if targets is None:
                if key in depth:
                    continue
                if key in on_way:
                    way = list(on_way)
                    loop = [self.word(at) for at in way[way.index(key) :]] + [self.word(key)]
                    raise Refusal("recursion: " + " -> ".join(loop))
                on_way[key] = True
                targets = sorted(self.calls[key])
                todo.append((key, targets))
                todo += [(target, None) for target in targets]
            else:
                below = max(((depth[t][0], t) for t in targets), default=(0, None))
                depth[key] = (self.functions[key].frame + below[0], below[1])
                del on_way[key]
        chain = []
        key = start
        while key is not None:
            chain.append((self.word(key), self.functions[key].frame))
            key = depth[key][1]
        return depth[start][0], chain
