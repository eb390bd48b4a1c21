"""The examples of the package's README, and the one of README.md, run on the data of the repository."""
import os
import re
import shutil

import pytest

from conftest import ROOT

README = ROOT / "ceres_ed/python/README.md"


def copy_pair(folder):
    for name in ("source", "target", "gt"):
        shutil.copy(ROOT / f"data/plane_bumps/{name}.ply", folder)


def test_first_example_runs(tmp_path, monkeypatch):
    examples = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), flags=re.DOTALL)
    assert len(examples) == 1
    copy_pair(tmp_path)
    monkeypatch.chdir(tmp_path)
    exec(compile(examples[0], "README.md", "exec"), {})
    assert (tmp_path / "fitted.ply").exists()


def test_examples_run(tmp_path, monkeypatch, run_app):
    text = README.read_text()
    examples = re.findall(r"```python\n(.*?)```", text, flags=re.DOTALL)
    assert len(examples) >= 5
    assert text.count("```python") == len(examples)
    if "CERES_ED_GOOD_PLUGIN" not in os.environ:
        pytest.skip("CERES_ED_GOOD_PLUGIN names no plugin")
    copy_pair(tmp_path)
    shutil.copy(os.environ["CERES_ED_GOOD_PLUGIN"], tmp_path / "libanchor.so")
    run_app("ed_simulate", "plane", f"--output={tmp_path / 'sequence'}", "--frames=2")
    monkeypatch.chdir(tmp_path)
    names = {}
    for number, example in enumerate(examples):
        exec(compile(example, f"{README.name}, example {number + 1}", "exec"), names)
