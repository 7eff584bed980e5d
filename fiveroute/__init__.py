"""fiveroute: plans for fleets of autonomous underwater vehicles, with their optimality gap."""

from __future__ import annotations

__version__ = "0.1.0"
