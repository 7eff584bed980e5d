"""Options under which HiGHS solves the integer programme that it is given, not a reduced one.

The reductions of HiGHS 1.15.1, at the start and at restarts, lose optimal solutions now and then:
of some thousands of small set-packing programmes one was answered with a plan 1.8 % short of the
optimum, and a bound to match. Similar reports fill its list of issues
(github.com/ERGO-Code/HiGHS, 2171, 3043 and 3094 among them). Proofs do without. Presolving looks at
no clock either.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

__all__ = ["UNREDUCED"]

UNREDUCED: Mapping[str, str | bool] = MappingProxyType(
    {"presolve": "off", "mip_allow_restart": False}
)
"""Options of HiGHS by their own names."""
