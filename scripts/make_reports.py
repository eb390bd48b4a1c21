#!/usr/bin/env python3
"""Makes the pages and pictures of fits and of sequences: of all pairs in data/, of the pairs and of some sequences of
$CERES_ED_DATA as far as they are there, and of a simulated heart.

Everything is run with the defaults; what a folder has of landmarks and truth is shown, too.

  scripts/make_reports.py                                  # build/reports/NAME.html and NAME.png
  scripts/make_reports.py --output=DIR --only heart_partial heart_sequence
  scripts/make_reports.py --readme                         # pictures of README.md and of report/README.md
"""
import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from program_runs import ROOT

# Sequences of $CERES_ED_DATA, and the one that is simulated.
SEQUENCES = ("liver_breath_render", "invivo_heart_40")
SIMULATED = "heart_sequence"


def find_pairs(folders):
    """Returns {name: folder} of all folders with a source and a target."""
    pairs = {}
    for folder in folders:
        for pair in sorted(Path(folder).iterdir()):
            if (pair / "source.ply").is_file() and (pair / "target.ply").is_file():
                pairs.setdefault(pair.name, pair)
    return pairs


def report(apps, pair, output, work):
    """Fits a pair, and writes OUTPUT.html and OUTPUT.png. Returns the size of the page in bytes."""
    # Pages name files as they are given: from the folder of the pair.
    run = Path(work) / pair.name
    start = {"cwd": pair.parent, "check": True}
    name = Path(pair.name)
    subprocess.run([apps / "ed_fit", name / "source.ply", name / "target.ply", f"--output={run}.ply",
                    f"--warp={run}_warp.json", f"--graph={run}_graph.ply", f"--report={run}.json",
                    "--covariance", "--quiet"], **start)
    truth = [f"--truth={name / 'gt.ply'}"] if (pair / "gt.ply").is_file() else []
    subprocess.run([apps / "ed_report", f"{run}.json", f"--html={output}.html", f"--png={output}.png",
                    *truth], **start)
    return Path(f"{output}.html").stat().st_size


def find_sequences(folders):
    """Returns {name: folder} of the sequences that are there; the simulated one has no folder yet."""
    sequences = {SIMULATED: None}
    for folder in folders:
        sequences.update({name: Path(folder) / name for name in SEQUENCES if (Path(folder) / name).is_dir()})
    return sequences


def report_sequence(apps, folder, output, work):
    """Tracks a sequence, and writes OUTPUT.html and OUTPUT.png. Returns the size of the page in bytes."""
    if folder is None:
        folder = Path(work) / "heart"
        subprocess.run([apps / "ed_simulate", "heart", f"--output={folder}", "--frames=60", "--quiet"], check=True)
    run = Path(work) / f"{output.name}_run"
    # Pages name files as they are given: from the folder of the sequence.
    start = {"cwd": folder.parent, "check": True}
    subprocess.run([apps / "ed_slam", folder.name, f"--output={run}", "--live_every=1", "--quiet"], **start)
    subprocess.run([apps / "ed_report", run, f"--html={output}.html", f"--png={output}.png"], **start)
    return Path(f"{output}.html").stat().st_size


def screenshot(page, picture, script, width=1200, height=1120):
    """Takes a picture of a page with headless Chromium, after a script has run in it."""
    sys.path.insert(0, str(ROOT / "test" / "report"))
    from browser import Missing, open_browser
    try:
        browser = open_browser(width, height)
    except Missing as missing:
        sys.exit(f"make_reports.py: {missing}")
    try:
        browser.get(page.resolve().as_uri())
        browser.execute_script(script)
        browser.execute_script("return ceresEd.pixels().length")
        browser.save_screenshot(str(picture))
    finally:
        browser.quit()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", help="the programs")
    parser.add_argument("--output", type=Path, default=ROOT / "build/reports", help="folder to write")
    parser.add_argument("--only", nargs="*", help="only these pairs and sequences")
    parser.add_argument("--readme", action="store_true", help="make the pictures of the pages")
    arguments = parser.parse_args()
    folders = [ROOT / "data"] + [Path(p) for p in [os.environ.get("CERES_ED_DATA")] if p]
    folders = [folder for folder in folders if folder.is_dir()]
    pairs, sequences = find_pairs(folders), find_sequences(folders)
    wanted = arguments.only or [*pairs, *sequences]
    if arguments.readme:
        wanted = ["heart_partial", SIMULATED]
    arguments.bin, arguments.output = arguments.bin.resolve(), arguments.output.resolve()
    arguments.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        for name in wanted:
            begin, output = time.monotonic(), arguments.output / name
            if name in pairs:
                size = report(arguments.bin, pairs[name], output, work)
            elif name in sequences:
                size = report_sequence(arguments.bin, sequences[name], output, work)
            else:
                sys.exit(f"make_reports.py: there is no {name}, expected one of {', '.join([*pairs, *sequences])}")
            print(f"{name}: {output}.html, {size / 1e6:.1f} MB, {time.monotonic() - begin:.0f} s", flush=True)
    if arguments.readme:
        make_pictures(arguments.output)


def make_pictures(reports):
    """Makes the pictures of the pages from the reports."""
    images = ROOT / "scripts/images"
    screenshot(reports / "heart_partial.html", images / "report.png",
               "document.getElementById('graph').click(); ceresEd.pick(0, 0)")
    screenshot(reports / f"{SIMULATED}.html", reports / "page.png", "", height=940)
    shrink(reports / "page.png", images / "sequence_report.png", 900)
    shrink(reports / f"{SIMULATED}.png", images / "tracking.png", 1100)


def shrink(picture, output, width):
    """Writes a picture with fewer pixels: as wide as a page shows it."""
    from PIL import Image
    large = Image.open(picture)
    size = (width, large.height * width // large.width)
    large.resize(size, Image.LANCZOS).save(output, optimize=True)


if __name__ == "__main__":
    main()
