# SPDX-License-Identifier: Apache-2.0
"""One version: what the programs, a report and the scope's server say, the Debian package's changelog,
CHANGELOG.md and CITATION.cff are that of the project in CMakeLists.txt.

check_version.py GRABEN GRABEN_ECU
"""

import pathlib
import re
import subprocess
import sys
import tempfile

from report_page import setup_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests/scope"))
from clients import start  # noqa: E402
from web_socket import TEXT, WebSocket  # noqa: E402


def said(*command: str) -> str:
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.strip()


def first(pattern: str, file: str) -> str:
    match = re.search(pattern, (ROOT / file).read_text(encoding="utf-8"), re.MULTILINE)
    return match[1] if match else f"no version in {file}"


def of_report(graben: str) -> str:
    with tempfile.TemporaryDirectory() as folder:
        said(graben, "plan", "--out", folder)
        return setup_of(pathlib.Path(folder, "plan.html").read_bytes())["version"]


def of_server(graben: str) -> str:
    server, port = start(graben)
    try:
        page = WebSocket("127.0.0.1", port)
        page.block(10.0)
        while True:
            for opcode, content in page.take():
                if opcode == TEXT and content["kind"] == "setup":
                    return content["version"]
    finally:
        server.terminate()
        server.wait(timeout=1800)


def main() -> None:
    graben, ecu = sys.argv[1:]
    version = first(r"^project\(graben VERSION ([0-9.]+) ", "CMakeLists.txt")
    found = {
        "graben --version": said(graben, "--version"),
        "graben-ecu --version": said(ecu, "--version"),
        "./run --version": said(str(ROOT / "run"), "--version"),
        "a report": of_report(graben),
        "the scope's server": of_server(graben),
        "the package's changelog": first(r"\Agraben-ecu \(([^)]+)\) ", "app/ecu/package/changelog"),
        "CHANGELOG.md": first(r"^## \[?v?([0-9][^\] ]*)", "CHANGELOG.md"),
        "CITATION.cff": first(r"^version: \"?([^\"\s]+)", "CITATION.cff"),
    }
    others = [f"{who}: {other}" for who, other in found.items() if other != version]
    assert re.fullmatch(r"\d+\.\d+\.\d+", version) and not others, f"not {version}: {others}"
    print(f"{version}, say {', '.join(found)}")


main()
