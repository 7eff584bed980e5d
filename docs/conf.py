"""The documentation site: `make docs` builds it, and every warning is an error."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import fiveroute

project = "fiveroute"
author = "the fiveroute authors"
copyright = "the fiveroute authors"  # noqa: A001
version = release = fiveroute.__version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
]
templates_path = ["_templates"]
exclude_patterns = ["_build"]

html_theme = "furo"
html_title = f"fiveroute {release}"
html_static_path: list[str] = []

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
nb_execution_mode = "cache"
nb_execution_raise_on_error = True
nb_execution_timeout = 300
nb_execution_show_tb = True

autosummary_generate = True
autosummary_ignore_module_all = False
autodoc_default_options = {"members": True, "undoc-members": False, "member-order": "bysource"}
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_class_signature = "separated"
napoleon_google_docstring = False
napoleon_use_rtype = False
suppress_warnings = ["ref.python"]  # two classes may share a name in different modules


def _as_written(lines: list[str]) -> Iterator[str]:
    """Formulas stand indented in docstrings of modules, and between bars: keep them as they are."""
    for before, line in pairwise(["", *lines]):
        if line.startswith("    ") and not before.strip():
            yield from ("::", "")
        yield line if line.startswith("    ") else line.replace("|", r"\|").replace("*", r"\*")


def _keep_formulas(
    _app: object, what: str, _name: str, _of: object, _options: object, lines: list[str]
) -> None:
    if what == "module":
        lines[:] = _as_written(lines)


def setup(app: Any) -> None:
    """Register what is done to docstrings."""
    app.connect("autodoc-process-docstring", _keep_formulas)
