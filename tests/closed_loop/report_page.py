# SPDX-License-Identifier: Apache-2.0
"""What a report has inside: the setup that its page begins with, and the log."""

import base64
import gzip
import json
import re


def setup_of(page: bytes) -> dict:
    return json.loads(re.search(rb'id="graben-setup">(.*?)</script', page, re.S)[1])


def log_of(setup: dict) -> bytes:
    return gzip.decompress(base64.b64decode(setup["run"]["log"], validate=True))


def assert_of_run(setup: dict, words: list[str], lines: set[str], least: int) -> None:
    """A whole run: its words, its plots of what no frame has, of equal length."""
    run = setup["run"]
    assert all(word in run["subtitle"] for word in words), run["subtitle"]
    assert {line["plot"] for line in run["truth"]["lines"]} == lines, run["truth"]["lines"]
    counts = {len(run["truth"]["time_s"]), len(run["way"]),
              *(len(line["values"]) for line in run["truth"]["lines"])}
    assert len(counts) == 1 and counts.pop() >= least, counts
    assert len(setup["machines"]) == 1 and setup["words"]["fault"], setup["machines"]
    assert run["summary"] and all(figure["label"] for figure in run["summary"])
