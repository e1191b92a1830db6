# SPDX-License-Identifier: Apache-2.0
"""Which room, the first two folders of a path, includes which, and whether a circle is in it."""

import pathlib


def room(name: str) -> str:
    return "/".join(pathlib.PurePosixPath(name).parts[:-1][:2])


def edges(includes) -> dict[str, dict[str, str]]:
    """Room -> room that it includes -> the first #include that does."""
    found: dict[str, dict[str, str]] = {}
    for name, headers in includes.of.items():
        for line, header, _ in headers:
            if header in includes.sources and room(header) != room(name):
                found.setdefault(room(name), {}).setdefault(room(header), f"{name}:{line} includes {header}")
    return found


def circle(found: dict[str, dict[str, str]]) -> list[str]:
    """The rooms of one circle, the first again at the end; nothing if there is none."""
    done: set[str] = set()

    def walk(here: str, path: list[str]) -> list[str]:
        if here in path:
            return [*path[path.index(here):], here]
        if here in done:
            return []
        for there in sorted(found.get(here, {})):
            if around := walk(there, [*path, here]):
                return around
        done.add(here)
        return []

    for start in sorted(found):
        if around := walk(start, []):
            return around
    return []
