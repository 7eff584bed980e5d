"""Optimality by column generation: routes as columns, bounds from the routes that pay.

    max sum_r rho_r lambda_r,  every node on at most one route, one route for every AUV.

`solver` tells the steps. Behind them stand

- `roads`, `duals` and `neighbourhoods`: legs and limits, multipliers, what routes remember;
- `completion`, `buckets`, `labels`, `join` and `pricing`: which routes pay;
- `master`, `cuts` and `column_generation`: multipliers that bring the bound down;
- `elementary`, `inspection` and `pool`: all routes of better plans, and the best plan over them;
- `subproblem` and `branching`: the search tree;
- `certificate`: what somebody else needs to confirm the bound.

References
----------
S. Boussier, D. Feillet and M. Gendreau, "An exact algorithm for team orienteering problems",
4OR 5 (2007), doi 10.1007/s10288-006-0009-1.
A. Pessoa, R. Sadykov, E. Uchoa and F. Vanderbeck, "A generic exact solver for vehicle routing and
related problems", Mathematical Programming 183 (2020), doi 10.1007/s10107-020-01523-z.
"""

from __future__ import annotations

from fiveroute.models.branch_price.solver import solve, supports

__all__ = ["solve", "supports"]
