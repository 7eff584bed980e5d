"""Heuristics: tiers 1 and 2 of the paper, and a search over the whole fleet."""
