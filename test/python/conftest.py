"""What the tests of the Python package share."""
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import ceres_ed

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def data():
    return ROOT / "data"


@pytest.fixture(scope="session")
def run_app(tmp_path_factory):
    """Runs a program of the build; its tests are skipped where programs aren't built."""
    apps = Path(os.environ.get("CERES_ED_BUILD_DIR", ROOT / "build/release")) / "apps"

    def run(name, *arguments):
        if not (apps / name).exists():
            pytest.skip(f"{name} is not built")
        subprocess.run([str(apps / name), *map(str, arguments)], check=True, timeout=300,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return run


@pytest.fixture(scope="session")
def plane():
    """A pair of the repository: a plane, and the same with bumps."""
    folder = ROOT / "data/plane_bumps"
    return ceres_ed.load(folder / "source.ply"), ceres_ed.load(folder / "target.ply")


def make_grid(n=20, height=lambda x, y: 0.0 * x):
    """Returns points (n * n, 3) and triangles of z = height(x, y) over the unit square."""
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
    points = np.stack([x, y, height(x, y)], axis=-1).reshape(-1, 3)
    corner = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + n + 1], axis=1)
    upper = np.stack([corner, corner + n + 1, corner + n], axis=1)
    return points, np.concatenate([lower, upper])


@pytest.fixture
def grid():
    return make_grid()


@pytest.fixture
def hill():
    return make_grid(height=lambda x, y: 0.1 * np.exp(-20 * ((x - 0.5)**2 + (y - 0.4)**2)))
