"""`pip install` and `python3 -m build` make a wheel that works in an environment of its own."""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

from conftest import ROOT

PACKAGE = ROOT / "ceres_ed/python"
BUILD = Path(os.environ.get("CERES_ED_BUILD_DIR", ROOT / "build/release")).resolve()
PROGRAMS = ["ed_apply", "ed_check", "ed_cohort", "ed_depth", "ed_eval", "ed_fit", "ed_list_energies",
            "ed_report", "ed_simulate", "ed_slam"]

pytestmark = pytest.mark.skipif(
    not all((BUILD / "apps" / name).exists() for name in PROGRAMS), reason="programs are not built")


def environment():
    """The environment of a user: the build folder is only used to build the wheel."""
    kept = {key: value for key, value in os.environ.items()
            if key not in ("PYTHONPATH", "CERES_ED_MODULES")}
    return {**kept, "CERES_ED_WHEEL_BUILD": str(BUILD), "PIP_DISABLE_PIP_VERSION_CHECK": "1"}


def run(*command, cwd):
    done = subprocess.run([str(word) for word in command], cwd=cwd, env=environment(), text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=500)
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A clean environment in which the package has been installed without an index."""
    for module in ("pip", "venv", "setuptools", "wheel"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not installed")
    folder = tmp_path_factory.mktemp("wheel") / "environment"
    # numpy and setuptools come from the system.
    run(sys.executable, "-m", "venv", "--system-site-packages", folder, cwd=folder.parent)
    before = set(PACKAGE.iterdir())
    run(folder / "bin/python", "-m", "pip", "install", "--no-index", "--no-build-isolation", PACKAGE,
        cwd=folder.parent)
    assert set(PACKAGE.iterdir()) == before, "the build left files among the sources"
    return folder


def test_the_first_example_of_the_page_runs(installed, tmp_path):
    for name in ("source", "target", "gt"):
        shutil.copy(ROOT / f"data/plane_bumps/{name}.ply", tmp_path)
    example = re.search(r"```python\n(.*?)```", (PACKAGE / "README.md").read_text(), re.DOTALL)[1]
    example += "\nprint(ceres_ed.__file__)\n"
    printed = run(installed / "bin/python", "-c", example, cwd=tmp_path)
    assert printed.splitlines()[-1].startswith(str(installed))
    assert (tmp_path / "fitted.ply").exists()


def test_programs_are_on_the_path_of_the_environment(installed, tmp_path):
    for name in PROGRAMS:
        assert run(installed / "bin" / name, "--version", cwd=tmp_path).startswith("ceres_ed")
    pair = ROOT / "data/plane_bumps"
    run(installed / "bin/ed_fit", pair / "source.ply", pair / "target.ply", "--output=own.ply",
        cwd=tmp_path)
    run(BUILD / "apps/ed_fit", pair / "source.ply", pair / "target.ply", "--output=built.ply",
        cwd=tmp_path)
    assert (tmp_path / "own.ply").read_bytes() == (tmp_path / "built.ply").read_bytes()


@pytest.mark.skipif(shutil.which("readelf") is None, reason="readelf is not installed")
def test_nothing_refers_to_the_build_folder(installed, tmp_path):
    (module,) = installed.glob("lib/*/site-packages/ceres_ed/_core.*.so")
    for binary in [module, *(installed / "bin" / name for name in PROGRAMS)]:
        for path in re.findall(r"R(?:UN)?PATH.*\[(.*)\]", run("readelf", "-d", binary, cwd=tmp_path)):
            assert path.startswith("$ORIGIN"), binary


@pytest.mark.skipif(importlib.util.find_spec("build") is None, reason="python3-build is missing")
def test_build_makes_an_archive_and_a_wheel_of_it(tmp_path):
    run(sys.executable, "-m", "build", "--no-isolation", "--outdir", tmp_path, PACKAGE, cwd=tmp_path)
    (wheel,) = tmp_path.glob("*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    scripts = [name.rsplit("/", 1)[1] for name in names if ".data/scripts/" in name]
    assert sorted(scripts) == PROGRAMS
    # The archive has all that CMake reads.
    (archive,) = tmp_path.glob("*.tar.gz")
    with tarfile.open(archive) as contents:
        contents.extractall(tmp_path / "unpacked")
    (sources,) = (tmp_path / "unpacked").glob("*/sources")
    run("cmake", "-S", sources, "-B", tmp_path / "configured", "-DCERES_ED_BUILD_TESTS=OFF",
        f"-DPython3_EXECUTABLE={sys.executable}", cwd=tmp_path)


def test_a_shared_library_is_refused(tmp_path):
    (tmp_path / "CMakeCache.txt").write_text("BUILD_SHARED_LIBS:BOOL=ON\n")
    done = subprocess.run(
        [sys.executable, "setup.py", "build_ext", "--build-temp", tmp_path / "temp"], cwd=PACKAGE,
        env={**environment(), "CERES_ED_WHEEL_BUILD": str(tmp_path)}, capture_output=True, text=True)
    assert done.returncode != 0
    assert "expected BUILD_SHARED_LIBS=OFF" in done.stderr
