"""Graphs and warps, against the formula in numpy."""
import numpy as np
import pytest

import ceres_ed


def turn(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


def warp_in_numpy(warp, points):
    """Eq. 1 and 2 with Euclidean distances."""
    nodes, affine, translation, m = warp.nodes, warp.affine, warp.translation, warp.neighbors
    warped = np.zeros_like(points)
    for i, v in enumerate(points):
        distance = np.linalg.norm(nodes - v, axis=1)
        near = np.argsort(distance, kind="stable")[:m + 1]
        weights = 1 - distance[near[:m]] / distance[near[m]]
        weights /= weights.sum()
        warped[i] = sum(w * (affine[j] @ (v - nodes[j]) + nodes[j] + translation[j])
                        for w, j in zip(weights, near))
    return warped


@pytest.fixture
def built(hill):
    return ceres_ed.Graph.build(hill, node_spacing=0.2, distance="euclidean")


def test_nodes_sit_on_points_and_keep_their_distance(hill, built):
    points, _ = hill
    assert len(built) == len(built.nodes) == len(built.node_points) > 10
    np.testing.assert_array_equal(built.nodes, points[built.node_points])
    between = np.linalg.norm(built.nodes[:, None] - built.nodes, axis=2)
    assert between[~np.eye(len(built), dtype=bool)].min() >= 0.2 * (1 - 1e-9)
    assert np.linalg.norm(points[:, None] - built.nodes, axis=2).min(axis=1).max() <= 0.2 * (1 + 1e-9)


def test_edges_go_both_ways(built):
    pairs = {tuple(edge) for edge in built.edges.tolist()}
    assert pairs == {(b, a) for a, b in pairs}
    assert built.edge_weights.mean() == pytest.approx(1.0)
    assert len(built.edge_weights) == len(built.edges)


def test_the_number_of_nodes_may_be_asked_for(hill):
    assert len(ceres_ed.Graph.build(hill, target_nodes=37, sampling="farthest")) == 37
    options = ceres_ed.GraphOptions(target_nodes=37)
    assert len(ceres_ed.Graph.build(hill, options, sampling="farthest", target_nodes=12)) == 12


def test_a_graph_may_be_made_of_arrays(built):
    copy = ceres_ed.Graph(built.nodes, built.edges, built.edge_weights)
    np.testing.assert_array_equal(copy.nodes, built.nodes)
    np.testing.assert_array_equal(copy.edges, built.edges)
    np.testing.assert_array_equal(copy.edge_weights, built.edge_weights)


def test_a_warp_at_rest_moves_nothing(hill, built):
    warp = ceres_ed.Warp(built)
    np.testing.assert_allclose(warp.apply(hill), hill[0], atol=1e-15)
    np.testing.assert_array_equal(warp.affine, np.tile(np.eye(3), (len(built), 1, 1)))


def test_applies_the_formula(hill, built):
    random = np.random.default_rng(5)
    warp = ceres_ed.Warp(built)
    warp.affine = np.eye(3) + 0.2 * random.standard_normal((len(built), 3, 3))
    warp.translation = 0.3 * random.standard_normal((len(built), 3))
    np.testing.assert_allclose(warp.apply(hill[0]), warp_in_numpy(warp, hill[0]), atol=1e-12)
    similarity = np.eye(4)
    similarity[:3, :3] = 2.5 * turn(0.7)
    similarity[:3, 3] = [1, 2, 3]
    moved = warp_in_numpy(warp, hill[0]) @ similarity[:3, :3].T + [1, 2, 3]
    warp.target_from_source = similarity
    np.testing.assert_allclose(warp.target_from_source, similarity, atol=1e-14)
    np.testing.assert_allclose(warp.apply(hill[0], threads=2), moved, atol=1e-12)


def test_normals_turn_along(grid):
    warp = ceres_ed.Warp(ceres_ed.Graph.build(grid, node_spacing=0.3))
    rotation = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    warp.affine = np.tile(rotation, (len(warp), 1, 1))
    normals = np.tile([0.0, 0, 2], (len(grid[0]), 1))
    _, turned = warp.apply(grid, normals)
    np.testing.assert_allclose(turned, np.tile(rotation @ [0, 0, 1], (len(normals), 1)), atol=1e-12)


def test_apply_leaves_its_input_alone_and_returns_an_array_of_its_own(hill, built):
    warp = ceres_ed.Warp(built)
    warp.translation = warp.translation + [0, 0, 1]
    points = hill[0].copy()
    warped = warp.apply(points)
    np.testing.assert_array_equal(points, hill[0])
    assert warped.flags.writeable and not np.shares_memory(warped, points)
    np.testing.assert_allclose(warped, points + [0, 0, 1], atol=1e-14)


def test_arrays_that_are_copies_cannot_be_written_to(built):
    warp = ceres_ed.Warp(built)
    for array in (warp.translation, warp.affine, warp.nodes, built.edges):
        with pytest.raises(ValueError):
            array[0] = 1


def test_files_bring_back_the_same_bits(plane, tmp_path):
    warp = ceres_ed.fit(*plane).warp
    warp.save(tmp_path / "warp.json")
    again = ceres_ed.Warp.load(tmp_path / "warp.json")
    for name in ("nodes", "affine", "translation", "target_from_source", "finish_points",
                 "finish_displacements"):
        np.testing.assert_array_equal(getattr(again, name), getattr(warp, name))
    np.testing.assert_array_equal(again.apply(plane[0]), warp.apply(plane[0]))


def test_applies_what_ed_apply_applies(data, plane, run_app, tmp_path):
    ceres_ed.fit(*plane).warp.save(tmp_path / "warp.json")
    run_app("ed_apply", tmp_path / "warp.json", data / "plane_bumps/target.ply",
            f"--output={tmp_path / 'app.ply'}")
    other = plane[1]
    warp = ceres_ed.Warp.load(tmp_path / "warp.json")
    ceres_ed.save(tmp_path / "python.ply", warp.apply(other), like=other)
    np.testing.assert_array_equal(ceres_ed.load(tmp_path / "python.ply").points,
                                  ceres_ed.load(tmp_path / "app.ply").points)


@pytest.mark.parametrize("make, message", [
    (lambda g: ceres_ed.Graph(np.eye(3), [[0, 3]]), "joins nodes 0 and 3, expected two of 3"),
    (lambda g: ceres_ed.Graph(np.eye(3), [[1, 1]]), "joins nodes 1 and 1"),
    (lambda g: ceres_ed.Graph(np.eye(3), [[0, 1, 2]]), r"expected \(E, 2\)"),
    (lambda g: ceres_ed.Graph(np.eye(3), [[0, 1]], [-1.0]), "expected >= 0"),
    (lambda g: ceres_ed.Graph(np.eye(3), [[0, 1]], [1.0, 2.0]), "expected one for each of 1"),
    (lambda g: ceres_ed.Graph.build(np.zeros((5, 3))), "5 points are all at one place"),
    (lambda g: ceres_ed.Graph.build(np.eye(3), neighbors=99), "neighbors is 99"),
    (lambda g: ceres_ed.Graph.build(np.eye(3), sampling="odd"), "sampling is 'odd'"),
    (lambda g: ceres_ed.Warp(g, neighbors=0), "neighbors"),
    (lambda g: ceres_ed.Warp(g, distance="far"), "'surface' or 'euclidean'"),
    (lambda g: ceres_ed.Warp(g).apply(np.eye(3), threads=-1), "threads is -1"),
    (lambda g: setattr(ceres_ed.Warp(g), "translation", np.eye(3)), "expected shape"),
    (lambda g: setattr(ceres_ed.Warp(g), "affine", np.eye(3)), "expected shape"),
    (lambda g: setattr(ceres_ed.Warp(g), "target_from_source", np.diag([1.0, 1, -1, 1])),
     "rotation"),
])
def test_what_cannot_be_used_is_a_value_error(built, make, message):
    with pytest.raises(ValueError, match=message):
        make(built)


def test_files_that_are_no_warp_say_why(tmp_path):
    with pytest.raises(FileNotFoundError):
        ceres_ed.Warp.load(tmp_path / "missing.json")
    (tmp_path / "bad.json").write_text("{}")
    with pytest.raises(ValueError, match="bad.json"):
        ceres_ed.Warp.load(tmp_path / "bad.json")
    warp = ceres_ed.Warp(ceres_ed.Graph(np.eye(3)))
    with pytest.raises(OSError):
        warp.save(tmp_path / "nowhere/warp.json")
