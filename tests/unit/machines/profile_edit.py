# SPDX-License-Identifier: Apache-2.0
"""Profiles with something wrong: by their text, and key by key."""

import copy
import json
import re
import tomllib


def replaced(text, old, new):
    assert text.count(old) >= 1, f"'{old}' is not in the profile"
    return text.replace(old, new, 1)


def changed(text, change):
    """By pairs of old and new text, or by a function of the whole."""
    if callable(change):
        return change(text)
    for old, new in change.items():
        text = replaced(text, old, new)
    return text


def leaves(value, path=()):
    """Every key below which there is no further one: ('pump', 0, 'speed')."""
    if isinstance(value, dict):
        return [leaf for key, below in value.items() for leaf in leaves(below, (*path, key))]
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [leaf for i, below in enumerate(value) for leaf in leaves(below, (*path, i))]
    return [path]


def key_path(path):
    """As a profile's errors write it: pump[0].speed."""
    text = ""
    for step in path:
        text += f"[{step}]" if isinstance(step, int) else ("." if text else "") + step
    return text


def key_text(key):
    """As a file has it: quoted where it is a path of its own."""
    return key if re.fullmatch(r"[\w-]+", key) else json.dumps(key)


def value_text(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key_text(k)} = {value_text(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(value_text(v) for v in value) + "]"
    return json.dumps(value)


def toml_text(document):
    return "".join(f"{key_text(key)} = {value_text(value)}\n" for key, value in document.items())


def at(document, path):
    for step in path:
        document = document[step]
    return document


def without(text, path):
    document = copy.deepcopy(tomllib.loads(text))
    del at(document, path[:-1])[path[-1]]
    return toml_text(document)


def with_number(text, path, number):
    """The key's number, or the first one of its array, set to this."""
    document = copy.deepcopy(tomllib.loads(text))
    holder, step = at(document, path[:-1]), path[-1]
    while isinstance(holder[step], list):
        holder, step = holder[step], 0
    holder[step] = int(number) if isinstance(holder[step], int) else number
    return toml_text(document)
