"""Certificates of bounds: written by ``solve``, confirmed by ``verify``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from fiveroute.errors import InputError
from fiveroute.formats.files import read_text, write_text_atomically
from fiveroute.formats.json_document import parsed
from fiveroute.formats.native import instance_hash
from fiveroute.instance import Instance
from fiveroute.limits import Limits
from fiveroute.paths.voyage import Voyage
from fiveroute.problem import TeamOrienteering

__all__ = ["confirm_certificate", "write_certificate"]


def write_certificate(
    mission: Instance, voyage: Voyage, problem: TeamOrienteering, path: Path, *, force: bool
) -> None:
    """Write the proof of the root bound of column generation, for one fleet on one instance."""
    from fiveroute.models.branch_price.certificate import certify

    proof = certify(problem)
    if proof is None:
        raise InputError(
            "there is no bound to certify: no AUV can reach the destination in time",
            field="certificate",
            value=str(path),
        )
    document = proof.document() | {
        "instance_hash": instance_hash(mission),
        "fleet_size": problem.fleet_size,
        "straight_lines": voyage.legs is None,
    }
    text = json.dumps(document, indent=1, allow_nan=False) + "\n"
    write_text_atomically(path, text, force)


def confirm_certificate(
    mission: Instance, file: Path, path: Path, limits: Limits
) -> dict[str, Any]:
    """Confirm a certificate by dynamic programming that shares nothing with its making.

    Parameters
    ----------
    mission, file
        The instance, and where it comes from.
    path
        The certificate.
    limits
        When to stop; a check that is stopped confirms nothing.

    Returns
    -------
    dict
        ``instance``, ``confirmed``, ``bound``, ``excess`` (in data), ``labels``.
    """
    from fiveroute.cli.sailing import sail
    from fiveroute.models.certificate_check import check_certificate

    document = _read(path)
    if document.get("instance_hash") != instance_hash(mission):
        raise InputError(
            f"is a certificate for another instance than {mission.name!r}",
            file=path,
            field="instance_hash",
            value=str(document.get("instance_hash"))[:12],
        )
    size = document.get("fleet_size")
    if type(size) is not int or size < 1:
        raise InputError("must be a number of AUVs", file=path, field="fleet_size", value=size)
    straight = bool(document.get("straight_lines", True))
    voyage = sail(mission, file, limits, straight_lines=straight)
    problem = voyage.instance.problem(size, voyage.travel)
    try:
        verdict = check_certificate(problem, document, limits)
    except InputError as error:
        raise error.at(path) from None
    return {
        "instance": mission.name,
        "confirmed": verdict.confirmed,
        "bound": verdict.bound if verdict.confirmed else None,
        "excess": verdict.excess,
        "labels": verdict.labels,
    }


def _read(path: Path) -> dict[str, Any]:
    try:
        document = parsed(read_text(path))
    except InputError as error:
        raise error.at(path) from None
    if not isinstance(document, dict):
        raise InputError("must be a JSON object", file=path)
    return document
