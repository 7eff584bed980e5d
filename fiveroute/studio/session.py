"""One mission that is being edited: its versions, its plan, and the work in the background.

Every edit makes a new version and keeps the old one with the plan that belongs to it, so that
undo brings both back. A version whose plan is older than its mission holds a draft, see
`fiveroute.studio.drafts`. All methods may be called from any thread.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from fiveroute.errors import InputError
from fiveroute.formats import read_instance
from fiveroute.formats.files import read_text
from fiveroute.formats.native import instance_document
from fiveroute.formats.plan_file import TAG, PlanFile, read_plan
from fiveroute.instance import Fleet, Instance, Point
from fiveroute.kernels import on_compilation
from fiveroute.studio.drafts import blank, drafted
from fiveroute.studio.edits import Edit, edited, kept_ids
from fiveroute.studio.planning import Job, Wish
from fiveroute.studio.project import Project
from fiveroute.vehicle_files import Choices
from fiveroute.view.payload import document_of
from fiveroute.view.scene import scene_of

__all__ = ["Session", "Version"]

_MOST_VERSIONS = 500
_ENDING = 10.0  # seconds that work in the background has to end


@dataclass(frozen=True, slots=True, eq=False)
class Version:
    """A mission with its plan, or with what an edit has left of one.

    Parameters
    ----------
    filed
        The plan or draft, with the mission.
    is_planned
        Whether it is a plan of just this mission.
    """

    filed: PlanFile
    is_planned: bool

    @property
    def instance(self) -> Instance:
        """The mission."""
        return self.filed.instance


class Session:
    """A mission that is being edited.

    Parameters
    ----------
    first
        What to begin with.
    source
        File that it comes from; the name of its file of currents is relative to it.
    project
        The folder to write to.
    """

    def __init__(self, first: Version, source: Path, project: Project) -> None:
        self.source, self.project = source, project
        self._versions, self._place = [first], 0
        self._saved: Version | None = first
        self._revision = 0
        self._job: Job | None = None
        self._lock = threading.RLock()
        on_compilation(self._compiles)

    @classmethod
    def opened(cls, path: Path | None, folder: Path | None = None) -> Session:
        """Open a plan, an instance, or an empty mission.

        Parameters
        ----------
        path
            File of a plan or an instance of any format; None begins with an empty mission.
        folder
            Folder to write to; None takes that of the file, or the current one.

        Raises
        ------
        InputError
            If the file is wrong or the folder missing.
        """
        if path is None:
            project = Project.at(folder or Path())
            first = Version(blank(_empty_mission()), is_planned=False)
            return cls(first, project.folder / "mission.json", project)
        if path.suffix.lower() == ".json" and f'"{TAG}"' in read_text(path)[:200]:
            first = Version(read_plan(path), is_planned=True)
        else:
            first = Version(blank(read_instance(path)), is_planned=False)
        return cls(first, path.absolute(), Project.at(folder or path.absolute().parent))

    @property
    def version(self) -> Version:
        """The mission and its plan as they stand."""
        with self._lock:
            return self._versions[self._place]

    @property
    def is_saved(self) -> bool:
        """Whether the mission as it stands is in a file."""
        with self._lock:
            return self._saved is not None and self._saved.instance == self.version.instance

    def edit(self, revision: int, edit: Edit) -> None:
        """Change the mission.

        Raises
        ------
        InputError
            If the edit breaks a rule, or was made on another revision than the present one.
        """
        with self._lock:
            if revision != self._revision:
                raise InputError(
                    "the mission has changed in the meantime, maybe in another window; it has "
                    "been loaded anew, edit it again"
                )
            before = self.version
            instance = edited(before.instance, edit)
            if instance == before.instance:
                return
            self._drop_job()
            self._push(_after(before, instance, edit))

    def step(self, places: int) -> None:
        """Undo (-1) or redo (1), if there is something to."""
        with self._lock:
            place = self._place + places
            if 0 <= place < len(self._versions):
                self._drop_job()
                self._place = place
                self._revision += 1

    def plan(self, wish: Wish) -> None:
        """Plan the mission anew in the background; work that goes on is stopped."""
        with self._lock:
            before = self._job
            self._drop_job()
            job = Job(self.version.instance, self.source.parent, wish, self._ended)
            self._job = job
            job.start(after=before)

    def stop(self) -> None:
        """Ask the work in the background for the best plan so far."""
        with self._lock:
            if self._job is not None:
                self._job.stop()

    def close(self) -> None:
        """End the work in the background."""
        with self._lock:
            job = self._job
            self._drop_job()
        if job is not None:
            job.join(_ENDING)

    def progress(self) -> dict[str, Any]:
        """How far the work in the background is."""
        with self._lock:
            return {
                "revision": self._revision,
                "job": None if self._job is None else self._job.told(),
            }

    def told(self) -> dict[str, Any]:
        """All that the page shows: the mission, its plan, what can be done."""
        with self._lock:
            version = self.version
            instance = version.instance
            return {
                **self.progress(),
                "view": document_of([scene_of(version.filed, self.source.parent)]),
                "mission": instance_document(instance),
                "planned": version.is_planned,
                "saved": self.is_saved,
                "undo": self._place > 0,
                "redo": self._place < len(self._versions) - 1,
                "ocean": instance.has_ocean,
                "folder": str(self.project.folder),
                "stem": self.source.stem,
            }

    def save(self, instance: str | None, plan: str | None, overwrite: bool) -> list[str]:
        """Write the mission, its plan, or both into the project folder; return their names."""
        with self._lock:
            version = self.version
            if plan is not None:
                self._require_plan()
            names = self.project.save(
                None if instance is None else (version.instance, instance),
                None if plan is None else (version.filed, plan),
                self.source,
                overwrite,
            )
            self._saved = version
            return names

    def export(
        self, format_name: str, name: str, choices: Choices, overwrite: bool
    ) -> dict[str, object]:
        """Write the plan for vehicles into the project folder."""
        with self._lock:
            self._require_plan()
            filed, source = self.version.filed, self.source
        return self.project.export(filed, source, format_name, name, choices, overwrite)

    def _require_plan(self) -> None:
        if not self.version.is_planned:
            raise InputError("the plan is older than the mission; plan it anew first")

    def _push(self, version: Version) -> None:
        del self._versions[self._place + 1 :]
        self._versions.append(version)
        del self._versions[:-_MOST_VERSIONS]
        self._place = len(self._versions) - 1
        self._revision += 1

    def _drop_job(self) -> None:
        """Stop the work in the background and forget its answer."""
        if self._job is not None:
            self._job.stop()
            self._job = None

    def _compiles(self) -> None:
        if self._job is not None:
            self._job.message = "compiling its kernels, once; this takes a minute or so"

    def _ended(self, job: Job) -> None:
        with self._lock:
            if job is not self._job or job.filed is None:
                return
            self._versions[self._place] = Version(job.filed, is_planned=True)
            self._revision += 1


def _after(before: Version, instance: Instance, edit: Edit) -> Version:
    if replace(instance, name=before.instance.name) == before.instance:
        return Version(replace(before.filed, instance=instance), before.is_planned)
    return Version(
        drafted(before.filed, instance, kept_ids(before.instance, edit)), is_planned=False
    )


def _empty_mission() -> Instance:
    return Instance(
        "new mission", (), Point(0.0, 0.0), Point(2000.0, 0.0), Fleet(2, 1.5, 4 * 3600.0)
    )
