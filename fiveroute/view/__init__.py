"""A look at a plan: what is on the map, what happens when, and the page that shows it.

    plan = read_plan(path)
    scene = scene_of(plan, path.parent, runs=read_events(log, plan))
    page = page_of([scene])  # one HTML page that plays it and needs no network

A scene is a plan laid out to be looked at: the chart of its sea, its legs with their times, and
what was logged of its runs. `fiveroute.plots` draws the same with matplotlib.
"""
