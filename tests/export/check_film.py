# SPDX-License-Identifier: Apache-2.0
"""`graben film`: a few seconds of a dig, by ffprobe of the asked size, pictures and duration; its pictures are not
blank and not all the same; what it cannot do is said.

check_film.py GRABEN
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SIZE = (640, 400)
FPS = 5
FROM_S, UNTIL_S = 6.0, 8.0
BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def call(graben, *words, status=0, path=None):
    environment = {**os.environ, "PATH": path} if path else None
    done = subprocess.run([graben, *map(str, words)], capture_output=True, text=True, env=environment)
    assert done.returncode == status, f"{words}: status {done.returncode}: {done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def probe(film):
    said = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                           "stream=codec_name,width,height,nb_read_frames,avg_frame_rate:format=duration", "-of", "json",
                           str(film)], capture_output=True, text=True, check=True).stdout
    found = json.loads(said)
    return {**found["streams"][0], "duration": float(found["format"]["duration"])}


def pictures(film):
    """Grey pixels of each picture."""
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", str(film), "-f", "rawvideo", "-pix_fmt", "gray", "-"],
                         capture_output=True, check=True).stdout
    size = SIZE[0] * SIZE[1]
    return [raw[at:at + size] for at in range(0, len(raw), size)]


def spread(picture):
    mean = sum(picture) / len(picture)
    return (sum((pixel - mean) ** 2 for pixel in picture) / len(picture)) ** 0.5


def moved(one, other):
    """Share of the pixels that are clearly others."""
    return sum(abs(a - b) > 40 for a, b in zip(one, other)) / len(one)


def is_there(film):
    found = probe(film)
    count = round((UNTIL_S - FROM_S) * FPS)
    assert (found["width"], found["height"]) == SIZE, found
    assert int(found["nb_read_frames"]) == count, found
    assert found["avg_frame_rate"] == f"{FPS}/1" and abs(found["duration"] - count / FPS) < 0.05, found
    seen = pictures(film)
    assert len(seen) == count, len(seen)
    # A page without its scene has some text on one colour: the scene alone has more.
    for picture in (seen[0], seen[-1]):
        assert spread(picture) > 15, f"a blank picture: {spread(picture):.1f}"
        middle = [picture[row * SIZE[0] + column] for row in range(120, 280, 2) for column in range(60, 320, 2)]
        assert len(set(middle)) > 20, f"no machine in the picture: {len(set(middle))} shades"
    share = moved(seen[0], seen[-1])
    assert share > 0.002, f"nothing moves: {share:.5f} of the pixels"
    return f"{found['codec_name']}, {count} pictures, spread {spread(seen[0]):.0f}, {100 * share:.1f} % moved"


def refusals(graben, folder, log):
    def refused(needle, *words, status=1, path=None):
        said = call(graben, "film", *words, status=status, path=path)
        assert needle in said, f"{words}: {said}"

    out = folder / "no.webm"
    refused("allowed: WIDTHxHEIGHT", log, "--out", out, "--size", "641x400")
    refused("allowed: a name that ends with .webm or .mp4", log, "--out", folder / "no.gif")
    refused("0 is not a whole number from 1 to 60", log, "--out", out, "--fps", 0, status=2)
    refused("none.log", folder / "none.log", "--out", out)
    # A log's last line may be cut, no other.
    cut = folder / "cut.log"
    text = log.read_text()
    cut.write_text(text[:5000] + "\n" + text[text.index("\n", 5000) + 1:9000])
    refused("cut.log", cut, "--out", out)
    refused("nothing is between", log, "--out", out, "--from", 1000)
    copy = folder / "log.webm"
    shutil.copy(log, copy)
    refused("would overwrite", copy, "--out", copy, "--force")
    (folder / "kept.webm").write_text("kept")
    refused("--force", log, "--out", folder / "kept.webm")
    # Without one program, then without the other.
    programs = folder / "programs"
    programs.mkdir()
    refused("Debian has it in the package chromium", log, "--out", out, path=programs)
    browser = next(path for name in BROWSERS if (path := shutil.which(name)))
    (programs / "chromium").symlink_to(browser)
    refused("ffmpeg: there is no such program here; Debian has it in the package ffmpeg", log, "--out", out,
            path=programs)
    assert not list(folder.glob("no.*")), list(folder.glob("no.*"))


def main():
    graben = str(pathlib.Path(sys.argv[1]).resolve())
    if not shutil.which("ffprobe") or not any(map(shutil.which, BROWSERS)):
        print("SKIPPED film: no Chromium or no ffmpeg here (Debian: chromium, ffmpeg)")
        sys.exit(1 if os.environ.get("CI") == "true" else 0)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        call(graben, "dig", "--out", folder)
        log = folder / "dig.log"
        for film in (folder / "dig.webm", folder / "dig.mp4"):
            said = call(graben, "film", log, "--out", film, "--size", f"{SIZE[0]}x{SIZE[1]}", "--fps", FPS, "--from",
                        FROM_S, "--until", UNTIL_S)
            assert "640x400, 10 pictures, 2.00 s" in said, said
            print(f"{film.name}: {is_there(film)}", flush=True)
        refusals(graben, folder, log)


if __name__ == "__main__":
    main()
