"""The stubs say what the module has: every public name, and every parameter of it."""
import ast
import importlib.util
import inspect
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

import ceres_ed
from ceres_ed import _core

STUB = Path(_core.__file__).parent / "_core.pyi"
SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "refresh_stubs.py"
TREE = ast.parse(STUB.read_text())

# Python's own, and what every class has.
SILENT = {"__repr__", "__getstate__", "__setstate__", "__signature__", "__doc__", "__module__", "__new__", "__class__", "__dict__", "__weakref__"}


def nodes_of(body, kind):
    found = {}
    for node in body:
        if isinstance(node, kind):
            found.setdefault(node.name, []).append(node)
    return found


def parameters_of_stub(node):
    """Returns [(name, kind)], with kinds as inspect has them."""
    arguments = node.args
    rows = [(a.arg, "positional") for a in arguments.args if a.arg != "self"]
    rows += [(a.arg, "keyword") for a in arguments.kwonlyargs]
    return rows, arguments.kwarg.arg if arguments.kwarg else None


def parameters_of_module(function):
    """The same, of the first line of a docstring: name(a: A, *, b: B = 1, **kwargs) -> R."""
    if inspect.isfunction(function) and not hasattr(function, "__wrapped__"):
        return [(name, "positional") for name in inspect.signature(function).parameters
                if name != "self"], None
    line = function.__doc__.splitlines()[0]
    text = re.fullmatch(r"\w+\((.*)\) -> .*", line).group(1)
    pieces, depth, quote = [""], 0, False
    for char in text:
        quote ^= char == "'"
        depth += not quote and ((char in "[(<{") - (char in "])>}"))
        if char == "," and depth == 0 and not quote:
            pieces.append("")
        else:
            pieces[-1] += char
    rows, kind, rest = [], "positional", None
    for piece in map(str.strip, pieces):
        name = re.split(r"[:=]", piece)[0].strip()
        if name == "*":
            kind = "keyword"
        elif name.startswith("**"):
            rest = name[2:]
        elif name != "self" and name:
            rows.append((name, kind))
    return rows, rest


def options_of(node):
    """The class whose options are the keywords of a function that takes `**kwargs`."""
    return {"fit": ceres_ed.FitOptions, "build": ceres_ed.GraphOptions,
            "field": ceres_ed.FieldOptions, "write_field": ceres_ed.FieldOptions,
            "Tracker": ceres_ed.TrackerOptions, "SurfaceFitter": ceres_ed.FitOptions,
            "open_sequence": ceres_ed.SequenceOptions}.get(node)


def check_parameters(stub, function, options):
    expected, rest = parameters_of_module(function)
    found, found_rest = parameters_of_stub(stub)
    if options is not None:
        assert rest is not None
        expected += [(name, "keyword") for name in options.names]
        rest = None
    assert found == expected, stub.name
    assert (found_rest is None) == (rest is None), stub.name


def public(names):
    return {name for name in names if not name.startswith("_")}


# What is written in Python has its types there.
IN_PYTHON = {"Cohort", "fit_cohort"}


def test_the_package_exports_all_of_the_module():
    assert public(ceres_ed.__all__) == public(vars(_core)) | IN_PYTHON
    assert all(hasattr(ceres_ed, name) for name in ceres_ed.__all__)


def test_every_function_is_there_with_its_parameters():
    stubs = nodes_of(TREE.body, ast.FunctionDef)
    functions = {name: value for name, value in vars(_core).items()
                 if inspect.isbuiltin(value) and not name.startswith("_")}
    assert set(stubs) == set(functions)
    for name, function in functions.items():
        check_parameters(stubs[name][0], function, options_of(name))


def test_options_are_those_of_the_module():
    spec = importlib.util.spec_from_file_location("refresh_stubs", SCRIPT)
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    text = STUB.read_text()
    assert script.refreshed(text, ceres_ed) == text, "scripts/refresh_stubs.py brings it up to date"


CLASSES = sorted(name for name, value in vars(_core).items() if inspect.isclass(value))


def test_every_class_is_there():
    in_stub = {name for name, (node,) in nodes_of(TREE.body, ast.ClassDef).items()
               if not any(getattr(base, "id", "") == "Protocol" for base in node.bases)}
    assert in_stub == set(CLASSES)


@pytest.mark.parametrize("name", CLASSES)
def test_every_member_is_there_with_its_parameters(name):
    (stub,) = nodes_of(TREE.body, ast.ClassDef)[name]
    methods = nodes_of(stub.body, ast.FunctionDef)
    attributes = {node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)}
    kind = getattr(_core, name)
    members = {key: value for key, value in vars(kind).items() if key not in SILENT}
    if "__init__" in members and "__init__" not in methods:
        # Not to be made in Python.
        with pytest.raises(TypeError, match="No constructor"):
            kind()
        del members["__init__"]
    members = {key: value for key, value in members.items()
               if not key.startswith("_pybind11") and not key.startswith("__pybind11")}
    assert set(members) == set(methods) | attributes
    for key, value in members.items():
        if isinstance(value, property):
            # What can be set is an attribute, what can't is a property.
            assert (key in attributes) == (value.fset is not None), key
        elif key in methods and key != "__len__":
            function = value.__func__ if isinstance(value, staticmethod) else value
            if "Options" in name and key == "__init__":
                found, rest = parameters_of_stub(methods[key][0])
                assert [row for row, _ in found] == list(kind.names) and rest is None
            else:
                check_parameters(methods[key][-1], function,
                                 options_of(name if key == "__init__" else
                                            key if key in ("build", "field", "write_field") else None))


@pytest.mark.parametrize("name", CLASSES)
def test_every_member_has_a_text(name):
    kind = getattr(_core, name)
    assert kind.__doc__


USE = '''
import numpy as np
from numpy.typing import NDArray
import ceres_ed

source = ceres_ed.load("source.ply")
points: NDArray[np.float64] = source.points
result = ceres_ed.fit((points, source.triangles if source.triangles is not None else []),
                      np.zeros((9, 3)), landmarks={3: (0.0, 0.0, 1.0)}, mode="two_level",
                      energies=["floor:height=1", ceres_ed.Energy("floor", height=1.0)],
                      progress=lambda p: print(p.stage, p.fraction), should_stop=lambda: False)
moved: NDArray[np.float64] = result.warp.apply(points)
both: tuple[NDArray[np.float64], NDArray[np.float64]] = result.warp.apply(points, points)
mean: float = ceres_ed.evaluate(result, source).symmetric.mean
tracker = ceres_ed.Tracker(ceres_ed.Camera(500, 500, 320, 240, 640, 480), camera="fixed")
status: str = tracker.track(np.zeros((480, 640), dtype=np.float32)).status
result.warp.translation = result.warp.translation + 1
names: list[str] = [energy.name for energy in ceres_ed.list_energies()]


def still(points: NDArray[np.float64],
          normals: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    return points[:, 2], np.tile([0.0, 0.0, 1.0], (len(points), 1))


result = ceres_ed.fit("a.ply", energies=[ceres_ed.PointEnergy(still, kind="prior"), "floor"],
                      threads="auto", time_limit_s="none")
more = ceres_ed.SurfaceFitter(source, mode="batch").fit("b.ply").verdict.grade
for frame in ceres_ed.open_sequence("folder", step=2):
    status = tracker.track(frame.depth, frame.color, frame.pose).status
figures = ceres_ed.evaluate_sequence("folder", "result")["truth"]
marks = ceres_ed.Landmarks.load("a.mrk.json").to("LPS")
result = ceres_ed.fit("a.ply", source_landmarks=marks, target_landmarks="b.fcsv", mesh_space="RAS")
near: list[float] = [error["after"] for error in result.landmark_errors]
vectors: NDArray[np.float32] = result.warp.field(source, inverse=True, unit="cm").vectors
picture: bytes = result.picture(width=300)
mesh = ceres_ed.Cloud.from_trimesh(result.to_trimesh()).colors
'''
MISUSE = [
    'ceres_ed.fit(points, mode="bach")',
    'ceres_ed.fit(points, nod_spacing=1.0)',
    'ceres_ed.fit(points).points = points',
    'ceres_ed.Camera(1, 2, 3)',
    'ceres_ed.evaluate(points)',
    'ceres_ed.fit(points, threads="all")',
    'ceres_ed.PointEnergy(lambda points: points)',
    'ceres_ed.open_sequence("folder", setp=2)',
    'marks.to("LSP")',
    'result.warp.write_field("a.nrrd", unit="km")',
]


def run_mypy(tmp_path, text):
    mypy = shutil.which("mypy")
    if mypy is None:
        pytest.skip("mypy is not installed")
    (tmp_path / "use.py").write_text(text)
    return subprocess.run(
        [mypy, "--strict", "--no-error-summary", f"--cache-dir={tmp_path / 'cache'}", "use.py"],
        cwd=tmp_path, env={**os.environ, "MYPYPATH": str(STUB.parents[1])}, capture_output=True,
        text=True, timeout=300)


def test_mypy_accepts_use_and_refuses_misuse(tmp_path):
    done = run_mypy(tmp_path, USE)
    assert done.returncode == 0, done.stdout + done.stderr
    wrong = run_mypy(tmp_path, USE + "\n".join(MISUSE) + "\n")
    first = USE.count("\n") + 1
    lines = {int(number) for number in re.findall(r"use\.py:(\d+): error", wrong.stdout)}
    assert lines == set(range(first, first + len(MISUSE))), wrong.stdout
