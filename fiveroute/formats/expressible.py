"""What a benchmark format cannot hold is refused, never dropped in silence."""

from __future__ import annotations

from fiveroute.errors import InputError
from fiveroute.instance import Instance, Uncertainty

__all__ = ["require_closed", "require_plain", "single_endurance", "spelled"]


def require_plain(instance: Instance, format_name: str) -> None:
    """Refuse what no benchmark format knows.

    Raises
    ------
    InputError
        If the instance has service times, an ocean, uncertainty, depths or another speed than 1.
    """
    for field, what, held in (
        ("service", "service times", instance.service_times.any()),
        ("ocean", "currents, obstacles and land", instance.has_ocean),
        ("uncertainty", "uncertainty", instance.uncertainty != Uncertainty()),
        ("fleet.speed", "speed other than 1", instance.fleet.speed != 1.0),
        ("nodes", "depths", any(node.depth is not None for node in instance.nodes)),
        (
            "fleet",
            "depths",
            instance.fleet.depth is not None or instance.fleet.depth_rating is not None,
        ),
    ):
        if held:
            raise InputError(
                f"{format_name} files know no {what}; write the native format, or remove it first",
                field=field,
            )


def require_closed(instance: Instance, format_name: str) -> None:
    """Refuse all but one AUV on a closed tour."""
    if instance.fleet_size not in (None, 1):
        raise InputError(
            f"{format_name} files know one vehicle only; write the native format",
            field="fleet.size",
            value=instance.fleet_size,
        )
    if instance.start != instance.destination:
        raise InputError(
            f"{format_name} files know closed tours only; write the native format",
            field="destination",
            value=(instance.destination.x, instance.destination.y),
        )


def single_endurance(instance: Instance, format_name: str) -> float:
    """The endurance that all AUVs share."""
    endurance = instance.fleet.endurance
    values = set(endurance) if isinstance(endurance, tuple) else {endurance}
    shared = values.pop()
    if values or shared is None:
        raise InputError(
            f"{format_name} files need one endurance for all AUVs; write the native format",
            field="fleet.endurance",
            value=endurance,
        )
    return shared


def spelled(value: float) -> str:
    """Write a number as short as it can be without losing a bit."""
    return repr(float(value)).removesuffix(".0")
