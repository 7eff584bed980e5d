"""The studio: the page of `fiveroute.view`, live, to change a mission and plan it anew.

    session = Session.opened(Path("sea.json"))
    with Studio(session) as studio:
        print(studio.url)
        studio.serve_forever()

A `Session` is one mission with its undo, its plan and the work in the background; a `Project` is
the one folder that it may write to; a `Studio` serves both to the browser of this computer and to
nobody else.
"""
