"""A vehicle at sea: how it moves, how it keeps to a track, how it avoids what it did not expect."""
