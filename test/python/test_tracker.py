"""Tracker: the same as ed_slam, frame by frame, on images as they are."""
import csv
import threading
import time

import numpy as np
import pytest

import ceres_ed

WIDTH, HEIGHT, F = 160, 120, 150.0


@pytest.fixture(scope="module")
def camera():
    return ceres_ed.Camera(F, F, 79.5, 59.5, WIDTH, HEIGHT)


def wall(x, y, bump=0.0):
    """Returns z of the scene: a wavy wall with a bump."""
    return (0.2 + 0.006 * np.sin(60 * x) * np.cos(50 * y) + 0.004 * np.sin(37 * x + 21 * y) +
            bump * np.exp(-((x / 0.03)**2 + (y / 0.03)**2)))


def render(shift=0.0, bump=0.0):
    """Returns the depth (float32 metres) of the wall, seen by a camera `shift` metres to the right.

    Depth at a pixel is found by fixed-point iteration.
    """
    u, v = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    ray_x, ray_y = (u - 79.5) / F, (v - 59.5) / F
    z = np.full((HEIGHT, WIDTH), 0.2)
    for _ in range(60):
        z = wall(ray_x * z + shift, ray_y * z, bump)
    return z.astype(np.float32)


def test_covariance_of_the_camera_on_request(camera):
    tracker = ceres_ed.Tracker(camera, covariance=True)
    assert tracker.track(render()).camera_covariance is None  # The first camera is the map frame.
    covariance = tracker.track(render(0.0005)).camera_covariance
    assert covariance.shape == (6, 6)
    assert (np.linalg.eigvalsh(covariance) > 0).all()
    assert 1e-8 < np.sqrt(covariance[0, 0]) < 2e-3


def test_a_still_scene_stays_where_it_is(camera):
    tracker = ceres_ed.Tracker(camera)
    assert tracker.camera_pose is None and len(tracker) == 0
    assert tracker.track(render()).status == "initialized"
    for number in range(1, 4):
        report = tracker.track(render())
        assert (report.number, report.status) == (number, "tracked")
    np.testing.assert_allclose(tracker.camera_pose, np.eye(4), atol=1e-4)
    assert np.abs(tracker.warp.translation).max() < 1e-4
    assert report.rms_plane < 1e-4 and report.map_points == len(tracker)
    points = tracker.points()
    assert points.shape == (len(tracker), 3)
    # Each point lies on the wall.
    x, y, z = points.T
    assert np.median(np.abs(z - wall(x, y))) < 1e-4


def test_a_moving_camera_is_followed(camera):
    tracker = ceres_ed.Tracker(camera)
    for shift in (0.0, 0.001, 0.002, 0.003):
        report = tracker.track(render(shift))
    assert report.status == "tracked"
    np.testing.assert_allclose(tracker.camera_pose[:3, 3], [0.003, 0, 0], atol=3e-4)
    in_map, in_camera = tracker.points(), tracker.points("camera")
    pose = tracker.camera_pose
    np.testing.assert_allclose(in_camera @ pose[:3, :3].T + pose[:3, 3], in_map, atol=1e-12)


def test_tissue_that_rises_is_followed(camera):
    tracker = ceres_ed.Tracker(camera, camera="fixed")
    noise = np.random.default_rng(1)
    # Points are running averages, which lag behind and catch up where the wall holds still.
    for bump in [0.0, -0.001, -0.002] + 7 * [-0.003]:
        depth = render(bump=bump) + 3e-4 * noise.standard_normal((HEIGHT, WIDTH))
        tracker.track(depth.astype(np.float32))
    x, y, z = tracker.points()[np.linalg.norm(tracker.points()[:, :2], axis=1) < 0.01].T
    assert len(z) > 20
    # Nine tenths of the way.
    assert np.median(np.abs(z - wall(x, y, bump))) < 0.1 * abs(bump)
    # The camera stays, so it is the nodes that have moved: toward the camera.
    np.testing.assert_array_equal(tracker.camera_pose, np.eye(4))
    assert tracker.warp.translation[:, 2].min() < -0.001


@pytest.mark.parametrize("change", [
    lambda depth: (depth.astype(np.float64), {}),
    lambda depth: (np.asfortranarray(depth), {}),
    lambda depth: (np.repeat(depth, 2, axis=1)[:, ::2], {}),
    lambda depth: (1000 * depth.astype(np.float64), {"units_per_metre": 1000.0}),
], ids=["float64", "fortran", "strided", "millimetres"])
def test_other_depth_is_converted(camera, change):
    expected, tracker = ceres_ed.Tracker(camera), ceres_ed.Tracker(camera)
    for shift in (0.0, 0.001):
        expected.track(render(shift))
        depth, arguments = change(render(shift))
        tracker.track(depth, **arguments)
    np.testing.assert_array_equal(tracker.points(), expected.points())


def test_depth_may_be_read_only_and_have_holes(camera):
    depth = render()
    depth[10:20, 30:50] = np.nan
    depth[50:60, 30:50] = 0
    before = depth.copy()
    depth.flags.writeable = False
    tracker = ceres_ed.Tracker(camera)
    assert tracker.track(depth).status == "initialized"
    np.testing.assert_array_equal(depth, before)
    assert np.isfinite(tracker.points()).all()
    assert ceres_ed.Tracker(camera).track(np.zeros_like(depth)).status == "skipped"


def test_follows_what_ed_slam_follows(run_app, tmp_path):
    images = pytest.importorskip("PIL.Image")
    run_app("ed_simulate", "kidney", f"--output={tmp_path / 'in'}", "--frames=4")
    run_app("ed_slam", tmp_path / "in", f"--output={tmp_path / 'out'}", "--quiet", "--live_every=0")
    fx, fy, cx, cy, width, height, units = np.loadtxt(tmp_path / "in/camera.txt")
    tracker = ceres_ed.Tracker(ceres_ed.Camera(fx, fy, cx, cy, int(width), int(height)))
    with open(tmp_path / "out/frames.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 4
    for row in rows:
        name = f"{int(row['frame']):06d}.png"
        depth = np.array(images.open(tmp_path / "in/depth" / name)).astype(np.uint16)
        color = np.array(images.open(tmp_path / "in/color" / name).convert("RGB"))
        report = tracker.track(depth, color, units_per_metre=units)
        assert (report.status, report.nodes, report.inliers, report.features) == (
            row["status"], int(row["nodes"]), int(row["inliers"]), report.features)
        assert report.energy == pytest.approx(float(row["energy"]), rel=1e-5)
    x, y, z = np.loadtxt(tmp_path / "out/trajectory.txt")[-1, 1:4]
    np.testing.assert_allclose(tracker.camera_pose[:3, 3], [x, y, z], rtol=0, atol=1e-9)
    saved = ceres_ed.load(tmp_path / "out/map.ply").points
    snapshot = tracker.snapshot()
    np.testing.assert_allclose(snapshot.points, saved, atol=1e-6)
    assert len(snapshot.ids) == len(set(snapshot.ids)) == len(tracker)
    assert snapshot.colors.dtype == np.uint8 and snapshot.colors.shape == saved.shape
    assert snapshot.birth_frames.max() == 3


def test_snapshots_are_views_of_their_own_memory(camera):
    tracker = ceres_ed.Tracker(camera)
    tracker.track(render())
    snapshot = tracker.snapshot()
    points = snapshot.points
    assert np.shares_memory(points, snapshot.points)
    before = points.copy()
    tracker.track(render(0.002))
    np.testing.assert_array_equal(points, before)
    for name in ("normals", "colors", "ids", "birth_frames", "weights"):
        assert len(getattr(snapshot, name)) == len(snapshot)


def test_given_poses_are_taken(camera):
    tracker = ceres_ed.Tracker(camera, camera="given")
    for shift in (0.0, 0.002):
        pose = np.eye(4)
        pose[0, 3] = shift
        tracker.track(render(shift), pose=pose)
    np.testing.assert_allclose(tracker.camera_pose, pose, atol=1e-12)
    with pytest.raises(ValueError, match="pose is None"):
        tracker.track(render())


def test_other_threads_run_during_a_frame(camera):
    beats, done = [], threading.Event()

    def beat():
        while not done.is_set():
            beats.append(time.perf_counter())
            time.sleep(0.0005)
    tracker = ceres_ed.Tracker(camera)
    depth = render()
    thread = threading.Thread(target=beat)
    thread.start()
    try:
        time.sleep(0.01)
        start = time.perf_counter()
        for _ in range(10):
            tracker.track(depth)
        end = time.perf_counter()
    finally:
        done.set()
        thread.join()
    assert sum(start < t < end for t in beats) > 0.1 * (end - start) / 0.0005


def test_two_threads_at_once_are_an_error(camera):
    tracker = ceres_ed.Tracker(camera)
    tracker.track(render())
    frames = [render(0.0005 * (k % 3)) for k in range(6)]
    thread = threading.Thread(target=lambda: [tracker.track(frame) for frame in frames])
    refused = 0
    thread.start()
    while thread.is_alive():
        try:
            tracker.camera_pose
        except RuntimeError as error:
            assert "another thread" in str(error)
            refused += 1
    assert refused > 0
    assert tracker.track(render()).number == 7


@pytest.mark.parametrize("arguments, message", [
    ({"depth": np.zeros((HEIGHT, WIDTH + 1), np.float32)}, r"\(120, 161\), expected the camera's"),
    ({"depth": np.zeros((HEIGHT, WIDTH, 1), np.float32)}, r"expected \(height, width\)"),
    ({"depth": np.zeros((HEIGHT, WIDTH), np.uint16)}, "units_per_metre"),
    ({"depth": np.zeros((HEIGHT, WIDTH), bool)}, "bool, expected floats or integers"),
    ({"units_per_metre": 0.0}, "expected > 0"),
    ({"color": np.zeros((HEIGHT, WIDTH, 3), np.float32)}, "uint8"),
    ({"color": np.zeros((HEIGHT, WIDTH), np.uint8)}, "uint8"),
    ({"color": np.zeros((HEIGHT, WIDTH + 1, 3), np.uint8)}, "expected the camera's"),
    ({"pose": np.eye(3)}, r"expected \(4, 4\)"),
    ({"pose": 2 * np.eye(4)}, "rotation"),
])
def test_frames_that_cannot_be_used_are_value_errors(camera, arguments, message):
    with pytest.raises(ValueError, match=message):
        ceres_ed.Tracker(camera).track(**{"depth": render(), **arguments})


def test_options_that_cannot_be_used_are_errors(camera):
    with pytest.raises(ValueError, match="fx"):
        ceres_ed.Camera(-1, F, 80, 60, WIDTH, HEIGHT)
    with pytest.raises(ValueError, match="rounds"):
        ceres_ed.Tracker(camera, rounds=0)
    with pytest.raises(TypeError, match="knows no 'round'"):
        ceres_ed.Tracker(camera, round=1)
    with pytest.raises(ValueError, match="frame is 'world'"):
        ceres_ed.Tracker(camera).points("world")
    with pytest.raises(ValueError, match="unknown"):
        ceres_ed.Tracker(camera, energies="unknown")
