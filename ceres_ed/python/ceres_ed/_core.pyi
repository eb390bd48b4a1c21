"""Types of ceres_ed. Lengths are in the unit of the input, of Camera and Tracker in metres."""
from os import PathLike
from typing import (
    Any, Callable, ClassVar, Literal, Mapping, Optional, Protocol, Sequence, Union, overload)

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

Boundary = Literal["keep", "cut"]
CameraMode = Literal["estimate", "fixed", "given"]
Distance = Literal["surface", "euclidean"]
EdgeRule = Literal["shared_influence", "nearest"]
LevelTwo = Literal["lazy", "full"]
LinearSolver = Literal["block", "ceres"]
Loss = Literal["squared", "huber", "cauchy", "tukey", "welsch", "geman_mcclure"]
Mode = Literal["batch", "two_level", "marginal"]
Sampling = Literal["uniform", "farthest"]
SequenceFormat = Literal[
    "auto", "tum", "native", "hamlyn", "native_stereo", "scikit_surgery", "stereo_video",
    "stereomis", "scared", "endonerf", "deform3dgs", "d4d", "servct", "surgt", "stir",
    "hamlyn_stereo", "c3vd", "deepdeform", "super", "sevenscenes"]

Path = Union[str, PathLike[str]]
Threads = Union[int, Literal["auto"]]
Plugins = Union[Path, Sequence[Path]]
PointFunction = Union[
    Callable[[NDArray[np.float64], NDArray[np.float64]], tuple[ArrayLike, ArrayLike]],
    Callable[[NDArray[np.float64], NDArray[np.float64], NDArray[np.int32]],
             tuple[ArrayLike, ArrayLike]]]
AnyEnergy = Union[str, Energy, PointEnergy]
Energies = Union[AnyEnergy, Sequence[AnyEnergy]]
PointPositions = Union[Mapping[int, ArrayLike], tuple[ArrayLike, ArrayLike]]
AnyLandmarks = Union[Landmarks, dict[str, Any], Path]
MeshSpace = Literal["auto", "LPS", "RAS"]
Space = Literal["LPS", "RAS"]


class HasVertices(Protocol):
    """Meshes of trimesh (`faces`) and Open3D (`triangles`)."""
    @property
    def vertices(self) -> Any: ...


class HasPoints(Protocol):
    """Clouds of Open3D."""
    @property
    def points(self) -> Any: ...


Surface = Union[
    ArrayLike, tuple[ArrayLike, ArrayLike], Cloud, FitResult, HasVertices, HasPoints, Path]


class Cloud:
    def __init__(
            self, points: Surface, triangles: Optional[ArrayLike] = None,
            normals: Optional[ArrayLike] = None, colors: Optional[ArrayLike] = None) -> None: ...
    @staticmethod
    def from_trimesh(mesh: Any) -> Cloud: ...
    @staticmethod
    def from_open3d(mesh: Any) -> Cloud: ...
    def to_trimesh(self) -> Any: ...
    def to_open3d(self) -> Any: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def triangles(self) -> Optional[NDArray[np.int32]]: ...
    @property
    def normals(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def colors(self) -> Optional[NDArray[np.uint8]]: ...
    @property
    def warnings(self) -> list[str]: ...
    def __len__(self) -> int: ...


class Energy:
    def __init__(
            self, name: str, weight: float = ..., loss: Loss = ..., loss_width: float = ...,
            **parameters: float) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def weight(self) -> float: ...
    @property
    def loss(self) -> str: ...
    @property
    def loss_width(self) -> float: ...
    @property
    def parameters(self) -> dict[str, float]: ...


class PointEnergy:
    def __init__(
            self, function: PointFunction, weight: float = ..., *,
            kind: Literal["prior", "observation"] = ..., loss: Loss = ..., loss_width: float = ...,
            name: Optional[str] = None) -> None: ...
    @property
    def function(self) -> Callable[..., Any]: ...
    @property
    def name(self) -> str: ...
    @property
    def weight(self) -> float: ...
    @property
    def kind(self) -> str: ...
    @property
    def loss(self) -> str: ...
    @property
    def loss_width(self) -> float: ...


class EnergyParameter:
    @property
    def name(self) -> str: ...
    @property
    def type(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def minimum(self) -> float: ...
    @property
    def maximum(self) -> float: ...
    @property
    def default(self) -> float: ...
    @property
    def doc(self) -> str: ...


class EnergyInfo:
    @property
    def name(self) -> str: ...
    @property
    def summary(self) -> str: ...
    @property
    def equation(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def is_observation(self) -> bool: ...
    @property
    def parameters(self) -> list[EnergyParameter]: ...


class GraphOptions:
    words: ClassVar[dict[str, str]]
    names: ClassVar[tuple[str, ...]]
    sampling: Sampling
    distance: Distance
    node_spacing: float
    target_nodes: int
    auto_spacing: float
    neighbors: int
    edges: EdgeRule
    edges_per_node: int
    min_component_points: int
    join_pieces: bool
    edges_per_joint: int
    threads: int
    def __init__(
            self, *, sampling: Sampling = ..., distance: Distance = ...,
            node_spacing: Union[float, Literal["automatic"]] = ...,
            target_nodes: Union[int, Literal["automatic"]] = ..., auto_spacing: float = ...,
            neighbors: int = ..., edges: EdgeRule = ..., edges_per_node: int = ...,
            min_component_points: int = ..., join_pieces: bool = ..., edges_per_joint: int = ...,
            threads: Threads = ...) -> None: ...
    def __copy__(self) -> GraphOptions: ...
    def copy(self) -> GraphOptions: ...


class Graph:
    def __init__(
            self, nodes: ArrayLike, edges: Optional[ArrayLike] = None,
            edge_weights: Optional[ArrayLike] = None) -> None: ...
    @staticmethod
    def build(
            surface: Surface, options: Optional[GraphOptions] = None, *, sampling: Sampling = ...,
            distance: Distance = ..., node_spacing: Union[float, Literal["automatic"]] = ...,
            target_nodes: Union[int, Literal["automatic"]] = ..., auto_spacing: float = ...,
            neighbors: int = ..., edges: EdgeRule = ..., edges_per_node: int = ...,
            min_component_points: int = ..., join_pieces: bool = ..., edges_per_joint: int = ...,
            threads: Threads = ...) -> Graph: ...
    @property
    def nodes(self) -> NDArray[np.float64]: ...
    @property
    def edges(self) -> NDArray[np.int32]: ...
    @property
    def edge_weights(self) -> NDArray[np.float64]: ...
    @property
    def node_points(self) -> list[int]: ...
    @property
    def node_spacing(self) -> float: ...
    @property
    def warnings(self) -> list[str]: ...
    def __len__(self) -> int: ...


class Landmarks:
    def __init__(self, points: dict[str, Any], space: Optional[Space] = None) -> None: ...
    @staticmethod
    def load(path: Path, side: Literal["source", "target"] = "source") -> Landmarks: ...
    def save(self, path: Path) -> None: ...
    def at(self, positions: ArrayLike) -> Landmarks: ...
    def to(self, space: Space) -> Landmarks: ...
    def keys(self) -> list[str]: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def positions(self) -> NDArray[np.float64]: ...
    @property
    def space(self) -> Optional[Space]: ...
    @property
    def warnings(self) -> list[str]: ...
    def __getitem__(self, name: str) -> NDArray[np.float64]: ...
    def __len__(self) -> int: ...


class Warp:
    affine: NDArray[np.float64]
    translation: NDArray[np.float64]
    target_from_source: NDArray[np.float64]
    def __init__(
            self, graph: Graph, *, neighbors: Optional[int] = None,
            distance: Optional[Distance] = None) -> None: ...
    @staticmethod
    def load(path: Path) -> Warp: ...
    def save(self, path: Path) -> None: ...
    @overload
    def apply(
            self, points: Surface, normals: None = None, *,
            threads: Threads = 1) -> NDArray[np.float64]: ...
    @overload
    def apply(
            self, points: Surface, normals: ArrayLike, *,
            threads: Threads = 1) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def field(
            self, around: Optional[Surface] = None, options: Optional[FieldOptions] = None, *,
            inverse: bool = ..., spacing: Union[float, Literal["auto"]] = ...,
            frame: Literal["lps", "ras"] = ..., unit: Literal["mm", "cm", "m"] = ...,
            margin: float = ..., bounds: str = ..., like: str = ...,
            no_inverse: Literal["nan", "zero", "nearest"] = ..., max_mb: float = ...,
            threads: Threads = ...) -> Field: ...
    def write_field(
            self, path: Path, around: Optional[Surface] = None,
            options: Optional[FieldOptions] = None, *, inverse: bool = ...,
            spacing: Union[float, Literal["auto"]] = ..., frame: Literal["lps", "ras"] = ...,
            unit: Literal["mm", "cm", "m"] = ..., margin: float = ..., bounds: str = ...,
            like: str = ..., no_inverse: Literal["nan", "zero", "nearest"] = ...,
            max_mb: float = ..., threads: Threads = ...) -> Field: ...
    def write_rigid(
            self, path: Path, *, frame: Literal["lps", "ras"] = "lps",
            unit: Literal["mm", "cm", "m"] = "mm") -> None: ...
    @property
    def graph(self) -> Graph: ...
    @property
    def nodes(self) -> NDArray[np.float64]: ...
    @property
    def neighbors(self) -> int: ...
    @property
    def distance(self) -> str: ...
    @property
    def finish_points(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def finish_displacements(self) -> Optional[NDArray[np.float64]]: ...
    def __len__(self) -> int: ...


class FieldOptions:
    words: ClassVar[dict[str, str]]
    names: ClassVar[tuple[str, ...]]
    inverse: bool
    spacing: float
    frame: Literal["lps", "ras"]
    unit: Literal["mm", "cm", "m"]
    margin: float
    bounds: str
    like: str
    no_inverse: Literal["nan", "zero", "nearest"]
    max_mb: float
    threads: int
    def __init__(
            self, inverse: bool = ..., spacing: Union[float, Literal["auto"]] = ...,
            frame: Literal["lps", "ras"] = ..., unit: Literal["mm", "cm", "m"] = ...,
            margin: float = ..., bounds: str = ..., like: str = ...,
            no_inverse: Literal["nan", "zero", "nearest"] = ..., max_mb: float = ...,
            threads: Threads = ...) -> None: ...
    def copy(self) -> FieldOptions: ...
    def __copy__(self) -> FieldOptions: ...


class Field:
    @property
    def vectors(self) -> NDArray[np.float32]: ...
    @property
    def origin(self) -> NDArray[np.float64]: ...
    @property
    def spacing(self) -> NDArray[np.float64]: ...
    @property
    def direction(self) -> NDArray[np.float64]: ...
    @property
    def inverse(self) -> Optional[dict[str, Any]]: ...
    @property
    def error(self) -> dict[str, Any]: ...
    @property
    def description(self) -> str: ...
    def apply(self, points: ArrayLike) -> NDArray[np.float64]: ...


class FitOptions:
    words: ClassVar[dict[str, str]]
    names: ClassVar[tuple[str, ...]]
    mode: Mode
    rings: int
    active: Literal["rings", "information"]
    active_bound: float
    boundary: Boundary
    linear_solver: Literal["ceres", "block", "pcg", "auto", "ceres_cgnr"]
    preconditioner: Literal["two_level", "block_jacobi", "incomplete_cholesky"]
    relinearize_above: float
    marginal_reach: int
    graph_sampling: Sampling
    graph_distance: Distance
    node_spacing: float
    target_nodes: int
    graph_auto_spacing: float
    neighbors: int
    graph_edges: EdgeRule
    graph_edges_per_node: int
    graph_min_component_points: int
    graph_join_pieces: bool
    graph_edges_per_joint: int
    volume: Literal["auto", "on", "off"]
    w_rot: float
    w_reg: float
    w_volume: float
    w_data: float
    w_landmark: float
    w_fixed: float
    point_to_point_share: float
    levels: int
    initial_stiffness: float
    final_stiffness: float
    noise_stiffness: float
    coarse_steps: int
    fine_steps: int
    max_rounds: int
    tolerance: float
    solver_iterations: int
    loss: Loss
    loss_width: float
    careful_loss_width: float
    careful_angle_deg: float
    hypotheses: str
    max_distance: float
    max_angle_deg: float
    match_max_deviations: float
    match_reject_borders: bool
    match_symmetric_normals: bool
    max_samples: int
    denoise: bool
    rigid_first: bool
    rigid_scale: bool
    rigid_initial_scale: float
    rigid_max_angle_deg: float
    rigid_score_width: float
    rigid_good_score: float
    rigid_preference: float
    finish: bool
    finish_rounds: int
    finish_steps: int
    finish_smoothing: float
    finish_max_smoothing: float
    finish_fade: float
    finish_point_to_point_share: float
    finish_loss_width: float
    unfold: bool
    covariance: bool
    threads: int
    time_limit_s: float
    def __init__(
            self, *, mode: Mode = ..., rings: int = ...,
            active: Literal["rings", "information"] = ..., active_bound: float = ...,
            boundary: Boundary = ...,
            linear_solver: Literal["ceres", "block", "pcg", "auto", "ceres_cgnr"] = ...,
            preconditioner: Literal["two_level", "block_jacobi", "incomplete_cholesky"] = ...,
            relinearize_above: float = ..., marginal_reach: Union[int, Literal["all"]] = ...,
            graph_sampling: Sampling = ..., graph_distance: Distance = ...,
            node_spacing: Union[float, Literal["automatic"]] = ...,
            target_nodes: Union[int, Literal["automatic"]] = ..., graph_auto_spacing: float = ...,
            neighbors: int = ..., graph_edges: EdgeRule = ..., graph_edges_per_node: int = ...,
            graph_min_component_points: int = ..., graph_join_pieces: bool = ...,
            graph_edges_per_joint: int = ..., volume: Literal["auto", "on", "off"] = ...,
            w_rot: float = ..., w_reg: float = ..., w_volume: float = ..., w_data: float = ...,
            w_landmark: float = ..., w_fixed: float = ..., point_to_point_share: float = ...,
            levels: int = ..., initial_stiffness: float = ..., final_stiffness: float = ...,
            noise_stiffness: float = ..., coarse_steps: int = ..., fine_steps: int = ...,
            max_rounds: int = ..., tolerance: float = ..., solver_iterations: int = ...,
            loss: Loss = ..., loss_width: float = ..., careful_loss_width: float = ...,
            careful_angle_deg: float = ..., hypotheses: str = ...,
            max_distance: Union[float, Literal["unlimited"]] = ..., max_angle_deg: float = ...,
            match_max_deviations: Union[float, Literal["unlimited"]] = ...,
            match_reject_borders: bool = ..., match_symmetric_normals: bool = ...,
            max_samples: int = ..., denoise: bool = ..., rigid_first: bool = ...,
            rigid_scale: bool = ..., rigid_initial_scale: float = ...,
            rigid_max_angle_deg: float = ..., rigid_score_width: float = ...,
            rigid_good_score: float = ..., rigid_preference: float = ..., finish: bool = ...,
            finish_rounds: int = ..., finish_steps: int = ..., finish_smoothing: float = ...,
            finish_max_smoothing: float = ..., finish_fade: float = ...,
            finish_point_to_point_share: float = ..., finish_loss_width: float = ...,
            unfold: bool = ..., covariance: bool = ..., threads: Threads = ...,
            time_limit_s: Union[float, Literal["none"]] = ...) -> None: ...
    def __copy__(self) -> FitOptions: ...
    def copy(self) -> FitOptions: ...


class FitProgress:
    @property
    def stage(self) -> str: ...
    @property
    def fraction(self) -> float: ...
    @property
    def inliers(self) -> int: ...
    @property
    def rms_plane(self) -> float: ...
    @property
    def energy(self) -> float: ...


class Verdict:
    @property
    def grade(self) -> Literal["good", "doubtful", "bad"]: ...
    @property
    def reasons(self) -> list[dict[str, Any]]: ...
    @property
    def advice(self) -> list[str]: ...


class Finding:
    @property
    def code(self) -> str: ...
    @property
    def severity(self) -> Literal["note", "warning"]: ...
    @property
    def text(self) -> str: ...
    @property
    def fix(self) -> str: ...
    @property
    def value(self) -> float: ...


class FitResult:
    def to_trimesh(self) -> Any: ...
    def to_open3d(self) -> Any: ...
    def _repr_html_(self) -> str: ...
    def _repr_png_(self) -> Optional[bytes]: ...
    def picture(self, *, width: int = 900, theme: Literal["light", "dark"] = "light") -> bytes: ...
    @property
    def colors(self) -> Optional[NDArray[np.uint8]]: ...
    @property
    def source_points(self) -> NDArray[np.float64]: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def normals(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def std_dev(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def covariance(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def triangles(self) -> Optional[NDArray[np.int32]]: ...
    @property
    def warp(self) -> Warp: ...
    @property
    def graph(self) -> Graph: ...
    @property
    def rigid(self) -> NDArray[np.float64]: ...
    @property
    def point_relevant(self) -> NDArray[np.bool_]: ...
    @property
    def status(self) -> str: ...
    @property
    def message(self) -> str: ...
    @property
    def inliers(self) -> int: ...
    @property
    def rms_point_to_plane(self) -> float: ...
    @property
    def rms_point_to_point(self) -> float: ...
    @property
    def initial_energy(self) -> float: ...
    @property
    def final_energy(self) -> float: ...
    @property
    def terms(self) -> list[dict[str, Any]]: ...
    @property
    def landmark_errors(self) -> list[dict[str, Any]]: ...
    @property
    def outer_iterations(self) -> int: ...
    @property
    def solver_iterations(self) -> int: ...
    @property
    def max_fixed_error(self) -> float: ...
    @property
    def rigid_only(self) -> bool: ...
    @property
    def hypothesis(self) -> str: ...
    @property
    def noise(self) -> float: ...
    @property
    def unfolded(self) -> int: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def verdict(self) -> Verdict: ...
    @property
    def checks(self) -> list[Finding]: ...
    @property
    def times(self) -> dict[str, float]: ...
    def report(
            self, path: Path, *, truth: Optional[Surface] = None,
            theme: Literal["light", "dark"] = ...) -> None: ...
    def __len__(self) -> int: ...


class SurfaceFitter:
    def __init__(
            self, source: Surface, options: Optional[FitOptions] = None, *,
            energies: Optional[Energies] = None, plugin: Optional[Plugins] = None, mode: Mode = ...,
            rings: int = ..., active: Literal["rings", "information"] = ...,
            active_bound: float = ..., boundary: Boundary = ...,
            linear_solver: Literal["ceres", "block", "pcg", "auto", "ceres_cgnr"] = ...,
            preconditioner: Literal["two_level", "block_jacobi", "incomplete_cholesky"] = ...,
            relinearize_above: float = ..., marginal_reach: Union[int, Literal["all"]] = ...,
            graph_sampling: Sampling = ..., graph_distance: Distance = ...,
            node_spacing: Union[float, Literal["automatic"]] = ...,
            target_nodes: Union[int, Literal["automatic"]] = ..., graph_auto_spacing: float = ...,
            neighbors: int = ..., graph_edges: EdgeRule = ..., graph_edges_per_node: int = ...,
            graph_min_component_points: int = ..., graph_join_pieces: bool = ...,
            graph_edges_per_joint: int = ..., volume: Literal["auto", "on", "off"] = ...,
            w_rot: float = ..., w_reg: float = ..., w_volume: float = ..., w_data: float = ...,
            w_landmark: float = ..., w_fixed: float = ..., point_to_point_share: float = ...,
            levels: int = ..., initial_stiffness: float = ..., final_stiffness: float = ...,
            noise_stiffness: float = ..., coarse_steps: int = ..., fine_steps: int = ...,
            max_rounds: int = ..., tolerance: float = ..., solver_iterations: int = ...,
            loss: Loss = ..., loss_width: float = ..., careful_loss_width: float = ...,
            careful_angle_deg: float = ..., hypotheses: str = ...,
            max_distance: Union[float, Literal["unlimited"]] = ..., max_angle_deg: float = ...,
            match_max_deviations: Union[float, Literal["unlimited"]] = ...,
            match_reject_borders: bool = ..., match_symmetric_normals: bool = ...,
            max_samples: int = ..., denoise: bool = ..., rigid_first: bool = ...,
            rigid_scale: bool = ..., rigid_initial_scale: float = ...,
            rigid_max_angle_deg: float = ..., rigid_score_width: float = ...,
            rigid_good_score: float = ..., rigid_preference: float = ..., finish: bool = ...,
            finish_rounds: int = ..., finish_steps: int = ..., finish_smoothing: float = ...,
            finish_max_smoothing: float = ..., finish_fade: float = ...,
            finish_point_to_point_share: float = ..., finish_loss_width: float = ...,
            unfold: bool = ..., covariance: bool = ..., threads: Threads = ...,
            time_limit_s: Union[float, Literal["none"]] = ...) -> None: ...
    def fit(
            self, target: Optional[Surface] = None, *, landmarks: Optional[PointPositions] = None,
            fixed: Optional[ArrayLike] = None,
            should_stop: Optional[Callable[[], bool]] = None,
            source_landmarks: Optional[AnyLandmarks] = None,
            target_landmarks: Optional[AnyLandmarks] = None,
            landmark_use: Literal["fit", "measure"] = "fit", mesh_space: MeshSpace = "auto") -> FitResult: ...
    def __len__(self) -> int: ...


class ShapeModel:
    @property
    def mean(self) -> NDArray[np.float64]: ...
    @property
    def components(self) -> NDArray[np.float64]: ...
    @property
    def variances(self) -> NDArray[np.float64]: ...
    @property
    def explained(self) -> NDArray[np.float64]: ...
    @property
    def scores(self) -> NDArray[np.float64]: ...
    @property
    def vertex_variances(self) -> NDArray[np.float64]: ...
    @property
    def total_variance(self) -> float: ...


def align_shapes(
    shapes: ArrayLike, *, align: Literal["similarity", "rigid", "none"] = ...,
    frame: Optional[ArrayLike] = None) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def fit_shape_model(shapes: ArrayLike, *, components: int = ...) -> ShapeModel: ...
def measure_shape_model(
    shapes: ArrayLike, *, components: int = ..., samples: int = ...,
    seed: int = ...) -> dict[str, Any]: ...
def compare_groups(
    shapes: ArrayLike, groups: Sequence[Any], *, permutations: int = ...,
    seed: int = ...) -> dict[str, NDArray[np.float64]]: ...


class DistanceStatistics:
    @property
    def mean(self) -> float: ...
    @property
    def rms(self) -> float: ...
    @property
    def p50(self) -> float: ...
    @property
    def p95(self) -> float: ...
    @property
    def p99(self) -> float: ...
    @property
    def max(self) -> float: ...
    @property
    def trimmed(self) -> float: ...
    def in_percent_of(self, diagonal: float) -> DistanceStatistics: ...


class ShapeChange:
    @property
    def edge_mean(self) -> float: ...
    @property
    def edge_p95(self) -> float: ...
    @property
    def edge_p99(self) -> float: ...
    @property
    def edges(self) -> int: ...
    @property
    def flipped(self) -> int: ...
    @property
    def degenerate(self) -> int: ...


class Evaluation:
    def _repr_html_(self) -> str: ...
    def as_dict(self) -> dict[str, Any]: ...
    @property
    def diagonal(self) -> float: ...
    @property
    def forward(self) -> DistanceStatistics: ...
    @property
    def backward(self) -> DistanceStatistics: ...
    @property
    def symmetric(self) -> DistanceStatistics: ...
    @property
    def nearest_forward(self) -> DistanceStatistics: ...
    @property
    def nearest_backward(self) -> DistanceStatistics: ...
    @property
    def point_to_plane(self) -> Optional[float]: ...
    @property
    def normal_error_deg(self) -> Optional[float]: ...
    @property
    def truth(self) -> Optional[DistanceStatistics]: ...
    @property
    def shape(self) -> Optional[ShapeChange]: ...


class TrackerOptions:
    words: ClassVar[dict[str, str]]
    names: ClassVar[tuple[str, ...]]
    mode: Mode
    rings: int
    active: Literal["rings", "information"]
    active_bound: float
    boundary: Boundary
    linear_solver: Literal["ceres", "block", "pcg", "auto", "ceres_cgnr"]
    preconditioner: Literal["two_level", "block_jacobi", "incomplete_cholesky"]
    relinearize_above: float
    marginal_reach: int
    w_rot: float
    w_reg: float
    yield_strain: float
    w_node_prior: float
    w_data: float
    w_feature: float
    prior_rotation_deg: float
    prior_translation: float
    level2: LevelTwo
    lazy_tolerance: float
    lazy_reach: int
    lazy_waves_per_frame: int
    lazy_max_seeds: int
    camera: CameraMode
    rigid: bool
    node_spacing: float
    nodes_in_view: int
    neighbors: int
    features: bool
    rounds: int
    max_observations: int
    max_point_weight: float
    memory_max_moments: int
    memory_likeness: float
    memory_min_common: int
    verify_every: int
    covariance: bool
    threads: int
    feature_count: int
    feature_max_deviations: float
    feature_window: int
    feature_pyramid_levels: int
    feature_light_radius: float
    feature_max_round_trip: float
    feature_min_distance: float
    feature_quality: float
    growth_point_spacing: float
    growth_node_coverage: float
    growth_edges_per_node: int
    growth_max_view_angle_deg: float
    surface_cell: int
    surface_radius: int
    surface_max_slope_noise: float
    surface_max_slope_deg: float
    def __init__(
            self, *, mode: Mode = ..., rings: int = ...,
            active: Literal["rings", "information"] = ..., active_bound: float = ...,
            boundary: Boundary = ...,
            linear_solver: Literal["ceres", "block", "pcg", "auto", "ceres_cgnr"] = ...,
            preconditioner: Literal["two_level", "block_jacobi", "incomplete_cholesky"] = ...,
            relinearize_above: float = ..., marginal_reach: Union[int, Literal["all"]] = ...,
            w_rot: float = ..., w_reg: float = ...,
            yield_strain: Union[float, Literal["never"]] = ..., w_node_prior: float = ...,
            w_data: float = ..., w_feature: float = ..., prior_rotation_deg: float = ...,
            prior_translation: float = ..., level2: LevelTwo = ..., lazy_tolerance: float = ...,
            lazy_reach: int = ..., lazy_waves_per_frame: int = ..., lazy_max_seeds: int = ...,
            camera: CameraMode = ..., rigid: bool = ...,
            node_spacing: Union[float, Literal["automatic"]] = ..., nodes_in_view: int = ...,
            neighbors: int = ..., features: bool = ..., rounds: int = ...,
            max_observations: int = ..., max_point_weight: float = ...,
            memory_max_moments: int = ..., memory_likeness: float = ...,
            memory_min_common: int = ..., verify_every: Union[int, Literal["none"]] = ...,
            covariance: bool = ..., threads: Threads = ..., feature_count: int = ...,
            feature_max_deviations: float = ..., feature_window: int = ...,
            feature_pyramid_levels: int = ..., feature_light_radius: float = ...,
            feature_max_round_trip: float = ..., feature_min_distance: float = ...,
            feature_quality: float = ..., growth_point_spacing: float = ...,
            growth_node_coverage: float = ..., growth_edges_per_node: int = ...,
            growth_max_view_angle_deg: float = ..., surface_cell: int = ...,
            surface_radius: int = ..., surface_max_slope_noise: float = ...,
            surface_max_slope_deg: float = ...) -> None: ...
    def __copy__(self) -> TrackerOptions: ...
    def copy(self) -> TrackerOptions: ...


class Camera:
    def __init__(
            self, fx: float, fy: float, cx: float, cy: float, width: int, height: int) -> None: ...
    @property
    def fx(self) -> float: ...
    @property
    def fy(self) -> float: ...
    @property
    def cx(self) -> float: ...
    @property
    def cy(self) -> float: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...


class FrameReport:
    @property
    def camera_covariance(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def number(self) -> int: ...
    @property
    def status(self) -> str: ...
    @property
    def times(self) -> dict[str, float]: ...
    @property
    def nodes(self) -> int: ...
    @property
    def point_relevant(self) -> int: ...
    @property
    def active(self) -> int: ...
    @property
    def updated_pi(self) -> int: ...
    @property
    def points(self) -> int: ...
    @property
    def map_points(self) -> int: ...
    @property
    def inliers(self) -> int: ...
    @property
    def features(self) -> int: ...
    @property
    def explained(self) -> float: ...
    @property
    def overlap(self) -> float: ...
    @property
    def weak_directions(self) -> int: ...
    @property
    def tentative(self) -> float: ...
    @property
    def rms_plane(self) -> float: ...
    @property
    def energy(self) -> float: ...
    @property
    def iterations(self) -> int: ...


class MapSnapshot:
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def normals(self) -> NDArray[np.float64]: ...
    @property
    def colors(self) -> NDArray[np.uint8]: ...
    @property
    def ids(self) -> NDArray[np.int32]: ...
    @property
    def birth_frames(self) -> NDArray[np.int32]: ...
    @property
    def weights(self) -> NDArray[np.float64]: ...
    @property
    def stabilities(self) -> NDArray[np.float64]: ...
    @property
    def last_seen(self) -> NDArray[np.int32]: ...
    def __len__(self) -> int: ...


class Tracker:
    def __init__(
            self, intrinsics: Camera, options: Optional[TrackerOptions] = None, *,
            energies: Optional[Energies] = None, plugin: Optional[Plugins] = None, mode: Mode = ...,
            rings: int = ..., active: Literal["rings", "information"] = ...,
            active_bound: float = ..., boundary: Boundary = ...,
            linear_solver: Literal["ceres", "block", "pcg", "auto", "ceres_cgnr"] = ...,
            preconditioner: Literal["two_level", "block_jacobi", "incomplete_cholesky"] = ...,
            relinearize_above: float = ..., marginal_reach: Union[int, Literal["all"]] = ...,
            w_rot: float = ..., w_reg: float = ...,
            yield_strain: Union[float, Literal["never"]] = ..., w_node_prior: float = ...,
            w_data: float = ..., w_feature: float = ..., prior_rotation_deg: float = ...,
            prior_translation: float = ..., level2: LevelTwo = ..., lazy_tolerance: float = ...,
            lazy_reach: int = ..., lazy_waves_per_frame: int = ..., lazy_max_seeds: int = ...,
            camera: CameraMode = ..., rigid: bool = ...,
            node_spacing: Union[float, Literal["automatic"]] = ..., nodes_in_view: int = ...,
            neighbors: int = ..., features: bool = ..., rounds: int = ...,
            max_observations: int = ..., max_point_weight: float = ...,
            memory_max_moments: int = ..., memory_likeness: float = ...,
            memory_min_common: int = ..., verify_every: Union[int, Literal["none"]] = ...,
            covariance: bool = ..., threads: Threads = ..., feature_count: int = ...,
            feature_max_deviations: float = ..., feature_window: int = ...,
            feature_pyramid_levels: int = ..., feature_light_radius: float = ...,
            feature_max_round_trip: float = ..., feature_min_distance: float = ...,
            feature_quality: float = ..., growth_point_spacing: float = ...,
            growth_node_coverage: float = ..., growth_edges_per_node: int = ...,
            growth_max_view_angle_deg: float = ..., surface_cell: int = ...,
            surface_radius: int = ..., surface_max_slope_noise: float = ...,
            surface_max_slope_deg: float = ...) -> None: ...
    def track(
            self, depth: ArrayLike, color: Optional[ArrayLike] = None,
            pose: Optional[ArrayLike] = None, *, units_per_metre: Optional[float] = None,
            number: Optional[int] = None, catch_up: bool = False) -> FrameReport: ...
    def snapshot(self, frame: Literal["map", "camera"] = "map") -> MapSnapshot: ...
    def points(self, frame: Literal["map", "camera"] = "map") -> NDArray[np.float64]: ...
    @property
    def camera_pose(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def warp(self) -> Warp: ...
    @property
    def graph(self) -> Graph: ...
    @property
    def point_relevant(self) -> NDArray[np.bool_]: ...
    def __len__(self) -> int: ...


class SequenceOptions:
    words: ClassVar[dict[str, str]]
    names: ClassVar[tuple[str, ...]]
    format: SequenceFormat
    first: int
    last: int
    step: int
    depth_from: Literal["auto", "images", "stereo"]
    color: bool
    masks: bool
    mask_means: Literal["auto", "tool", "tissue"]
    depth_units_per_metre: float
    def __init__(
            self, *, format: SequenceFormat = ..., first: int = ...,
            last: Union[int, Literal["end"]] = ..., step: int = ...,
            depth_from: Literal["auto", "images", "stereo"] = ..., color: bool = ...,
            masks: bool = ..., mask_means: Literal["auto", "tool", "tissue"] = ...,
            depth_units_per_metre: Union[float, Literal["automatic"]] = ...) -> None: ...
    def __copy__(self) -> SequenceOptions: ...
    def copy(self) -> SequenceOptions: ...


class Frame:
    @property
    def number(self) -> int: ...
    @property
    def time(self) -> float: ...
    @property
    def depth(self) -> NDArray[np.float32]: ...
    @property
    def color(self) -> Optional[NDArray[np.uint8]]: ...
    @property
    def pose(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def warning(self) -> str: ...


class FrameIterator:
    def __iter__(self) -> FrameIterator: ...
    def __next__(self) -> Frame: ...


class FrameSequence:
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> Frame: ...
    def __iter__(self) -> FrameIterator: ...
    @property
    def camera(self) -> Camera: ...
    @property
    def numbers(self) -> list[int]: ...
    @property
    def is_stereo(self) -> bool: ...
    @property
    def has_color(self) -> bool: ...
    @property
    def description(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...


def load(path: Path) -> Cloud: ...
def save(
        path: Path, surface: Surface, *, like: Optional[Union[Cloud, Path]] = None,
        double_precision: bool = False) -> None: ...
def fit(
        source: Surface, target: Optional[Surface] = None, *,
        landmarks: Optional[PointPositions] = None, fixed: Optional[ArrayLike] = None,
        energies: Optional[Energies] = None, plugin: Optional[Plugins] = None,
        options: Optional[FitOptions] = None,
        progress: Optional[Callable[[FitProgress], object]] = None,
        should_stop: Optional[Callable[[], bool]] = None,
        source_landmarks: Optional[AnyLandmarks] = None,
        target_landmarks: Optional[AnyLandmarks] = None,
        landmark_use: Literal["fit", "measure"] = "fit", mesh_space: MeshSpace = "auto",
        mode: Mode = ..., rings: int = ..., active: Literal["rings", "information"] = ...,
        active_bound: float = ..., boundary: Boundary = ...,
        linear_solver: Literal["ceres", "block", "pcg", "auto", "ceres_cgnr"] = ...,
        preconditioner: Literal["two_level", "block_jacobi", "incomplete_cholesky"] = ...,
        relinearize_above: float = ..., marginal_reach: Union[int, Literal["all"]] = ...,
        graph_sampling: Sampling = ..., graph_distance: Distance = ...,
        node_spacing: Union[float, Literal["automatic"]] = ...,
        target_nodes: Union[int, Literal["automatic"]] = ..., graph_auto_spacing: float = ...,
        neighbors: int = ..., graph_edges: EdgeRule = ..., graph_edges_per_node: int = ...,
        graph_min_component_points: int = ..., graph_join_pieces: bool = ...,
        graph_edges_per_joint: int = ..., volume: Literal["auto", "on", "off"] = ...,
        w_rot: float = ..., w_reg: float = ..., w_volume: float = ..., w_data: float = ...,
        w_landmark: float = ..., w_fixed: float = ..., point_to_point_share: float = ...,
        levels: int = ..., initial_stiffness: float = ..., final_stiffness: float = ...,
        noise_stiffness: float = ..., coarse_steps: int = ..., fine_steps: int = ...,
        max_rounds: int = ..., tolerance: float = ..., solver_iterations: int = ...,
        loss: Loss = ..., loss_width: float = ..., careful_loss_width: float = ...,
        careful_angle_deg: float = ..., hypotheses: str = ...,
        max_distance: Union[float, Literal["unlimited"]] = ..., max_angle_deg: float = ...,
        match_max_deviations: Union[float, Literal["unlimited"]] = ...,
        match_reject_borders: bool = ..., match_symmetric_normals: bool = ...,
        max_samples: int = ..., denoise: bool = ..., rigid_first: bool = ...,
        rigid_scale: bool = ..., rigid_initial_scale: float = ..., rigid_max_angle_deg: float = ...,
        rigid_score_width: float = ..., rigid_good_score: float = ...,
        rigid_preference: float = ..., finish: bool = ..., finish_rounds: int = ...,
        finish_steps: int = ..., finish_smoothing: float = ..., finish_max_smoothing: float = ...,
        finish_fade: float = ..., finish_point_to_point_share: float = ...,
        finish_loss_width: float = ..., unfold: bool = ..., covariance: bool = ...,
        threads: Threads = ..., time_limit_s: Union[float, Literal["none"]] = ...) -> FitResult: ...
def evaluate(
        result: Surface, target: Surface, truth: Optional[Surface] = None,
        source: Optional[Surface] = None) -> Evaluation: ...
def evaluate_sequence(sequence: Path, result: Path) -> dict[str, Any]: ...
def report(runs: Path | Sequence[Path], *, html: Path | None = ..., png: Path | None = ..., truth: Path | None = ...,
           theme: Literal["light", "dark"] = ...) -> None: ...
def open_sequence(
        path: Path, options: Optional[SequenceOptions] = None, *, format: SequenceFormat = ...,
        first: int = ..., last: Union[int, Literal["end"]] = ..., step: int = ...,
        depth_from: Literal["auto", "images", "stereo"] = ..., color: bool = ..., masks: bool = ...,
        mask_means: Literal["auto", "tool", "tissue"] = ...,
        depth_units_per_metre: Union[float, Literal["automatic"]] = ...) -> FrameSequence: ...
def list_energies(plugin: Optional[Plugins] = None) -> list[EnergyInfo]: ...
def backend() -> dict[str, str]: ...
