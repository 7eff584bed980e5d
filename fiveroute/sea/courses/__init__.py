"""Courses: what an AUV has before it, and how it drops, picks up and orders nodes on board."""
