"""The shape of the house: who may import whom, what is shipped, what stays light."""

import ast
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
FOLDERS = {
    "fiveroute": ROOT / "fiveroute",
    "fiveroute.models": ROOT / "models",
    "fiveroute.heuristics": ROOT / "heuristics",
}


def modules() -> Iterator[tuple[str, Path]]:
    """Every module by its import name, models/ and heuristics/ under their own."""
    for package, folder in FOLDERS.items():
        for path in sorted(folder.rglob("*.py")):
            if package == "fiveroute" and {"models", "heuristics"} & set(
                path.relative_to(folder).parts
            ):
                continue
            parts = path.relative_to(folder).with_suffix("").parts
            yield ".".join([package, *parts]).removesuffix(".__init__"), path


MODULES = dict(modules())


def imports(path: Path) -> set[str]:
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return found


FORBIDDEN = [  # (who, whom, why)
    (
        ("fiveroute.models", "fiveroute.heuristics"),
        (
            "fiveroute.instance",
            "fiveroute.ocean",
            "fiveroute.tiers",
            "fiveroute.mission",
            "fiveroute.formats",
            "fiveroute.cli",
            "fiveroute.experiments",
        ),
        "models and heuristics know only the pure problem",
    ),
    (("fiveroute.models",), ("fiveroute.heuristics",), "proofs do not depend on heuristics"),
    (("fiveroute.heuristics",), ("highspy", "ortools", "pyomo"), "heuristics need no solver"),
    (
        ("fiveroute.ocean", "fiveroute.paths", "fiveroute.vehicle"),
        ("fiveroute.tiers", "fiveroute.mission", "fiveroute.sea", "fiveroute.models"),
        "the ocean, its paths and the vehicle know nothing of fleets",
    ),
    (
        (
            "fiveroute.tiers",
            "fiveroute.mission",
            "fiveroute.ocean",
            "fiveroute.paths",
            "fiveroute.sea",
            "fiveroute.vehicle",
        ),
        ("fiveroute.cli", "fiveroute.experiments"),
        "a tier does not know who calls it",
    ),
    (
        (
            "fiveroute.models",
            "fiveroute.heuristics",
            "fiveroute.ocean",
            "fiveroute.paths",
            "fiveroute.sea",
            "fiveroute.tiers",
            "fiveroute.vehicle",
            "fiveroute.mission",
            "fiveroute.verdict",
            "fiveroute.check",
            "fiveroute.check_paths",
        ),
        (
            "fiveroute.decide",
            "fiveroute.fleet_plan",
            "fiveroute.fleet_planning",
            "fiveroute.fleet_runs",
            "fiveroute.fleet_sailing",
            "fiveroute.peers",
            "fiveroute.plots",
            "fiveroute.reading",
            "fiveroute.studio",
            "fiveroute.vehicle_files",
            "fiveroute.view",
        ),
        "what plans, sails and judges does not know who shows, asks or exports",
    ),
    (
        ("fiveroute.peers",),
        ("fiveroute.heuristics", "fiveroute.mission", "fiveroute.models", "fiveroute.tiers"),
        "peers plan by themselves",
    ),
    (
        ("fiveroute.models", "fiveroute.heuristics", "fiveroute.exact"),
        ("fiveroute.peers",),
        "nothing is built on peers",
    ),
    (
        ("fiveroute.view", "fiveroute.vehicle_files"),
        ("fiveroute.decide", "fiveroute.experiments", "fiveroute.studio"),
        "pages and files are of plans and runs, whoever made them",
    ),
    (
        (
            "fiveroute.check",
            "fiveroute.check_paths",
            "fiveroute.crossings",
        ),
        ("fiveroute.heuristics", "fiveroute.mission", "fiveroute.models", "fiveroute.tiers"),
        "the judge shares nothing with the planners",
    ),
]


def below(name: str, package: str) -> bool:
    return name == package or name.startswith(package + ".")


@pytest.mark.parametrize("module", MODULES)
def test_nothing_imports_the_command_line(module: str) -> None:
    if not below(module, "fiveroute.cli") and module != "fiveroute.__main__":
        assert not any(below(name, "fiveroute.cli") for name in imports(MODULES[module]))


@pytest.mark.parametrize("module", MODULES)
def test_imports_point_one_way(module: str) -> None:
    used = imports(MODULES[module])
    for who, whom, why in FORBIDDEN:
        if any(below(module, package) for package in who):
            wrong = {name for name in used for package in whom if below(name, package)}
            assert not wrong, f"{module} imports {wrong}: {why}"


@pytest.mark.parametrize("module", MODULES)
def test_pictures_are_drawn_in_their_rooms(module: str) -> None:
    if any(name.split(".")[0] == "matplotlib" for name in imports(MODULES[module])):
        assert below(module, "fiveroute.plots") or module in {
            "fiveroute.decide.picture",
            "fiveroute.experiments.pictures",
            "fiveroute.experiments.sea_pictures",
        }


@pytest.mark.parametrize("module", MODULES)
def test_public_names_are_listed_and_sorted(module: str) -> None:
    tree = ast.parse(MODULES[module].read_text(encoding="utf-8"))
    lists = [
        ast.literal_eval(node.value)
        for node in tree.body
        if isinstance(node, ast.Assign)
        and any(isinstance(t, ast.Name) and t.id == "__all__" for t in node.targets)
    ]
    for names in lists:
        constants = [n for n in names if n.isupper()]
        classes = [n for n in names if not n.isupper() and n[0].isupper()]
        functions = [n for n in names if n[0].islower()]
        assert names == sorted(constants) + sorted(classes) + sorted(functions)


def test_every_package_is_shipped() -> None:
    listed = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]["packages"]
    found = {name for name, path in MODULES.items() if path.name == "__init__.py"}
    assert set(listed) == found


def test_tests_have_unique_names() -> None:
    names = [path.name for path in (ROOT / "tests").rglob("test_*.py")]
    assert len(names) == len(set(names))


HEAVY = ("highspy", "matplotlib", "numba", "ortools", "pydantic", "pyomo", "rich", "scipy")


@pytest.mark.parametrize("statement", ["import fiveroute", "import fiveroute.cli"])
def test_the_doors_are_light(statement: str) -> None:
    code = f"{statement}\nimport sys\nprint([m for m in {HEAVY!r} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
