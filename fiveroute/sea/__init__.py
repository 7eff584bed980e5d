"""The fleet at sea: AUVs carry a plan out in an ocean nobody forecast, and agree on changes."""
