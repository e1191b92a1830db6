# SPDX-License-Identifier: Apache-2.0
"""`graben grade` as tests run it: its figures, and what it refuses."""

import json
import os
import subprocess


def run(graben, *options):
    return subprocess.run([graben, "grade", *options], capture_output=True, text=True, timeout=120)


def figures_of(graben, folder, *options):
    """Of its summary; its files go into the folder."""
    summary = os.path.join(folder, "summary.json")
    done = run(graben, "--out", folder, "--summary", summary, *options)
    assert done.returncode == 0, f"{options}: {done.stdout}{done.stderr}"
    with open(summary, encoding="utf-8") as stream:
        return json.load(stream)


def refused(graben, *options, words):
    done = run(graben, *options)
    assert done.returncode != 0, f"{options} was taken"
    for word in words:
        assert word in done.stderr, f"{options}: '{word}' is not in: {done.stderr}"
