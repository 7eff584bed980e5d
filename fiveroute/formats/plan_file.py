"""The native plan file: JSON, ``"format": "fiveroute-plan/1"``.

A plan file stands alone: it holds the whole instance document, so that the plan can be
viewed, exported and judged without any other file, and the hash of that document, so that
it is never taken for a plan of another instance.
"""

from __future__ import annotations

import hashlib
import itertools
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field, NonNegativeFloat
from pydantic.dataclasses import dataclass

import fiveroute
from fiveroute.errors import InputError
from fiveroute.formats.files import read_text, write_text_atomically
from fiveroute.formats.json_document import layout, read_document
from fiveroute.formats.native import (
    InstanceDocument,
    currents_file,
    instance_document,
    instance_hash,
    relocated,
)
from fiveroute.instance import Instance, Many
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result, Status
from fiveroute.routes import Plan

if TYPE_CHECKING:
    from fiveroute.paths.leg_table import LegTable

__all__ = ["TAG", "PlanFile", "currents_hash", "read_plan", "write_plan"]

TAG = "fiveroute-plan/1"

_STRICT = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)

_Path = Annotated[Many[tuple[float, float]], Field(min_length=2)]


@dataclass(frozen=True, slots=True, config=_STRICT)
class PlanFile:
    """A plan as a file holds it.

    Parameters
    ----------
    instance
        The instance that the plan is for.
    routes
        Ids of the nodes on every route, in the order of the visits.
    durations
        Travel and service time of every route in seconds.
    objective
        Collected data.
    status
        How the method ended.
    bound
        Proven upper bound on the collected data; None where none was computed.
    method, seed, version
        How the plan was found: method, its seed (None without one), fiveroute's version.
    paths
        For every route the waypoints (x, y) in metres of its legs, from the start to the
        destination; None for straight lines in still water.
    currents_hash
        SHA-256 of the instance's file of currents in hexadecimal; None without one.
    """

    instance: Instance
    routes: Many[Many[str]]
    durations: Many[NonNegativeFloat]
    objective: NonNegativeFloat
    status: Annotated[Status, Field(strict=False)]
    bound: float | None
    method: str
    seed: int | None
    version: str
    paths: Many[Many[_Path]] | None = None
    currents_hash: str | None = None

    def __post_init__(self) -> None:
        if len(self.durations) != len(self.routes):
            raise InputError(
                f"must have {len(self.routes)} entries, one for every route",
                field="durations",
                value=len(self.durations),
            )
        if self.paths is not None and len(self.paths) != len(self.routes):
            raise InputError(
                f"must have {len(self.routes)} entries, one for every route",
                field="paths",
                value=len(self.paths),
            )

    @classmethod
    def of(
        cls,
        instance: Instance,
        problem: TeamOrienteering,
        result: Result,
        legs: LegTable | None = None,
    ) -> PlanFile:
        """A method's plan for an instance.

        Parameters
        ----------
        instance
            The instance.
        problem
            The problem that was solved; its leg times give the durations.
        result
            A result that has a plan.
        legs
            Where its paths are; None for straight lines in still water.
        """
        if result.plan is None or result.objective is None:
            raise InputError("there is no plan to write", field="status", value=str(result.status))
        return cls(
            instance=instance,
            routes=tuple(
                tuple(instance.nodes[node - 1].id for node in route) for route in result.plan.routes
            ),
            durations=result.plan.durations(problem),
            objective=result.objective,
            status=result.status,
            bound=result.bound,
            method=result.method,
            seed=result.seed,
            version=fiveroute.__version__,
            paths=None
            if legs is None
            else tuple(
                tuple(
                    tuple(map(tuple, legs.track(tail, head).tolist()))
                    for tail, head in itertools.pairwise((0, *route, problem.destination))
                )
                for route in result.plan.routes
            ),
        )

    @property
    def tracks(self) -> list[list[NDArray[np.float64]]] | None:
        """The paths as arrays, shape (k, 2) each."""
        if self.paths is None:
            return None
        return [[np.array(path, dtype=np.float64) for path in paths] for paths in self.paths]

    @property
    def plan(self) -> Plan:
        """The routes as vertex numbers; see `vertex_names`."""
        vertices = {name: vertex for vertex, name in enumerate(self.vertex_names)}
        return Plan.of([vertices[name] for name in route] for route in self.routes)

    @property
    def vertex_names(self) -> tuple[str, ...]:
        """Id of every vertex of `plan`.

        Start and destination have none. An id on a route that is no node's gets a vertex
        beyond the destination: the judge reports it as an unknown node.
        """
        nodes = [node.id for node in self.instance.nodes]
        known = {"", *nodes}
        on_routes = dict.fromkeys(name for route in self.routes for name in route)
        return ("", *nodes, "", *(name for name in on_routes if name not in known))

    def require_instance(self, instance: Instance) -> None:
        """Refuse another instance than the plan's own; the error names both."""
        own, other = instance_hash(self.instance), instance_hash(instance)
        if own != other:
            raise InputError(
                f"is a plan for {self.instance.name!r} (hash {own[:12]}), not for "
                f"{instance.name!r} (hash {other[:12]}); use the instance it was made for",
                field="instance_hash",
            )

    def require_currents(self, folder: Path) -> None:
        """Refuse another file of currents than the one that the plan was made in.

        Parameters
        ----------
        folder
            Folder of the instance.
        """
        if self.currents_hash is None:
            return
        found = currents_hash(self.instance, folder / "instance")
        if found != self.currents_hash:
            raise InputError(
                f"is that of another ocean: the file {self.instance.ocean.currents.file!r} has "
                f"the hash {(found or 'none')[:12]}; use the file it was made with, or plan anew",
                field="currents_hash",
                value=self.currents_hash[:12],
            )


def currents_hash(instance: Instance, source: Path) -> str | None:
    """SHA-256 of the file of currents that an instance from a file names; None without one."""
    file = currents_file(instance, source)
    if file is None:
        return None
    try:
        with file.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError as error:
        raise InputError(f"cannot be read ({error.strerror})", file=file) from None


@dataclass(frozen=True, slots=True, kw_only=True, config=_STRICT)
class _PlanDocument(PlanFile):
    format: Literal["fiveroute-plan/1"]
    instance: InstanceDocument
    instance_hash: str


def read_plan(path: Path, instance: Instance | None = None) -> PlanFile:
    """Read a plan file.

    Parameters
    ----------
    path
        The file.
    instance
        Instance that the plan is to be used with; None takes the one in the file.

    Raises
    ------
    InputError
        If the file is no valid plan, does not fit its own hash, or is a plan for another
        instance.
    """
    try:
        document = read_document(read_text(path), _PlanDocument, TAG)
        own = {field.name: getattr(document, field.name) for field in fields(PlanFile)}
        plan = PlanFile(**(own | {"instance": document.instance.instance}))
        if instance_hash(plan.instance) != document.instance_hash:
            raise InputError(
                "does not fit the instance in this file; somebody changed it, plan it anew",
                field="instance_hash",
                value=document.instance_hash,
            )
        if instance is not None:
            plan.require_instance(instance)
    except InputError as error:
        raise error.at(path) from None
    return plan


def write_plan(plan: PlanFile, path: Path, force: bool = False, source: Path | None = None) -> None:
    """Write a plan file, whole or not at all.

    Parameters
    ----------
    plan
        The plan.
    path
        The file.
    force
        Overwrite an existing file.
    source
        File that the instance comes from; names of files in it are relative to it.
    """
    instance = plan.instance if source is None else relocated(plan.instance, source, path)
    document: dict[str, Any] = {
        "format": TAG,
        "instance": instance_document(instance),
        "instance_hash": instance_hash(instance),
        "routes": plan.routes,
        "durations": plan.durations,
        "objective": plan.objective,
        "status": plan.status.value,
        "bound": plan.bound,
        "method": plan.method,
        "seed": plan.seed,
        "version": plan.version,
    }
    if plan.paths is not None:
        document["paths"] = plan.paths
        if source is not None and (digest := currents_hash(plan.instance, source)) is not None:
            document["currents_hash"] = digest
    write_text_atomically(path, layout(document) + "\n", force)
