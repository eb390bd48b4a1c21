#!/usr/bin/env python3
"""Makes the pages and pictures of fits: of all pairs in data/, and of those of $CERES_ED_DATA that are there.

Each pair is fitted with the defaults; what its folder has of landmarks and truth is shown, too.

  scripts/make_reports.py                                  # build/reports/PAIR.html and PAIR.png
  scripts/make_reports.py --output=DIR --pairs heart_partial kidney_partial
  scripts/make_reports.py --readme                         # scripts/images/report.png, of the page in report/README.md
"""
import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from program_runs import ROOT


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


def screenshot(page, picture, width=1200, height=1120):
    """Takes a picture of a page with headless Chromium."""
    sys.path.insert(0, str(ROOT / "test" / "report"))
    from browser import Missing, open_browser
    try:
        browser = open_browser(width, height)
    except Missing as missing:
        sys.exit(f"make_reports.py: {missing}")
    try:
        browser.get(page.resolve().as_uri())
        browser.execute_script("document.getElementById('graph').click(); ceresEd.pick(0, 0)")
        browser.execute_script("return ceresEd.pixels().length")
        browser.save_screenshot(str(picture))
    finally:
        browser.quit()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", help="the programs")
    parser.add_argument("--output", type=Path, default=ROOT / "build/reports", help="folder to write")
    parser.add_argument("--pairs", nargs="*", help="only these")
    parser.add_argument("--readme", action="store_true", help="make the picture of the page about reports")
    arguments = parser.parse_args()
    folders = [ROOT / "data"] + [Path(p) for p in [os.environ.get("CERES_ED_DATA")] if p]
    pairs = find_pairs(folder for folder in folders if folder.is_dir())
    wanted = ["heart_partial"] if arguments.readme else arguments.pairs or list(pairs)
    arguments.bin, arguments.output = arguments.bin.resolve(), arguments.output.resolve()
    arguments.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        for name in wanted:
            if name not in pairs:
                sys.exit(f"make_reports.py: there is no pair {name}, expected one of {', '.join(pairs)}")
            size = report(arguments.bin, pairs[name], arguments.output / name, work)
            print(f"{name}: {arguments.output / name}.html, {size / 1e6:.1f} MB", flush=True)
    if arguments.readme:
        screenshot(arguments.output / "heart_partial.html", ROOT / "scripts/images/report.png")


if __name__ == "__main__":
    main()
