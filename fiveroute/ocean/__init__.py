"""The ocean: currents, obstacles and land, and how far a forecast may be from the truth."""
