#!/usr/bin/env python3
"""Opens the pages of fits and of sequences in Chromium: browser_test.py APPS

Skipped with a line that begins with "SKIPPED: " where there is no Chromium.
"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from browser import Missing, complaints, open_browser

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "data"
APPS = None
WORK = None
BROWSER = None


def run(program, *arguments):
    subprocess.run([APPS / program, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


def fit(name, source, target, *flags):
    """Returns the page and the report of a fit."""
    page, report = WORK / f"{name}.html", WORK / f"{name}.json"
    run("ed_fit", source, target, f"--output={WORK / name}.ply", f"--html={page}", f"--report={report}",
        "--quiet", *flags)
    return page, json.loads(report.read_text())


def open_page(page, browser=None):
    browser = browser or BROWSER
    complaints(browser)  # Those of the page before.
    browser.get(page.as_uri())
    return browser


def ask(script, *arguments):
    return BROWSER.execute_script(script, *arguments)


class ShownPage(unittest.TestCase):
    """Opens the page of the class for each test, after which the browser has nothing to complain of."""

    def setUp(self):
        open_page(self.page)
        self.assertTrue(ask("return window.ceresEd && ceresEd.ready"))

    def tearDown(self):
        self.assertEqual(complaints(BROWSER), [])
        self.assertEqual(ask("return ceresEd.errors"), [])


class FitPage(ShownPage):
    @classmethod
    def setUpClass(cls):
        pair = DATA / "dolphin_bend"
        cls.page, cls.report = fit("dolphin", pair / "source.ply", pair / "target.ply",
                                   f"--landmarks={pair / 'landmarks.csv'}", "--covariance")

    def test_every_panel_draws_more_than_its_background(self):
        shares = ask("""
            const pixels = ceresEd.pixels(), canvas = document.getElementById('view');
            const width = canvas.width, height = canvas.height;
            return ceresEd.boxes().map((box) => {
              const first = 4 * ((height - 1 - Math.ceil(box.y)) * width + Math.ceil(box.x));
              let others = 0, all = 0;
              for (let y = Math.ceil(box.y); y < box.y + box.height - 1; ++y) {
                for (let x = Math.ceil(box.x); x < box.x + box.width - 1; ++x) {
                  const at = 4 * ((height - 1 - y) * width + x);
                  ++all;
                  if ([0, 1, 2].some((c) => Math.abs(pixels[at + c] - pixels[first + c]) > 8)) ++others;
                }
              }
              return others / all;
            });""")
        self.assertEqual(len(shares), 3)
        for share in shares:
            self.assertGreater(share, 0.05)
            self.assertLess(share, 0.95)

    def test_the_slider_takes_the_result_from_the_source_to_the_fitted_file(self):
        begin, end = (ask(f"ceresEd.setWay({way}); return ceresEd.places(2)") for way in (0, 1))
        source = ask("return ceresEd.places(0)")
        self.assertEqual(begin, source)
        moved = max(abs(a - b) for a, b in zip(begin, end))
        self.assertGreater(moved, 0.05 * self.report["target"]["diagonal"])
        sys.path.insert(0, str(ROOT / "scripts"))
        import ply
        fitted = ply.points(ply.read_ply(WORK / "dolphin.ply")).ravel()
        gap = max(abs(a - b) for a, b in zip(end, fitted))
        self.assertLess(gap, 1e-4 * self.report["target"]["diagonal"])

    def test_the_slider_moves_what_is_drawn(self):
        changed = ask("""
            const at = (way) => { ceresEd.setWay(way); return Uint8Array.from(ceresEd.pixels()); };
            const a = at(0), b = at(1);
            let changed = 0;
            for (let i = 0; i < a.length; i += 4) if (Math.abs(a[i] - b[i]) > 16) ++changed;
            return changed / (a.length / 4);""")
        self.assertGreater(changed, 0.01)

    def test_a_person_moves_the_slider_with_keys(self):
        slider = BROWSER.find_element("id", "way")
        self.assertEqual(slider.get_attribute("value"), "1000")
        slider.send_keys("\ue011")  # Home.
        self.assertEqual(ask("return ceresEd.state.way"), 0)
        self.assertIn("bent 0 %", slider.get_attribute("aria-valuetext"))

    def test_the_legend_has_the_range_of_the_data(self):
        keys = ask("return Array.from(document.getElementById('field').options, (o) => o.value)")
        self.assertEqual(keys[0], "")
        self.assertLessEqual({"distance", "stretch", "std_dev", "bend", "displacement"}, set(keys))
        for key in keys[1:]:
            low, high, text, values = ask("""
                ceresEd.chooseField(arguments[0]);
                const value = (id) => Number(document.getElementById(id).value);
                const values = ceresEd.surfaces.flatMap(
                    (s) => s.field(arguments[0]) ? Array.from(s.field(arguments[0]).values) : []);
                return [value('low'), value('high'), document.getElementById('legendRange').textContent,
                        values.filter((v) => !Number.isNaN(v)).sort((a, b) => a - b)];""", key)
            for value, word in zip((values[0], values[-1]), re.findall(r"-?[\d.]+(?:e-?\d+)?", text)):
                self.assertAlmostEqual(float(word), value, delta=1e-3 * values[-1], msg=key)
            sizes = sorted(abs(v) for v in values)
            percentile = sizes[round(0.98 * (len(sizes) - 1))]
            self.assertAlmostEqual(high / percentile, 1.0, delta=2e-3, msg=key)
            self.assertEqual(low, -high if key == "stretch" else 0, msg=key)

    def test_a_click_on_a_vertex_tells_its_figures(self):
        # Of the vertices of the result that face the camera, the nearest to it.
        point, pixel = ask("""
            const panel = ceresEd.panels[2], at = panel.position.array;
            const eye = panel.light.position, normals = panel.geometry.attributes.normal.array;
            let best = 0, least = Infinity;
            for (let i = 0; i < at.length / 3; ++i) {
              const to = [eye.x - at[3 * i], eye.y - at[3 * i + 1], eye.z - at[3 * i + 2]];
              const gap = Math.hypot(...to);
              const facing = to.reduce((sum, x, c) => sum + x * normals[3 * i + c], 0) / gap;
              if (facing > 0.9 && gap < least) { least = gap; best = i; }
            }
            return [best, ceresEd.pixelOf(2, best)];""")
        from selenium.webdriver import ActionChains
        view = BROWSER.find_element("id", "view")
        ask("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", view)
        size = view.size
        ActionChains(BROWSER).move_to_element_with_offset(
            view, round(pixel[0] - size["width"] / 2), round(pixel[1] - size["height"] / 2)).click().perform()
        picked = ask("return ceresEd.state.picked")
        self.assertIsNotNone(picked)
        near = ask("return [ceresEd.pixelOf(2, arguments[0]), ceresEd.pixelOf(2, arguments[1])]",
                   point, picked["point"])
        self.assertLess(max(abs(near[0][i] - near[1][i]) for i in (0, 1)), 12)
        text = BROWSER.find_element("id", "values").text
        value = ask("return ceresEd.surfaces[0].field('distance').values[arguments[0]]", picked["point"])
        self.assertRegex(text, r"^Vertex \d+ of fitted source at \(")
        told = re.search(r"distance to the other surface: ([\d.e-]+) file units", text)
        self.assertAlmostEqual(float(told.group(1)), value, delta=1e-3 * value)

    def test_the_number_of_a_vertex_tells_its_figures(self):
        row = BROWSER.find_element("id", "row")
        row.send_keys("17\t")
        self.assertIn("Vertex 17 of fitted source", BROWSER.find_element("id", "values").text)

    def test_keys_turn_and_zoom_the_view(self):
        view = BROWSER.find_element("id", "view")
        before = ask("return ceresEd.pixelOf(2, 0)")
        view.send_keys("\ue014")  # Right.
        after = ask("return ceresEd.pixelOf(2, 0)")
        self.assertNotEqual(before, after)
        view.send_keys("+")
        self.assertNotEqual(after, ask("return ceresEd.pixelOf(2, 0)"))
        view.send_keys("\ue011")  # Home.
        for a, b in zip(before, ask("return ceresEd.pixelOf(2, 0)")):
            self.assertAlmostEqual(a, b, delta=0.1)

    def test_surfaces_can_lie_over_each_other(self):
        ask("const l = document.getElementById('layout'); l.value = 'over'; l.dispatchEvent(new Event('change'))")
        boxes = ask("return ceresEd.boxes()")
        self.assertEqual(boxes[0], boxes[1])
        self.assertEqual(len(boxes), 2)

    def test_the_graph_has_pr_and_pi_nodes(self):
        BROWSER.find_element("id", "graph").click()
        counts = ask("""
            const dots = ceresEd.panels[2].graph.children.filter((c) => c.type === 'Points');
            return dots.map((d) => d.geometry.index.count);""")
        nodes = self.report["nodes"]
        self.assertEqual(sum(counts), nodes["total"])

    def test_landmarks_have_names_and_errors(self):
        labels = ask("return Array.from(document.querySelectorAll('.landmark'), (l) => l.textContent)")
        self.assertEqual(len(labels), self.report["landmarks"]["count"])
        text = BROWSER.find_element("tag name", "main").text
        for label in labels:
            self.assertIn(label, text)

    def test_every_plot_has_words_and_every_control_a_label(self):
        self.assertEqual(ask("""return Array.from(document.querySelectorAll('svg, canvas'))
            .filter((e) => !e.getAttribute('aria-label')).length"""), 0)
        self.assertEqual(ask("""return Array.from(document.querySelectorAll('input, select'))
            .filter((e) => !e.labels.length && !e.getAttribute('aria-label')).map((e) => e.id)"""), [])


class Widths(unittest.TestCase):
    def test_a_phone_scrolls_in_one_direction_only(self):
        page, _ = fit("heart", DATA / "heart_partial/source.ply", DATA / "heart_partial/target.ply")
        browser = open_browser(360, 740, is_phone=True)
        try:
            open_page(page, browser)
            self.assertTrue(browser.execute_script("return ceresEd.ready"))
            browser.execute_script("document.querySelectorAll('details').forEach((d) => d.open = true)")
            width = browser.execute_script("return document.documentElement.scrollWidth")
            self.assertLessEqual(width, 360)
            boxes = browser.execute_script("return ceresEd.boxes()")
            self.assertEqual({box["x"] for box in boxes}, {0})
            self.assertEqual(complaints(browser), [])
        finally:
            browser.quit()


class WithoutWebgl(unittest.TestCase):
    def test_the_picture_takes_the_place_of_the_view(self):
        page, _ = fit("plane", DATA / "plane_bumps/source.ply", DATA / "plane_bumps/target.ply")
        browser = open_browser(has_webgl=False)
        try:
            open_page(page, browser)
            self.assertFalse(browser.find_element("id", "viewer").is_displayed())
            picture = browser.find_element("css selector", "#still img")
            self.assertTrue(picture.is_displayed())
            self.assertGreater(picture.size["height"], 100)
            self.assertEqual(browser.execute_script("return ceresEd.errors"), [])
            self.assertIn("no WebGL", browser.find_element("id", "stillText").text)
        finally:
            browser.quit()


class FinishedRuns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        pair = DATA / "heart_partial"
        for name, flags in (("one", []), ("other", ["--w_reg=20"])):
            fit(name, pair / "source.ply", pair / "target.ply", f"--warp={WORK / name}_warp.json",
                f"--graph={WORK / name}_graph.ply", *flags)
        cls.truth = pair / "gt.ply"

    def report(self, *runs):
        page = WORK / "report.html"
        run("ed_report", *runs, f"--truth={self.truth}", f"--html={page}")
        open_page(page)
        self.assertTrue(ask("return ceresEd.ready"))
        self.assertEqual(complaints(BROWSER), [])

    def test_a_finished_fit_has_its_warp_and_its_true_errors(self):
        self.report(WORK / "one.json")
        self.assertEqual(ask("return ceresEd.state.field"), "truth")
        self.assertGreater(ask("return ceresEd.panels[2].surface.motion.stride"), 0)

    def test_results_are_compared_with_one_camera_and_one_range(self):
        self.report(WORK / "one.json", WORK / "other.json")
        self.assertEqual(ask("return ceresEd.panels.length"), 3)
        ranges = ask("return ceresEd.surfaces.slice(0, 2).map((s) => s.field('truth').high)")
        self.assertEqual(ranges[0], ranges[1])
        flags = [e.text for e in BROWSER.find_elements("css selector", "td:first-child")]
        self.assertIn("--w_reg", flags)
        self.assertNotIn("--w_rot", flags)


class SequencePage(ShownPage):
    @classmethod
    def setUpClass(cls):
        cls.sequence, cls.result = WORK / "heart", WORK / "tracked"
        run("ed_simulate", "heart", f"--output={cls.sequence}", "--frames=8", "--quiet")
        cls.page = WORK / "slam.html"
        run("ed_slam", cls.sequence, f"--output={cls.result}", f"--html={cls.page}", "--verify_every=4", "--quiet")
        cls.report = json.loads((cls.result / "report.json").read_text())

    def test_the_map_is_drawn(self):
        share = ask("""
            const pixels = ceresEd.pixels();
            let others = 0;
            for (let i = 0; i < pixels.length; i += 4) {
              if ([0, 1, 2].some((c) => Math.abs(pixels[i + c] - pixels[c]) > 8)) ++others;
            }
            return others / (pixels.length / 4);""")
        self.assertGreater(share, 0.05)
        self.assertLess(share, 0.95)

    def test_the_slider_moves_the_map_and_tells_the_frame(self):
        slider = BROWSER.find_element("id", "frame")
        end = ask("return ceresEd.places(0)")
        self.assertIn("Frame 7: tracked", ask("return document.getElementById('frameText').value"))
        slider.send_keys("\ue011")  # Home.
        self.assertNotEqual(end, ask("return ceresEd.places(0)"))
        self.assertIn("Frame 0: initialized", ask("return document.getElementById('frameText').value"))
        self.assertEqual(slider.get_attribute("aria-valuetext"), "frame 0, initialized")
        shown = "return ceresEd.panels[0].geometry.index.count"
        few = ask(shown)
        slider.send_keys("\ue010")  # End.
        self.assertGreater(ask(shown), few)

    def test_points_are_where_the_live_clouds_have_them(self):
        sys.path.insert(0, str(ROOT / "scripts"))
        import ply
        cloud = ply.read_ply(self.result / "live" / "000000.ply")["vertex"]
        # The frame of the map is the first camera.
        first = {int(i): p for i, p in zip(cloud["id"], zip(cloud["x"], cloud["y"], cloud["z"]))}
        ask("ceresEd.setWay(0)")
        places, rows = ask("return [ceresEd.places(0), Array.from(ceresEd.surfaces[0].rows)]")
        gaps = [max(abs(places[3 * i + c] - first[row][c]) for c in range(3))
                for i, row in enumerate(rows) if row in first]
        self.assertGreater(len(gaps), 100)
        self.assertLess(max(gaps), 1e-4)

    def test_a_click_on_the_time_line_selects_a_frame(self):
        from selenium.webdriver import ActionChains
        for number, plot in enumerate(BROWSER.find_elements("css selector", "svg.frames")[:3]):
            ask("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", plot)
            x = ask("""
                const plot = arguments[0], d = plot.dataset, box = plot.getBoundingClientRect();
                const part = (arguments[1] - d.low) / (d.high - d.low);
                const at = Number(d.left) + part * (Number(d.right) - Number(d.left));
                return at / plot.viewBox.baseVal.width * box.width - box.width / 2;""", plot, 2 + number)
            ActionChains(BROWSER).move_to_element_with_offset(plot, round(x), 0).click().perform()
            self.assertIn(f"Frame {2 + number}:", ask("return document.getElementById('frameText').value"))

    def test_the_picture_of_the_frame_has_points_drawn_in(self):
        def pixels():
            return BROWSER.execute_async_script("""
                const done = arguments[0];
                setTimeout(() => {
                  const photo = document.getElementById('photo');
                  const data = photo.getContext('2d').getImageData(0, 0, photo.width, photo.height).data;
                  let yellow = 0, sum = 0;
                  for (let i = 0; i < data.length; i += 4) {
                    sum += data[i] + data[i + 1] + data[i + 2];
                    if (data[i] > 200 && data[i + 1] > 160 && data[i + 2] < 120) ++yellow;
                  }
                  done([yellow, sum]);
                }, 400);""")
        with_marks = pixels()
        BROWSER.find_element("id", "marks").click()
        without = pixels()
        self.assertGreater(with_marks[1], 1e5)
        self.assertGreater(with_marks[0], without[0] + 100)

    def test_the_legend_has_the_range_of_the_data(self):
        keys = ask("return Array.from(document.getElementById('field').options, (o) => o.value)")
        self.assertLessEqual({"", "motion", "stability", "last_seen", "first_seen", "colors"}, set(keys))
        for key in ("motion", "stability", "first_seen"):
            low, high, values = ask("""
                ceresEd.chooseField(arguments[0]);
                const value = (id) => Number(document.getElementById(id).value);
                return [value('low'), value('high'),
                        Array.from(ceresEd.surfaces[0].field(arguments[0]).values)];""", key)
            known = sorted(v for v in values if isinstance(v, (int, float)) and v == v)
            self.assertEqual(low, 0)
            self.assertAlmostEqual(high, known[round(0.98 * (len(known) - 1))], delta=2e-3 * high, msg=key)

    def test_two_levels_are_compared_with_batch(self):
        text = ask("return document.querySelector('main').textContent")
        self.assertIn("Two levels against batch", text)
        self.assertIn("ed_slam", BROWSER.find_element("css selector", ".code pre").text)

    def test_every_plot_has_words_and_every_control_a_label(self):
        self.assertEqual(ask("""return Array.from(document.querySelectorAll('svg, canvas'))
            .filter((e) => !e.getAttribute('aria-label')).length"""), 0)
        self.assertEqual(ask("""return Array.from(document.querySelectorAll('input, select'))
            .filter((e) => !e.labels.length && !e.getAttribute('aria-label')).map((e) => e.id)"""), [])

    def test_a_finished_run_has_the_true_errors(self):
        page = WORK / "truth.html"
        run("ed_report", self.result, f"--html={page}")
        open_page(page)
        self.assertEqual(ask("return ceresEd.state.field"), "truth")
        self.assertIn("Errors", ask("return document.querySelector('nav').textContent"))

    def test_runs_are_compared_with_one_camera(self):
        other, page = WORK / "rigid", WORK / "both.html"
        run("ed_slam", self.sequence, f"--output={other}", "--rigid", "--live_every=0", "--quiet")
        run("ed_report", self.result, other, f"--html={page}")
        open_page(page)
        self.assertEqual(ask("return ceresEd.panels.length"), 2)
        flags = [e.text for e in BROWSER.find_elements("css selector", "td:first-child")]
        self.assertIn("--rigid", flags)

    def test_a_phone_scrolls_in_one_direction_only(self):
        browser = open_browser(360, 740, is_phone=True)
        try:
            open_page(self.page, browser)
            browser.execute_script("document.querySelectorAll('details').forEach((d) => d.open = true)")
            self.assertLessEqual(browser.execute_script("return document.documentElement.scrollWidth"), 360)
        finally:
            browser.quit()

    def test_evil_names_do_not_script_the_page(self):
        folder = WORK / "s\"'<b>&amp; \x07</script><script>window.evil=1<" / "x' onerror='window.evil=1"
        folder.parent.mkdir(parents=True)
        folder.symlink_to(self.sequence)
        page = WORK / "evil_slam.html"
        run("ed_slam", folder, f"--output={WORK / 'evil_out'}", f"--html={page}", "--last=2", "--quiet")
        open_page(page)
        self.assertTrue(ask("return ceresEd.ready"))
        self.assertIsNone(ask("return window.evil || null"))
        self.assertEqual(ask("return document.querySelectorAll('main b').length"), 0)


class EvilNames(unittest.TestCase):
    def test_a_name_neither_breaks_nor_scripts_the_page(self):
        folder = WORK / "a\"'<b>&amp; \x1b\x07\t</script><script>window.evil=1<"
        folder.mkdir(parents=True)
        name = "x\" onerror='window.evil=1' <img src=y onerror=window.evil=1> \u2028\u202e$(id).ply"
        source = folder / name
        source.write_bytes((DATA / "plane_bumps/source.ply").read_bytes())
        page, report = fit("evil", source, DATA / "plane_bumps/target.ply")
        open_page(page)
        self.assertTrue(ask("return ceresEd.ready"))
        self.assertIsNone(ask("return window.evil || null"))
        self.assertEqual(ask("return document.querySelectorAll('main b').length"), 0)
        self.assertEqual(ask("return Array.from(document.images, (i) => i.src.slice(0, 5))"), ["data:"])
        self.assertEqual(complaints(BROWSER), [])
        self.assertIn("onerror='window.evil=1'", ask("return document.querySelector('main').textContent"))


def main():
    global APPS, WORK, BROWSER
    APPS = Path(sys.argv.pop(1)).resolve()
    try:
        BROWSER = open_browser()
    except Missing as missing:
        print(f"SKIPPED: {missing}")
        return
    with tempfile.TemporaryDirectory() as work:
        WORK = Path(work)
        page, _ = fit("first", DATA / "plane_bumps/source.ply", DATA / "plane_bumps/target.ply")
        if "built without three.js" in page.read_text():
            print("SKIPPED: pages have no view, because libjs-three was missing when this was built")
            BROWSER.quit()
            return
        try:
            result = unittest.main(exit=False, verbosity=2).result
        finally:
            BROWSER.quit()
    sys.exit(0 if result.wasSuccessful() else 1)


if __name__ == "__main__":
    main()
