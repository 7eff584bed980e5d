"""What export writes of nodes and zones, convert reads again."""

import numpy as np
import pytest

from fiveroute.formats import SURVEY_FORMATS
from fiveroute.vehicle_files import VEHICLE_FORMATS
from fiveroute.vehicle_files.mission import Mission


@pytest.mark.parametrize("name", SURVEY_FORMATS)
def test_charts_come_back(name: str, mission: Mission) -> None:
    (text,) = VEHICLE_FORMATS[name].write(mission).values()
    chart = SURVEY_FORMATS[name].read(text)
    sites = {site.name: site for site in chart.sites if site.end is None}
    visited = [node for node in mission.nodes if node.vehicle or name != "csv"]
    assert list(sites) == [node.name for node in visited]
    for node in visited:
        site = sites[node.name]
        assert np.allclose(site.spot, (node.place.lon, node.place.lat))
        assert site.depth == node.depth
        if name in ("kml", "geojson"):
            assert site.data == node.data
    if name != "gpx":
        ends = {site.end: site.spot for site in chart.sites if site.end}
        assert ends == {"start": (10.0, 63.0), "destination": (10.04, 63.0)}
    if name in ("kml", "geojson"):
        land = next(area for area in chart.areas if area.kind == "land")
        corners = [(corner.lon, corner.lat) for corner in mission.zones[0].corners]
        assert np.allclose(land.corners, corners)
        assert len(chart.areas) == 2
