"""What check_code.py finds wrong, and what it lets pass."""

import os
import tempfile
import unittest

from check_code import Checker, update
from pages import read_blocks
from shell import missing_line

CODE = "#include <x>\nint main() {\n  return Two(1);\n}\n"


class CheckCode(unittest.TestCase):
    """Pages in a folder of their own."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.source = os.path.join(self._folder.name, "source")
        for name in ("data", "apps"):
            os.makedirs(os.path.join(self.source, name))
        self.write("apps/a.cc", CODE)
        self.write("apps/b.cc", CODE)

    def write(self, path, text):
        """Writes a file of the sources."""
        with open(os.path.join(self.source, path), "w", encoding="utf-8") as file:
            file.write(text)

    def check(self, page):
        """Returns the checker of a page."""
        self.write("README.md", page)
        checker = Checker(self.source, os.path.join(self._folder.name, "work"), [], {},
                          '"file": "/somewhere/apps/a.cc"', ["suite.case"])
        checker.check("README.md")
        return checker

    def expect(self, page, *problems):
        """The page has exactly these problems, in this order."""
        errors = self.check(page).errors
        self.assertEqual(len(errors), len(problems), errors)
        for error, problem in zip(errors, problems):
            self.assertIn(problem, error)

    def test_takes_parts_and_wholes_of_files_that_are_compiled(self):
        self.expect("<!-- file: apps/a.cc -->\n```cpp\n  return Two(1);\n}\n```\n")
        self.expect(f"<!-- file: apps/a.cc -->\n```cpp\n{CODE}```\n")

    def test_refuses_what_is_not_in_the_file(self):
        self.expect("<!-- file: apps/a.cc -->\n```cpp\n  return Two(2);\n```\n", "line for line")
        self.expect("<!-- file: apps/a.cc -->\n```cpp\nTwo(1);\n```\n", "line for line")
        self.expect("<!-- file: apps/c.cc -->\n```cpp\n}\n```\n", "isn't there")

    def test_refuses_a_part_of_a_program_with_a_main(self):
        self.expect("<!-- file: apps/a.cc -->\n```cpp\nint main() {\n```\n", "differs")

    def test_refuses_files_that_are_not_compiled(self):
        self.expect(f"<!-- file: apps/b.cc -->\n```cpp\n{CODE}```\n", "not compiled")

    def test_refuses_blocks_that_nothing_covers(self):
        for language in ("cpp", "cmake", "python", "console"):
            self.expect(f"text\n\n```{language}\nx\n```\n", "nothing covers it")
        # A comment is for the next block alone.
        self.expect("<!-- file: apps/a.cc -->\ntext\n```cpp\n}\n```\n", "nothing covers it")

    def test_refuses_code_that_is_set_in_or_without_a_language(self):
        self.expect("text\n\n    ed_fit a.ply b.ply\n", "give it a fence")
        self.expect("text\n\n    # why\n    cd data\n", "give it a fence")
        self.expect("text\n\n```\nint x = 3;\n```\n", "give it a fence")
        self.expect("text\n\n    E = sum w |r|^2\n\n- item\n\n    its second paragraph\n")

    def test_runs_shell_blocks_in_one_folder_each_from_its_root(self):
        self.expect("```sh\ncd data\necho 1 >x\n```\n\n```sh\ntest -f data/x\n```\n")
        self.expect("```sh\nfalse\ntrue\n```\n", "exit code 1")
        self.expect("```sh\nfalse | true\n```\n", "exit code 1")
        self.expect("```sh\nno_such_program\n```\n", "exit code 127")

    def test_compares_what_is_printed_but_for_numbers(self):
        block = "```sh\necho 'took  1.5e-3 s'; echo b\n```\n\n<!-- prints -->\n```text\n%s\n```\n"
        self.expect(block % "took 23 s\n...\nb")
        self.expect(block % "took 23 ms", "not printed: took 23 ms")
        self.expect(block % "", "says of nothing")
        self.expect(block % "b\ntook 1 s", "not printed: took 1 s")

    def test_takes_other_tests_that_there_are(self):
        self.expect("<!-- tested by: suite.case -->\n```python\nx\n```\n")
        self.expect("<!-- tested by: suite -->\n```python\nx\n```\n", "no test 'suite'")

    def test_asks_for_no_test_that_the_build_leaves_out(self):
        self.write("README.md", "<!-- tested by: python.readme -->\n```python\nx\n```\n")
        work = os.path.join(self._folder.name, "work")
        for left_out, num_errors in ((["python."], 0), (["install."], 1), ([], 1)):
            checker = Checker(self.source, work, [], {}, "", ["suite.case"], left_out)
            checker.check("README.md")
            self.assertEqual(len(checker.errors), num_errors, checker.errors)

    def test_tells_what_is_not_run_and_why(self):
        checker = self.check("<!-- not run: needs root -->\n```sh\nfalse\n```\n")
        self.assertEqual(checker.errors, [])
        self.assertEqual(checker.not_run, {"README.md:3": "needs root"})
        self.expect("<!-- not run -->\n```sh\nfalse\n```\n", "no reason")

    def test_brings_whole_files_up_to_date_and_leaves_parts_alone(self):
        old = CODE.replace("Two", "One")
        part = "<!-- file: apps/a.cc -->\n```cpp\n  return One(1);\n```\n"
        self.write("README.md", f"<!-- file: apps/a.cc -->\n```cpp\n{old}```\nand\n\n{part}")
        update(self.source, "README.md")
        with open(os.path.join(self.source, "README.md"), encoding="utf-8") as file:
            text = file.read()
        self.assertEqual(text, f"<!-- file: apps/a.cc -->\n```cpp\n{CODE}```\nand\n\n{part}")

    def test_numbers_lines(self):
        blocks = read_blocks("a\n\n```sh\nx\n```\n\n    y\n", "p")
        self.assertEqual([block.line for block in blocks], [4, 7])
        self.assertIsNone(missing_line("", ""))


if __name__ == "__main__":
    unittest.main()
