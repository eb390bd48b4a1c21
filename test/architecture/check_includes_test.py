"""Shows that check_includes.py finds what it is for."""
import tempfile
import unittest
from pathlib import Path

import check_includes

PAGE = """
| layer | what it has | may include |
|---|---|---|
| `util` | tools | - |
| `graph` | nodes | `util` |
| `solver` | solves | `graph` |
| `slam` | tracks | `solver` |
"""


class CheckIncludes(unittest.TestCase):
    def check(self, page=PAGE, **files):
        with tempfile.TemporaryDirectory() as root:
            for name, text in files.items():
                path = Path(root) / "ceres_ed" / (name.replace("__", "/") + ".h")
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            (Path(root) / "ceres_ed").mkdir(exist_ok=True)
            (Path(root) / "ceres_ed/README.md").write_text(page)
            return check_includes.check(root)

    def test_arrows_that_run_down_are_fine(self):
        self.assertEqual([], self.check(
            solver__a="#include <ceres_ed/util/b.h>\n#include <ceres_ed/graph/c.h>\n",
            util__b="", graph__c="#include <ceres_ed/util/b.h>\n"))

    def test_an_arrow_that_runs_up_is_named(self):
        self.assertEqual(
            ["ceres_ed/graph/c.h includes ceres_ed/solver/a.h: graph may not include solver"],
            self.check(graph__c="#include <ceres_ed/solver/a.h>\n", solver__a=""))

    def test_a_circle_of_headers_is_named(self):
        errors = self.check(graph__a="#include <ceres_ed/graph/b.h>\n",
                            graph__b="#include <ceres_ed/graph/a.h>\n")
        self.assertEqual(1, len(errors))
        self.assertIn("ceres_ed/graph/a.h -> ceres_ed/graph/b.h -> ceres_ed/graph/a.h", errors[0])

    def test_a_circle_of_layers_is_named(self):
        errors = self.check(page=PAGE.replace("| tools | - |", "| tools | `slam` |"))
        self.assertIn("are a circle", errors[0])

    def test_a_layer_without_a_row_is_named(self):
        self.assertIn("has no row", self.check(attic__a="")[0])

    def test_a_stage_does_not_include_what_runs_it(self):
        errors = self.check(slam__frame__a="#include <ceres_ed/slam/slam.h>\n", slam__slam="")
        self.assertIn("a stage must not know what runs it", errors[0])


if __name__ == "__main__":
    unittest.main()
