"""Many instances measured, on one core, on all, or on a cluster, and kept row by row.

Every instance is measured with the same seed, so that its figures do not depend on who measures
it, or on what else is measured, unless a time limit cuts a run short.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path

import fiveroute
from fiveroute.errors import InputError
from fiveroute.experiments.gap_row import GapRow, GapSettings, measure
from fiveroute.experiments.kept_rows import KeptRows, key_of
from fiveroute.fleet_planning import sail
from fiveroute.formats import currents_file, instance_hash, read_instance
from fiveroute.instance import Instance
from fiveroute.kernels import source_digest
from fiveroute.limits import Limits, Progress, ProgressCallback
from fiveroute.models import METHODS
from fiveroute.paths.voyage import Voyage
from fiveroute.peers import PEERS
from fiveroute.sharing import share_out

__all__ = ["Entry", "measure_all", "read_entries"]

_NO_INSTANCES = (".csv", ".md")


@dataclass(frozen=True, slots=True)
class Entry:
    """An instance, and the file that it comes from."""

    instance: Instance
    file: Path

    def voyage(
        self,
        settings: GapSettings,
        limits: Limits | None = None,
        progress: ProgressCallback | None = None,
    ) -> Voyage:
        """The legs that its fleet sails; not all of them where the limits end it before."""
        return sail(
            self.instance,
            folder=self.file.parent,
            straight_lines=settings.straight_lines,
            limits=limits,
            seed=settings.seed,
            progress=progress,
        )

    def key(self, settings: GapSettings) -> str:
        """Names what its row depends on: data, settings, and all that computes it."""
        currents = currents_file(self.instance, self.file)
        methods = (method.module for method in METHODS.values())
        peers = [PEERS[name] for name in settings.peers]
        modules = [__name__, *methods, *(peer.module for peer in peers)]
        return key_of(
            {
                "name": self.instance.name,
                "instance": instance_hash(self.instance),
                "currents": None if currents is None else _file_hash(currents),
                "settings": asdict(settings),
                "sources": [source_digest(module) for module in modules],
                "versions": [fiveroute.__version__, *(peer.version for peer in peers)],
            }
        )


def _file_hash(file: Path) -> str | None:
    try:
        with file.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return None  # whoever reads it for its currents says what is wrong


def read_entries(paths: Iterable[Path]) -> tuple[list[Entry], list[str]]:
    """Read files, and all instances of folders in the order of their names.

    Returns
    -------
    list of Entry
        The instances.
    list of str
        Why files of the folders were left out, a sentence each.

    Raises
    ------
    InputError
        If a file that is named is no instance, or a folder holds none.
    """
    entries: list[Entry] = []
    notes: list[str] = []
    for path in paths:
        if path.is_dir():
            found = _read_folder(path, notes)
            if not found:
                raise InputError("is a folder without any instance; name another", file=path)
            entries += found
        else:
            entries.append(Entry(read_instance(path), path))
    return entries, notes


def _read_folder(folder: Path, notes: list[str]) -> list[Entry]:
    entries = []
    for file in sorted(path for path in folder.iterdir() if path.is_file()):
        if file.suffix.lower() in _NO_INSTANCES or file.stem.upper() == "README":
            notes.append(f"{file}: left out, no instance")
            continue
        try:
            entries.append(Entry(read_instance(file), file))
        except InputError as error:
            notes.append(f"{error}; left out")
    return entries


def measure_all(
    entries: Sequence[Entry],
    settings: GapSettings,
    *,
    reference: Mapping[str, float] | None = None,
    kept: KeptRows | None = None,
    workers: int = 1,
    scheduler: str | None = None,
    limits: Limits | None = None,
    progress: ProgressCallback | None = None,
) -> list[GapRow]:
    """Measure all instances; those that are done where the limits or an interrupt end it before.

    Parameters
    ----------
    entries
        The instances.
    settings
        How each is measured.
    reference
        Published values by instance name.
    kept
        Where rows are kept as soon as they are done, and looked for first; None keeps none.
    workers
        Processes on this machine.
    scheduler
        Address of a Dask scheduler; None stays on this machine.
    limits
        When to stop.
    progress
        Called as the run goes on.
    """
    limits = limits or Limits()
    clock = limits.start()
    keys = [entry.key(settings) if kept else "" for entry in entries]
    rows = {} if kept is None else _rows_kept(entries, keys, kept)
    tasks = [(number, entry) for number, entry in enumerate(entries) if number not in rows]
    work = partial(_measured, settings=settings)
    if workers == 1 and scheduler is None:  # what does not travel: an interrupt, and progress
        work = partial(work, limits=limits, progress=progress)
    with closing(share_out(work, tasks, workers=workers, scheduler=scheduler)) as answers:
        try:
            for number, row, whole in answers:
                rows[number] = row
                if kept is not None and whole:
                    kept.put(row.instance, keys[number], row.as_document())
                if progress is not None:
                    message = f"instance {len(rows)} of {len(entries)}"
                    progress(Progress(clock.seconds, message=message))
                if clock.expired:
                    break
        except KeyboardInterrupt:  # that of a worker, who hears Ctrl-C as well
            if not clock.interrupted:
                raise
    known = reference or {}
    return [rows[number].beside(known.get(rows[number].instance)) for number in sorted(rows)]


def _rows_kept(entries: Sequence[Entry], keys: Sequence[str], kept: KeptRows) -> dict[int, GapRow]:
    rows = {}
    for number, (entry, key) in enumerate(zip(entries, keys, strict=True)):
        document = kept.get(entry.instance.name, key)
        row = None if document is None else GapRow.of_document(document)
        if row is not None:
            rows[number] = row
    return rows


def _measured(
    number: int,
    entry: Entry,
    *,
    settings: GapSettings,
    limits: Limits | None = None,
    progress: ProgressCallback | None = None,
) -> tuple[int, GapRow, bool]:
    """The number of an entry, its row, and whether the row is whole: not cut short by Ctrl-C.

    Raises
    ------
    KeyboardInterrupt
        If it is interrupted before its legs are planned: there is nothing to measure.
    InputError
        If the instance is none for these settings; it names the file.
    """
    limits = limits or Limits()

    def report(step: Progress) -> None:
        if progress is not None:
            progress(replace(step, message=f"{entry.instance.name}: {step.message}"))

    try:
        voyage = entry.voyage(settings, limits, report)
        if not voyage.is_complete:
            raise KeyboardInterrupt
        row = measure(voyage, settings, limits, report)
    except InputError as error:
        raise error.at(error.file or entry.file) from None
    return number, row, not limits.interrupt.is_set()
