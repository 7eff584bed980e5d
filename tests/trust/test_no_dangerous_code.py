"""Nothing that is read is ever run: no pickle, no eval, no shell in the shipped code."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCES = sorted(
    path
    for folder in ("fiveroute", "models", "heuristics")
    for path in (ROOT / folder).rglob("*.py")
    if not any(part.is_symlink() for part in path.parents)
)
MODULES = {"pickle", "cPickle", "dill", "cloudpickle", "shelve", "marshal", "yaml", "subprocess"}
CALLS = {"eval", "exec", "compile", "__import__"}
METHODS = {"os.system", "os.popen", "os.execv", "joblib.load", "joblib.dump", "torch.load"}


def dangers(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names if name.name.split(".")[0] in MODULES)
        elif isinstance(node, ast.ImportFrom):
            if (node.module or "").split(".")[0] in MODULES:
                yield str(node.module)
        elif isinstance(node, ast.Call):
            called = ast.unparse(node.func)
            if called in CALLS or called in METHODS:
                yield called
            for keyword in node.keywords:
                held = ast.unparse(keyword.value)
                if (keyword.arg, held) in {("shell", "True"), ("allow_pickle", "True")}:
                    yield f"{keyword.arg}={held}"
            if called in ("np.load", "numpy.load") and "allow_pickle=False" not in ast.unparse(
                node
            ):
                yield "np.load without allow_pickle=False"


def test_no_source_runs_what_it_reads() -> None:
    trees = ((path, ast.parse(path.read_text(encoding="utf-8"))) for path in SOURCES)
    assert [(path.name, danger) for path, tree in trees for danger in dangers(tree)] == []


@pytest.mark.parametrize(
    "source",
    [
        "import pickle",
        "from yaml import load",
        "eval(text)",
        "run(command, shell=True)",
        "np.load(file)",
        "numpy.load(file, allow_pickle=True)",
        "import subprocess as s",
    ],
)
def test_the_walk_sees_dangers(source: str) -> None:
    assert list(dangers(ast.parse(source)))


def test_every_package_is_walked() -> None:
    assert {path.relative_to(ROOT).parts[0] for path in SOURCES} == {
        "fiveroute",
        "models",
        "heuristics",
    }
    assert len(SOURCES) > 200
