#!/usr/bin/env python3
"""Opens the pages of a fit and of a sequence in Firefox: firefox_test.py APPS

Skipped with a line that begins with "SKIPPED: " where there is no Firefox, no Xvfb or no WebGL.
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from browser import Missing
from firefox import Firefox

ROOT = Path(__file__).resolve().parents[2]
APPS = None
WORK = None
FIREFOX = None

DRAWN = """
    const pixels = ceresEd.pixels();
    let others = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      if ([0, 1, 2].some((c) => Math.abs(pixels[i + c] - pixels[c]) > 8)) ++others;
    }
    return others / (pixels.length / 4);"""


def run(program, *arguments):
    subprocess.run([APPS / program, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


class Pages(unittest.TestCase):
    def open(self, page):
        FIREFOX.get(page.as_uri())
        self.assertTrue(FIREFOX.run("return window.ceresEd && ceresEd.ready"))

    def tearDown(self):
        self.assertEqual(FIREFOX.run("return ceresEd.errors"), [])

    def test_a_fit_is_drawn_and_its_slider_moves_it(self):
        pair, page = ROOT / "data/plane_bumps", WORK / "fit.html"
        run("ed_fit", pair / "source.ply", pair / "target.ply", f"--output={WORK / 'fit.ply'}", f"--html={page}", "-q")
        self.open(page)
        share = FIREFOX.run(DRAWN)
        self.assertGreater(share, 0.05)
        self.assertLess(share, 0.95)
        ends = [FIREFOX.run("ceresEd.setWay(arguments[0]); return ceresEd.places(2)", at) for at in (0, 1)]
        self.assertNotEqual(*ends)

    def test_a_sequence_is_drawn_its_slider_moves_it_and_it_can_be_printed(self):
        sequence, page = WORK / "heart", WORK / "slam.html"
        run("ed_simulate", "heart", f"--output={sequence}", "--frames=5", "--quiet")
        run("ed_slam", sequence, f"--output={WORK / 'tracked'}", f"--html={page}", "--quiet")
        self.open(page)
        share = FIREFOX.run(DRAWN)
        self.assertGreater(share, 0.02)
        self.assertLess(share, 0.95)
        ends = [FIREFOX.run("ceresEd.setWay(arguments[0]); return ceresEd.places(0)", at) for at in (0, 1)]
        self.assertNotEqual(*ends)
        plot = FIREFOX.run("""
            const plot = document.querySelector('svg.frames'), box = plot.getBoundingClientRect();
            const x = box.left + (72 + 0.5 * (544 - 72)) / 560 * box.width;
            plot.dispatchEvent(new MouseEvent('click', {clientX: x, clientY: box.top + 30, bubbles: true}));
            return document.getElementById('frameText').value;""")
        self.assertIn("Frame 2:", plot)
        FIREFOX.print(WORK / "slam.pdf")
        self.assertEqual((WORK / "slam.pdf").read_bytes()[:5], b"%PDF-")
        self.assertGreater((WORK / "slam.pdf").stat().st_size, 20000)


def main():
    global APPS, WORK, FIREFOX
    APPS = Path(sys.argv.pop(1)).resolve()
    try:
        FIREFOX = Firefox()
    except Missing as missing:
        print(f"SKIPPED: {missing}")
        return
    try:
        FIREFOX.get("about:blank")
        if not FIREFOX.run("return !!document.createElement('canvas').getContext('webgl')"):
            print("SKIPPED: this Firefox has no WebGL (it needs a display: Debian's xvfb)")
            return
        with tempfile.TemporaryDirectory() as work:
            WORK = Path(work)
            page = WORK / "first.html"
            pair = ROOT / "data/plane_bumps"
            run("ed_fit", pair / "source.ply", pair / "target.ply", f"--output={WORK / 'first.ply'}", f"--html={page}",
                "-q")
            if "built without three.js" in page.read_text():
                print("SKIPPED: pages have no view, because libjs-three was missing when this was built")
                return
            result = unittest.main(exit=False, verbosity=2).result
    finally:
        FIREFOX.quit()
    sys.exit(0 if result.wasSuccessful() else 1)


if __name__ == "__main__":
    main()
