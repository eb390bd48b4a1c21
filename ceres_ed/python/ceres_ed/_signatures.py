"""Gives the functions of the module signatures that list every option, for completion and help.

A function of _core takes its options as **kwargs, whose names inspect, IPython and help() do not see.
"""
import functools
import inspect
from typing import Any, Callable, TypeVar, cast

from . import _core

F = TypeVar("F", bound=Callable[..., Any])


def _keywords(options: Any) -> "list[inspect.Parameter]":
    defaults = options()
    return [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=getattr(defaults, name))
            for name in options.names]


def _own_parameters(function: Any) -> "list[inspect.Parameter]":
    """Returns the parameters before **kwargs. pybind11 writes them into the first line of the text."""
    line = function.__doc__.splitlines()[0]
    inside = line[line.index("(") + 1:line.rindex(") ->")]
    kind: Any = inspect.Parameter.POSITIONAL_OR_KEYWORD
    parameters = []
    for piece in inside.split(", "):
        name = piece.split(":")[0].split("=")[0].strip()
        if name == "*":
            kind = inspect.Parameter.KEYWORD_ONLY
        elif name != "self" and not name.startswith("**"):
            default = None if "=" in piece else inspect.Parameter.empty
            parameters.append(inspect.Parameter(name, kind, default=default))
    return parameters


def with_options(name: str, function: F, options: Any, is_method: bool = False) -> F:
    """Returns a function of Python, ceres_ed.`name`, that calls `function`; with all options as keywords.

    Unlike a function of a module in C++, it can be pickled: a process pool may call it.
    """
    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        return function(*args, **kwargs)

    call.__module__, call.__qualname__ = "ceres_ed", name
    signed: Any = call
    first = [inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)] if is_method else []
    signed.__signature__ = inspect.Signature(
        first + _own_parameters(function) + _keywords(options))
    return cast(F, signed)


def _sign(kind: Any, parameters: "list[inspect.Parameter]") -> None:
    kind.__signature__ = inspect.Signature(parameters)


fit = with_options("fit", _core.fit, _core.FitOptions)
open_sequence = with_options("open_sequence", _core.open_sequence, _core.SequenceOptions)
_graph: Any = _core.Graph
_graph.build = staticmethod(with_options("Graph.build", _graph.build, _core.GraphOptions))
_warp: Any = _core.Warp
for _name in ("field", "write_field"):
    setattr(_warp, _name, with_options(f"Warp.{_name}", getattr(_warp, _name), _core.FieldOptions,
                                       is_method=True))
for _options in (_core.FieldOptions, _core.FitOptions, _core.GraphOptions, _core.SequenceOptions, _core.TrackerOptions):
    _sign(_options, _keywords(_options))
for _kind, _options in ((_core.SurfaceFitter, _core.FitOptions),
                        (_core.Tracker, _core.TrackerOptions)):
    _taker: Any = _kind
    _sign(_taker, _own_parameters(_taker.__init__) + _keywords(_options))
