"""Ctrl-C ends fits and tracking within two seconds, with a KeyboardInterrupt."""
import os
import signal
import subprocess
import sys
import time

import pytest

# The longest time that may pass; a busy machine gets no more.
SECONDS = 2.0

SETUP = """
import numpy as np, sys, ceres_ed
n = 300
x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
def surface(a):
    points = np.stack([x, y, a * np.sin(9 * x) * np.cos(7 * y)], axis=-1).reshape(-1, 3)
    c = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    return points, np.concatenate([np.stack([c, c + 1, c + n + 1], 1), np.stack([c, c + n + 1, c + n], 1)])
"""
FIT = SETUP + """
source, target = ceres_ed.Cloud(*surface(0.0)), ceres_ed.Cloud(*surface(0.1))
print("ready", flush=True)
while True:
    ceres_ed.fit(source, target, node_spacing=0.02)
"""
FITTER = SETUP + """
fitter, target = ceres_ed.SurfaceFitter(surface(0.0), node_spacing=0.02), ceres_ed.Cloud(*surface(0.1))
print("ready", flush=True)
while True:
    fitter.fit(target)
"""
FUNCTION = SETUP + """
source, target = ceres_ed.Cloud(*surface(0.0)), ceres_ed.Cloud(*surface(0.1))
def still(points, normals):
    return 0.1 * points[:, 2], np.tile([0, 0, 0.1], (len(points), 1))
print("ready", flush=True)
while True:
    ceres_ed.fit(source, target, energies=ceres_ed.PointEnergy(still))
"""
TRACK = SETUP + """
tracker = ceres_ed.Tracker(ceres_ed.Camera(300, 300, 159.5, 119.5, 320, 240))
v, u = np.mgrid[:240, :320]
print("ready", flush=True)
frame = 0
while True:
    tracker.track((0.1 + 0.01 * np.sin(u / 40 + 0.02 * frame) * np.cos(v / 30)).astype(np.float32))
    frame += 1
"""


@pytest.mark.parametrize("program", [FIT, FITTER, FUNCTION, TRACK],
                         ids=["fit", "fitter", "function", "track"])
@pytest.mark.parametrize("delay", [0.3, 1.5])
def test_ctrl_c_ends_the_work(program, delay):
    with subprocess.Popen([sys.executable, "-c", program], env=os.environ, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE) as child:
        assert child.stdout.readline() == "ready\n"
        time.sleep(delay)
        start = time.monotonic()
        child.send_signal(signal.SIGINT)
        _, errors = child.communicate(timeout=60)
        seconds = time.monotonic() - start
    assert "KeyboardInterrupt" in errors
    assert seconds < SECONDS
