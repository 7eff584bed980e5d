"""The one folder that a studio writes to.

The page names files, never paths: what is not the plain name of a file in the folder is refused,
and so are symbolic links, which could lead out of it. Nothing is overwritten before somebody said
so.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from fiveroute.errors import FiverouteError, InputError, nearest
from fiveroute.formats import write_instance, write_plan
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Instance
from fiveroute.vehicle_files import VEHICLE_FORMATS, Choices, export_plan

__all__ = ["ExistsError", "Project"]

_NAME = re.compile(r"(?![. ])[^\x00-\x1f\x7f/\\:*?\"<>|]+(?<![ .])")

_LONGEST = 150  # bytes; drafts of files have a few more


class ExistsError(FiverouteError):
    """Files are there already; the page has to ask.

    Parameters
    ----------
    names
        Their names.
    """

    def __init__(self, names: Sequence[str]) -> None:
        self.names = tuple(names)
        super().__init__(
            f"{' and '.join(names)}: exists already; overwrite, or choose another name"
        )


@dataclass(frozen=True, slots=True)
class Project:
    """A folder.

    Parameters
    ----------
    folder
        The folder, without symbolic links in its path; see `at`.
    """

    folder: Path

    @classmethod
    def at(cls, folder: Path) -> Project:
        """The project of a folder that must exist."""
        if not folder.is_dir():
            raise InputError("is no folder; make it", field="folder", value=str(folder))
        return cls(folder.resolve())

    def place(self, name: str) -> Path:
        """The path of a file or folder of this project.

        Raises
        ------
        InputError
            If the name is none, or leads out of the folder.
        """
        if _NAME.fullmatch(name) is None or len(name.encode()) > _LONGEST:
            raise InputError(
                "is no plain file name; use letters, digits, '-' and '_', and no folder",
                field="name",
                value=name,
            )
        path = self.folder / name
        if path.is_symlink() or path.resolve().parent != self.folder:
            raise InputError(
                "leads out of the project folder; choose another name", field="name", value=name
            )
        return path

    def save(
        self,
        instance: tuple[Instance, str] | None,
        plan: tuple[PlanFile, str] | None,
        source: Path,
        overwrite: bool = False,
    ) -> list[str]:
        """Write a mission, a plan, or both; return their names.

        Parameters
        ----------
        instance, plan
            What to write and its name; None leaves it out.
        source
            File that the mission comes from; the name of its file of currents is relative to it.
        overwrite
            Whether somebody said that existing files may go.
        """
        names = [_ending(what[1], ".json") for what in (instance, plan) if what is not None]
        if len(set(names)) < len(names):
            raise InputError("mission and plan need names of their own", field="name")
        paths = self._free(names, overwrite)
        if instance is not None:
            write_instance(instance[0], paths[0], "native", force=overwrite, source=source)
        if plan is not None:
            write_plan(plan[0], paths[-1], overwrite, source=source)
        return names

    def export(
        self,
        filed: PlanFile,
        source: Path,
        format_name: str,
        name: str,
        choices: Choices,
        overwrite: bool = False,
    ) -> dict[str, object]:
        """Write a plan for vehicles, or refuse an unsafe one; return what was written."""
        if format_name not in VEHICLE_FORMATS:
            raise InputError(
                f"is no format; {nearest(format_name, VEHICLE_FORMATS)}",
                field="format",
                value=format_name,
            )
        chosen = VEHICLE_FORMATS[format_name]
        if chosen.holds in ("fleet", "archive"):
            name = _ending(name, chosen.suffixes[0])
        (path,) = self._free([name], overwrite)
        mission = export_plan(filed, source, format_name, path, choices, overwrite)
        return {"name": name, "vehicles": [vehicle.name for vehicle in mission.vehicles]}

    def _free(self, names: Sequence[str], overwrite: bool) -> list[Path]:
        paths = [self.place(name) for name in names]
        taken = [path.name for path in paths if path.exists()]
        if taken and not overwrite:
            raise ExistsError(taken)
        return paths


def _ending(name: str, suffix: str) -> str:
    return name if name.lower().endswith(suffix) else f"{name}{suffix}"
